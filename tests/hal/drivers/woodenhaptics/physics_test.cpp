#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "hal/core/adaptive_velocity_estimator.h"
#include "tests/common/base/counts.h"
#include "tests/hal/drivers/woodenhaptics/woodenhaptics_fixture.h"

namespace tandem::hal::woodenhaptics {
namespace {

using namespace std::chrono_literals;
using test::WoodenHapticsFixture;

WoodenHapticsOptions with_gravity(bool gravity) {
  WoodenHapticsOptions options{.spec = test::wooden_2015(), .enable_motors = true};
  options.spec.gravity = gravity;
  return options;
}

TEST(WoodenPhysics, AcceleratesTheTipAsItsMassPredicts) {
  WoodenHapticsFixture b(with_gravity(false), {.spec = {}, .mass = 0.5, .damping = 0.0});
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  b.model.let_go();
  for (int i = 0; i < 100; ++i) ASSERT_TRUE(b.step(b.state.J.leftCols<3>().transpose() * Vec3(0.5, 0, 0)));
  // 1 m/s^2 for 0.1 s; one exchange contributes less than a percent.
  EXPECT_NEAR(b.model.tip()[0], 0.005, 2e-4);
  EXPECT_NEAR(b.model.velocity()[0], 0.1, 2e-3);
  EXPECT_NEAR(b.state.dx[0], 0.1, 1e-2);
}

TEST(WoodenPhysics, ConvertsMotorWorkIntoTipEnergy) {
  WoodenHapticsFixture b(with_gravity(false), {.spec = {}, .mass = 0.5, .damping = 0.0});
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  b.model.let_go();
  double work = 0.0;
  Vec3 q = Vec3(b.state.q[0], b.state.q[1], b.state.q[2]);
  for (int i = 0; i < 150; ++i) {
    ASSERT_TRUE(b.step(b.state.J.leftCols<3>().transpose() * Vec3(0.8 * std::cos(0.02 * i), 0.4, -0.3)));
    const Vec3 now(b.state.q[0], b.state.q[1], b.state.q[2]);
    work += Vec3(b.state.tau_out[0], b.state.tau_out[1], b.state.tau_out[2]).dot(now - q);
    q = now;
  }
  const double kinetic = 0.25 * b.model.velocity().squaredNorm();
  EXPECT_GT(kinetic, 5e-3);
  EXPECT_NEAR(work, kinetic, 0.03 * kinetic) << "work booked by the host and energy of the arm";
}

TEST(WoodenPhysics, CompensatesGravityOnlyIfThePresetEnablesIt) {
  for (const bool gravity : {false, true}) {
    WoodenHapticsFixture b(with_gravity(gravity), {.spec = {}, .mass = 0.25, .damping = 0.5, .weight = true});
    ASSERT_TRUE(b.bring_up());
    ASSERT_TRUE(b.home());
    ASSERT_TRUE(b.walk_to(Vec3::Zero()));
    for (int i = 0; i < 1000; ++i) ASSERT_TRUE(b.step(Vec3(1e-9, 0, 0)));  // fades in while the tip is held
    b.model.let_go();
    for (int i = 0; i < 100; ++i) ASSERT_TRUE(b.step(Vec3(1e-9, 0, 0)));
    const double fallen = b.model.tip().norm();
    if (gravity) {
      EXPECT_LT(fallen, 5e-4);
      EXPECT_LT(Vec3(b.state.tau_out[0], b.state.tau_out[1], b.state.tau_out[2]).norm(), 1e-3)
          << "gravity compensation is not reported as effort";
    } else {
      EXPECT_GT(fallen, 3e-3);
    }
  }
}

TEST(WoodenPhysics, EndsGravityCompensationWithTheCommands) {
  WoodenHapticsFixture b(with_gravity(true), {.spec = {}, .weight = true});
  ASSERT_TRUE(b.bring_up());
  ASSERT_TRUE(b.home());
  ASSERT_TRUE(b.walk_to(Vec3::Zero()));
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero()) << "no command yet";
  for (int i = 0; i < 1000; ++i) ASSERT_TRUE(b.step(Vec3(1e-9, 0, 0)));
  ASSERT_GT(b.model.motor_effort().norm(), 0.05);
  for (int i = 0; i < 210; ++i) ASSERT_TRUE(b.step());
  EXPECT_EQ(b.model.motor_effort(), Vec3::Zero());
}

/// A pipe with arbitrary reads: any report of any length, none, or an error.
struct Chaos final : HidPipe {
  explicit Chaos(std::uint64_t seed) : random(seed) {}
  Moved write(std::span<const std::byte> report) noexcept override {
    std::array<int, 4> word{};
    for (std::size_t i = 0; i < 4; ++i) {
      word[i] = static_cast<std::int16_t>(std::to_integer<int>(report[2 * i]) +
                                          256 * std::to_integer<int>(report[2 * i + 1]));
    }
    preset = report.size() > 8 && word[3] == 1;
    for (std::size_t i = 0; i < 3; ++i) worst = std::max(worst, preset ? 0 : std::abs(word[i]));
    pushed = !preset && (word[0] != 0 || word[1] != 0 || word[2] != 0);
    return report.size();
  }
  Moved read(std::span<std::byte> into, Duration) noexcept override {
    switch (random.below(8)) {
      case 0:
        return std::size_t{0};
      case 1:
        return std::unexpected(Errc::kProtocol);
      case 2: {
        const std::size_t n = random.below(into.size());
        for (std::size_t i = 0; i < n; ++i) into[i] = static_cast<std::byte>(random.bits());
        return n;
      }
      default:
        for (std::size_t i = 0; i < 14; ++i) into[i] = static_cast<std::byte>(random.bits());
        if (preset || random.below(4) != 0) calm(into);
        return std::size_t{14};
    }
  }
  void calm(std::span<std::byte> into) {  // near the calibration pose, so that the driver gets homed from time to time
    std::fill(into.begin(), into.begin() + 14, std::byte{0});
    into[4] = std::byte{0x70};
    into[5] = std::byte{0x17};
    into[12] = static_cast<std::byte>(random.below(2));
  }
  RandomStream random;
  int worst = 0;
  bool preset = false, pushed = false;
};

struct Ticking final : Clock {
  Time at{};
  Time now() noexcept override { return at += 100us; }
  void wait_until(Time) noexcept override {}
};

TEST(WoodenDriver, BoundsCurrentsForAnyBusInputAndGivesNoneUnhomed) {
  const std::uint64_t seeds = test::seeds(60);
  std::uint64_t pushes = 0;
  for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
    Chaos pipe(seed);
    Ticking clock;
    WoodenHapticsDriver driver({"woodenhaptics", "1"}, pipe, clock, with_gravity(true));
    test::QuietBringUp watcher;
    (void)driver.bring_up(watcher);
    State state;
    RandomStream r(seed + 1000);
    for (int i = 0; i < 1000; ++i) {
      if (r.below(50) == 0) driver.home_here();
      const bool homed = driver.homed();
      ServoCommand command{.seq = static_cast<std::uint64_t>(i)};
      if (r.below(3) != 0) command.effort = {r.uniform(-9, 9), r.uniform(-9, 9), r.uniform(-9, 9)};
      pipe.pushed = false;
      (void)driver.exchange(command, state);
      ASSERT_FALSE(pipe.pushed && !homed) << seed << " " << i;
      pushes += pipe.pushed ? 1 : 0;
      ASSERT_TRUE(state.x.allFinite() && state.dx.allFinite() && state.f_out.allFinite());
    }
    ASSERT_LE(pipe.worst, 2000) << seed;
  }
  EXPECT_GT(pushes, seeds) << "it was homed and pushed now and then, else this shows nothing";
}

