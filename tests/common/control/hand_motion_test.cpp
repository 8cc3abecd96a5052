#include "common/control/hand_motion.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

TEST(HandMotionFilter, FindsVelocityAndAccelerationOfSteadyMotion) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  double x = 0;
  for (int i = 1; i <= 3000; ++i) filter.step(x = 0.2 * kT * i);
  EXPECT_NEAR(filter.now().v, 0.2, 1e-6);
  EXPECT_NEAR(filter.now().a, 0, 1e-4);
  EXPECT_DOUBLE_EQ(filter.now().x, x);

  filter.rest_at(0);
  for (int i = 1; i <= 3000; ++i) filter.step(0.5 * 0.3 * kT * kT * i * i);
  EXPECT_NEAR(filter.now().a, 0.3, 1e-6);
  for (int i = 1; i <= 3000; ++i) filter.step(filter.now().x + 0.9 * kT + 0.8 * kT * kT * i);
  EXPECT_DOUBLE_EQ(filter.now().a, 0.35) << "more does not last";
}

// One pole of 21 Hz: after 1 / (2 pi 21 Hz) = 7.6 ms a step of velocity is at 63 %.
TEST(HandMotionFilter, VelocityHasOnePole) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  for (int i = 1; i <= 12; ++i) filter.step(0.1 * kT * i);
  EXPECT_NEAR(filter.now().v, 0.1 * (1 - std::exp(-2 * std::numbers::pi * 21 * 0.012)), 1e-9);
}

// A hand at 0.3 m/s that decelerates by 4 m/s^2 is about to stop. The filter does not report an equal acceleration,
// because the hand's next motion is unknown.
TEST(HandMotionFilter, ReportsDecelerationAndNotAcceleration) {
  const auto after = [](double start, double acceleration) {
    HandMotionFilter filter(kT);
    filter.rest_at(0);
    double x = 0, v = start;
    for (int i = 0; i < 2000; ++i) filter.step(x += v * kT);
    for (int i = 0; i < 50; ++i) filter.step(x += (v += acceleration * kT) * kT);
    return filter.now();
  };
  const HandMotion brakes = after(0.3, -4), back = after(-0.3, 4), hurries = after(0.3, 4);
  EXPECT_GT(brakes.v, 0.05);
  EXPECT_LT(brakes.a, -1.5);
  EXPECT_GT(brakes.a, -4);
  EXPECT_DOUBLE_EQ(back.a, -brakes.a) << "in either direction";
  EXPECT_GT(hurries.v, 0.4);
  EXPECT_DOUBLE_EQ(hurries.a, 0.35);
  const HandMotion gently = after(0.3, -1);
  EXPECT_GE(gently.a, -0.35) << "a circle of 50 mm at 0.5 Hz does half of that";
}

// One pole of 40 Hz: after 4 ms a step of velocity is at 63 %.
TEST(HandVelocity, HasOnePole) {
  HandVelocity velocity(kT);
  velocity.rest_at(0);
  double v = 0;
  for (int i = 1; i <= 4; ++i) v = velocity.step(0.1 * kT * i);
  EXPECT_NEAR(v, 0.1 * (1 - std::exp(-2 * std::numbers::pi * 40 * 0.004)), 1e-9);
  EXPECT_EQ(velocity.step(std::numeric_limits<double>::quiet_NaN()), v);
  EXPECT_EQ(velocity.step(std::numeric_limits<double>::infinity()), v);
  velocity.rest_at(0.3);
  EXPECT_EQ(velocity.step(0.3), 0);
}

// Poles are in Hz, not in ticks. A hand that moves 50 mm at 0.5 Hz is predicted by 50 ms with the same error at every
// rate.
TEST(HandMotionFilter, PredictsAlikeAtEveryRate) {
  const auto error = [](double rate) {
    HandMotionFilter filter(1 / rate);
    const double w = 2 * std::numbers::pi * 0.5, age = 0.05;
    const auto place = [&](double t) { return 0.05 * std::sin(w * t); };
    filter.rest_at(0);
    double square = 0;
    int n = 0;
    for (int i = 1; i <= static_cast<int>(6 * rate); ++i) {
      const double t = i / rate;
      const HandMotion& now = filter.step(place(t));
      if (t < 2) continue;
      const double e = Prediction::place(now, age) - place(t + age);
      square += e * e;
      ++n;
    }
    return std::sqrt(square / n);
  };
  const double usual = error(1000);
  EXPECT_LT(usual, 1e-3) << "the way itself is 5.5 mm RMS";
  for (const double rate : {100.0, 200.0, 500.0, 2000.0, 4000.0})
    EXPECT_NEAR(error(rate), usual, 0.03e-3) << rate << " Hz";
}

TEST(HandMotionFilter, IgnoresNonFiniteInput) {
  HandMotionFilter filter(kT);
  filter.rest_at(0.01);
  filter.step(0.0102);
  const HandMotion before = filter.now();
  filter.step(std::numeric_limits<double>::quiet_NaN());
  filter.step(std::numeric_limits<double>::infinity());
  EXPECT_EQ(filter.now().x, before.x);
  EXPECT_EQ(filter.now().v, before.v);
  EXPECT_EQ(filter.now().a, before.a);
}

