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
  for (int i = 1; i <= 3000; ++i) filter.step(0.5 * 0.4 * kT * kT * i * i);
  EXPECT_NEAR(filter.now().a, 0.4, 1e-6);
}

// One pole of 17 Hz: after 1 / (2 pi 17 Hz) = 9.4 ms a step of velocity is at 63 %.
TEST(HandMotionFilter, VelocityHasOnePole) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  for (int i = 1; i <= 12; ++i) filter.step(0.1 * kT * i);
  EXPECT_NEAR(filter.now().v, 0.1 * (1 - std::exp(-2 * std::numbers::pi * 17 * 0.012)), 1e-9);
}

// At 0.4 m/s^2 a pole of 17 Hz lags by 0.4 / (2 pi 17) = 3.7 mm/s.
TEST(HandMotionFilter, HalfOfItsDelayIsMadeUpForByTheAcceleration) {
  HandMotionFilter filter(kT);
  filter.rest_at(0);
  constexpr int kTicks = 3000;
  for (int i = 1; i <= kTicks; ++i) filter.step(0.5 * 0.4 * kT * kT * i * i);
  const double lag = 0.4 / (2 * std::numbers::pi * 17), real = 0.4 * kT * kTicks;
  EXPECT_NEAR(filter.now().v, real - lag, 3e-4);
  EXPECT_NEAR(HandMotionFilter::velocity_by_now(filter.now()), real - 0.5 * lag, 3e-4);
}

// Poles are in Hz, not in ticks: at every rate a hand on 50 mm at 0.5 Hz is foreseen by 50 ms with the same error.
TEST(HandMotionFilter, ForeseesAlikeAtEveryRate) {
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
  for (const double rate : {100.0, 200.0, 500.0, 2000.0, 4000.0}) EXPECT_NEAR(error(rate), usual, 0.03e-3) << rate << " Hz";
}

TEST(HandMotionFilter, WhatIsNotFiniteChangesNothing) {
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

// Steps of an encoder of 0.055 mm in a resting hand must not look like motion: 1 step is 55 mm/s unfiltered.
TEST(HandMotionFilter, AnEncoderThatFlickersIsNearlyAtRest) {
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
  EXPECT_DOUBLE_EQ(Prediction::rate({0, 0, 100}, 0.1), 0.5 * (0.1 + Prediction::kFilterDelay)) << "no more than 0.5 m/s^2";
  EXPECT_DOUBLE_EQ(Prediction::place_for_hand(0.01, 0.2, 0.1), 0.03);
  EXPECT_DOUBLE_EQ(Prediction::place_for_hand(0.01, 0.2, 9), 0.06);
}

// What it is for: a circle of 50 mm at 0.5 Hz, seen through encoder steps, is 15.8 mm behind after 100 ms.
TEST(Prediction, TakesMostOfTheWayOutOfAHandsMotion) {
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