TEST(AdaptiveVelocityEstimator, IsExactOnALineAndQuietAtRest) {
  AdaptiveVelocityEstimator rate(1e-4);
  for (int i = 0; i < 50; ++i) {
    rate.update(Time{} + i * 1ms, std::round(0.5 * i * 1e-3 / 1e-4) * 1e-4);  // 0.5 /s, five quanta per ms
  }
  EXPECT_NEAR(rate.velocity(), 0.5, 1e-9);
  for (int i = 50; i < 100; ++i) rate.update(Time{} + i * 1ms, 1.0 + (i % 2) * 1e-4);  // a toggling last bit
  EXPECT_LT(std::abs(rate.velocity()), 1e-4 / 15e-3 + 1e-12);
}

TEST(AdaptiveVelocityEstimator, RespondsQuicklyToASuddenStart) {
  AdaptiveVelocityEstimator rate(1e-4);
  for (int i = 0; i < 20; ++i) rate.update(Time{} + i * 1ms, 0.0);
  for (int i = 0; i < 3; ++i) rate.update(Time{} + (20 + i) * 1ms, 1e-3 * (i + 1));
  EXPECT_NEAR(rate.velocity(), 1.0, 0.15);
}

TEST(AdaptiveVelocityEstimator, UsesNoIntervalShorterThanConfigured) {
  AdaptiveVelocityEstimator rate(1e-4, 750us);
  for (int i = 0; i < 20; ++i) rate.update(Time{} + i * 1ms, 1e-3 * i);
  EXPECT_NEAR(rate.velocity(), 1.0, 1e-9);
  EXPECT_NEAR(rate.update(Time{} + 19ms + 10us, 20e-3), 2e-3 / 1010e-6, 1e-9)
      << "over two readings, not 100 /s over one";
  EXPECT_NEAR(rate.update(Time{} + 21ms, 21e-3), 1e-3 / 1990e-6, 1e-9);
}

TEST(AdaptiveVelocityEstimator, IgnoresRepeatedTimesAndNonFiniteNumbers) {
  AdaptiveVelocityEstimator rate(1.0);
  EXPECT_EQ(rate.update(Time{}, 5.0), 0.0);
  EXPECT_EQ(rate.update(Time{}, 9.0), 0.0);
  EXPECT_EQ(rate.update(Time{} + 1ms, 7.0), 2000.0);
  EXPECT_EQ(rate.update(Time{} + 2ms, std::nan("")), 0.0);
  EXPECT_EQ(rate.update(Time{} + 3ms, 1e9), 0.0) << "starts again";
}

}  // namespace
}  // namespace tandem::hal::woodenhaptics