// Encoder steps of 0.055 mm in a resting hand must not look like motion: one step is 55 mm/s unfiltered.
TEST(HandMotionFilter, TreatsAFlickeringEncoderAsNearlyAtRest) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  double fastest = 0;
  for (int i = 0; i < 1000; ++i) fastest = std::max(fastest, std::abs(filter.step(i % 2 == 0 ? 5.5e-5 : 0).v));
  EXPECT_LT(fastest, 0.007);
}

TEST(Prediction, IsExactForUniformMotionAndBoundedInTimeAndSpeed) {
  const HandMotion m{0.01, 0.2, 0};
  EXPECT_DOUBLE_EQ(Prediction::place(m, 0.1), 0.03);
  EXPECT_DOUBLE_EQ(Prediction::place(m, 0), 0.01);
  EXPECT_DOUBLE_EQ(Prediction::place(m, -1), 0.01);
  EXPECT_DOUBLE_EQ(Prediction::place(m, 5), 0.01 + 0.25 * 0.2) << "no farther than 250 ms";
  EXPECT_DOUBLE_EQ(Prediction::place({0, 50, 0}, 0.1), 0.1) << "no faster than 1 m/s";
  EXPECT_DOUBLE_EQ(Prediction::rate({0, 0, 100}, 0.1), 0.35 * (0.1 + Prediction::kFilterDelay))
      << "no more than 0.35 m/s^2";
  EXPECT_DOUBLE_EQ(Prediction::place_for_hand(0.01, 0.2, 0.1), 0.03);
  EXPECT_DOUBLE_EQ(Prediction::place_for_hand(0.01, 0.2, 9), 0.06);
}

TEST(Prediction, StopsABrakingHandAndNeverReversesIt) {
  const HandMotion brakes{0, 0.1, -2.35};  // 0.35 of the deceleration is assumed to last
  const double t = 0.01 + Prediction::kFilterDelay;
  EXPECT_NEAR(Prediction::rate(brakes, 0.01), 0.1 - 2.35 * t, 1e-12);
  EXPECT_NEAR(Prediction::place(brakes, 0.01), 0.01 * (0.1 - 0.35 * (0.005 + Prediction::kFilterDelay) - 0.5 * 2 * t),
              1e-12);
  const double longer = 0.2 + Prediction::kFilterDelay;
  EXPECT_NEAR(Prediction::rate(brakes, 0.2), -0.35 * longer, 1e-12) << "the remaining part is the lasting one";
  EXPECT_DOUBLE_EQ(Prediction::rate({0, 0.1, -1e9}, 0.2), Prediction::rate(brakes, 0.2)) << "whatever a client says";
  EXPECT_DOUBLE_EQ(Prediction::rate({0, -0.1, 2.35}, 0.2), -Prediction::rate(brakes, 0.2));
}

// A hand moves 20 mm within 0.15 s and stops. Without its deceleration the prediction by 20 ms overshoots the goal by 7
// %.
TEST(Prediction, HardlyOvershootsAStep) {
  const auto overshoot = [](double age, bool braking) {
    HandMotionFilter filter(kT);
    filter.rest_at(0);
    double farthest = 0;
    for (int i = 1; i <= 600; ++i) {
      const double s = std::min(1.0, i * kT / 0.15);
      HandMotion m = filter.step(0.02 * s * s * s * (10 - 15 * s + 6 * s * s));
      if (!braking) m.a = std::clamp(m.a, -0.35, 0.35);
      farthest = std::max(farthest, Prediction::place(m, age));
    }
    return farthest / 0.02 - 1;
  };
  EXPECT_LT(overshoot(0.01, true), 0.03);
  EXPECT_LT(overshoot(0.02, true), 0.05);
  EXPECT_GT(overshoot(0.02, false), 0.065);
}

// Purpose of the prediction: a circle of 50 mm at 0.5 Hz, seen through encoder steps, is 15.8 mm behind after 100 ms.
TEST(Prediction, ReducesMostOfTheDelayErrorOfAMovingHand) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  const auto hand = [](double t) { return 0.05 * std::sin(std::numbers::pi * t); };
  double missed = 0, lag = 0;
  int n = 0;
  for (int i = 0; i < 12000; ++i) {
    const double t = i * kT, seen = std::round(hand(t) / 5.5e-5) * 5.5e-5;
    filter.step(seen);
    if (t < 4) continue;
    const double e = Prediction::place(filter.now(), 0.1) - hand(t + 0.1), behind = seen - hand(t + 0.1);
    missed += e * e;
    lag += behind * behind;
    ++n;
  }
  EXPECT_LT(std::sqrt(missed / n), 0.0018);
  EXPECT_LT(std::sqrt(missed / lag), 0.2);
  EXPECT_GT(std::sqrt(lag / n), 0.010);
}

}  // namespace
}  // namespace tandem::control
