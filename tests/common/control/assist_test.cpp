#include "common/control/assist.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001, kK = 400;

Assist::Params pull_of(double force, std::size_t axes = 1) {
  return {.axes = axes, .force = force, .k_c = kK, .dt = kT};
}
Assist::Input ahead(double x, double y = 0, double z = 0) {
  Assist::Input in;
  in.led = true;
  in.ahead = {x, y, z};
  return in;
}
/// Advances the assist by one tick and pays for the whole step. @return length of the wanted step [m]
double tick(Assist& assist, const Assist::Input& in) {
  const AxisArray step = assist.step(in);
  double square = 0;
  for (std::size_t a = 0; a < Assist::kAxes; ++a) {
    assist.move(a, step[a]);
    square += step[a] * step[a];
  }
  return std::sqrt(square);
}
void ticks(Assist& assist, const Assist::Input& in, int n) {
  for (int i = 0; i < n; ++i) tick(assist, in);
}

TEST(Assist, StaysWithinItsBoundAtAnyDistanceOfTheLeader) {
  Assist assist(pull_of(1, 3));
  for (int i = 0; i < 5000; ++i) {
    tick(assist, ahead(0.3, -0.4, 0.2));
    ASSERT_LE(assist.force(), 1 + 1e-9);
  }
  EXPECT_NEAR(assist.force(), 1, 1e-3) << "and all of that";
  EXPECT_NEAR(assist.shift(0) / assist.shift(1), -0.75, 1e-6) << "towards the leader's hand";
}

TEST(Assist, ChangesThePullByAHundredthOfANewtonPerMillisecondAtMost) {
  RandomStream random{5};
  Assist assist(pull_of(3, 3));
  double most = 0;
  for (int i = 0; i < 20'000; ++i) {
    Assist::Input in = ahead(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), 0.1);
    in.led = i / 700 % 3 != 0;
    in.authority = i / 900 % 4 == 0 ? 1 : 0;
    in.touching = i / 500 % 5 == 0;
    most = std::max(most, kK * tick(assist, in));
  }
  EXPECT_LE(most, 0.01 + 1e-9);
  EXPECT_GT(most, 0.009) << "the bound was met";
}

/// The leader is 1 mm ahead and at rest. z is 1 mm, and s' = 0 where p / 6 z = s / T. With p = 1/2 sqrt(400 / 0.5) =
/// 14.14 /s and T = 4 s, s is 9.43 mm; the pull of 3 N ends at 7.5 mm. At 0.1 mm, s is 0.943 mm: 0.377 N, where the
/// spring itself gives 0.04 N.
TEST(Assist, ReachesTenTimesTheSpringForce) {
  Assist assist(pull_of(3));
  ticks(assist, ahead(1e-4), 40'000);
  EXPECT_NEAR(assist.shift(0), 1e-4 * 0.5 * std::sqrt(kK / 0.5) / 6 * 4, 1e-6);
  EXPECT_NEAR(assist.force(), 0.377, 1e-3);
  ticks(assist, ahead(1e-3), 40'000);
  EXPECT_NEAR(assist.force(), 3, 1e-3);
}

TEST(Assist, FadesAsTheHandArrives) {
  Assist assist(pull_of(1));
  ticks(assist, ahead(0.01), 3000);
  ASSERT_NEAR(assist.force(), 1, 1e-3);
  ticks(assist, ahead(0), 1000);
  const double later = assist.force();
  ticks(assist, ahead(0), 4000);
  EXPECT_NEAR(assist.force() / later, std::exp(-1), 0.01) << "within 4 s";
}

TEST(Assist, ReleasesWhenAPullIsNotAllowed) {
  const auto after = [](auto&& change) {
    Assist assist(pull_of(1));
    ticks(assist, ahead(0.01), 3000);
    Assist::Input in = ahead(0.01);
    change(in);
    ticks(assist, in, 1500);
    return assist.force();
  };
  EXPECT_NEAR(after([](Assist::Input&) {}), 1, 1e-3) << "else it stays";
  EXPECT_LT(after([](Assist::Input& in) { in.led = false; }), 0.01);
  EXPECT_LT(after([](Assist::Input& in) { in.authority = 0.02; }), 0.01) << "this hand has authority";
  EXPECT_LT(after([](Assist::Input& in) { in.touching = true; }), 0.01);
  EXPECT_LT(after([](Assist::Input& in) { in.velocity[0] = 1; }), 0.1) << "the leader moves fast";
  EXPECT_LT(after([](Assist::Input& in) { in.ahead[0] = std::numeric_limits<double>::quiet_NaN(); }), 0.01);
}

TEST(Assist, PullsInContactWhereConfigured) {
  Assist::Params p = pull_of(1);
  p.in_contact = true;
  Assist assist(p);
  Assist::Input in = ahead(0.01);
  in.touching = true;
  ticks(assist, in, 3000);
  EXPECT_NEAR(assist.force(), 1, 1e-3);
}

/// A hand on its spring k_c, without damping of its own. Its oscillation must decay; with a pull without its two poles,
/// it grows.
TEST(Assist, DampsOscillationOnTheSpring) {
  for (const double k_c : {40.0, 372.0}) {
    for (const double mass : {0.05, 0.15, 0.3, 0.5}) {
      SCOPED_TRACE(std::to_string(k_c) + " N/m, " + std::to_string(mass) + " kg");
      Assist assist({.axes = 1, .force = 3, .k_c = k_c, .dt = kT});
      double x = 1e-3, v = 0;
      double early = 0, late = 0;
      for (int i = 0; i < 20'000; ++i) {
        tick(assist, ahead(-x));
        v += kT / mass * k_c * (assist.shift(0) - x);  // symplectic integration: neither damps nor amplifies
        x += kT * v;
        const double energy = 0.5 * mass * v * v + 0.5 * k_c * x * x;
        if (i >= 2000 && i < 4000) early = std::max(early, energy);
        if (i >= 18'000) late = std::max(late, energy);
      }
      EXPECT_LE(late, early) << "the swing shrinks";
    }
  }
}

TEST(Assist, IsOffWithoutABound) {
  Assist assist(pull_of(0));
  EXPECT_FALSE(assist.on());
  ticks(assist, ahead(0.01), 100);
  EXPECT_EQ(assist.force(), 0);
}

TEST(Assist, StepsWithoutHeap) {
  Assist assist(pull_of(1, 3));
  test::AllocGuard guard;
  ticks(assist, ahead(0.01), 10);
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::control
