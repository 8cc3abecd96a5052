#include "common/control/virtual_tool.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

ContactSet wall_at_zero(double k, double b = 0, double k3 = 0) {
  ContactSet set;
  set.add({.normal = {-1, 0, 0}, .at = 0, .k = k, .k3 = k3, .b = b});  // beyond x = 0
  return set;
}

VirtualTool::Pulls spring(double k, double anchor, std::size_t axis = 0) {
  VirtualTool::Pulls pulls{};
  pulls[axis].spring(k, anchor);
  return pulls;
}

TEST(VirtualTool, StepsASpringImplicitly) {
  VirtualTool tool({.m = 0.05, .b = 0.2}, 1);
  ASSERT_TRUE(tool.step(kT, spring(400, 0.01)));
  // v' = T k r / (m + T b + T^2 k) = 0.004 / (0.05 + 0.0002 + 0.0004)
  EXPECT_DOUBLE_EQ(tool.v(0), 0.001 * 400 * 0.01 / (0.05 + 0.001 * 0.2 + 1e-6 * 400));
  EXPECT_DOUBLE_EQ(tool.x(0), kT * tool.v(0));
  EXPECT_EQ(tool.x(1), 0);
}

TEST(VirtualTool, RestsWhereSpringAndSurfaceBalance) {
  VirtualTool tool({}, 3, wall_at_zero(20000, 5));
  for (int i = 0; i < 5000; ++i) tool.step(kT, spring(400, 0.0102));
  // 400 (0.0102 - x) = 20000 x: x = 0.2 mm, 4 N
  EXPECT_NEAR(tool.x(0), 0.0002, 1e-9);
  EXPECT_NEAR(tool.surface_force()[0], -4, 1e-5);
  EXPECT_NEAR(tool.penetration(), 0.0002, 1e-9);
}

TEST(VirtualTool, FollowsTheCubicLawOfAStiffeningSurface) {
  VirtualTool tool({}, 1, wall_at_zero(300, 3, 1e6));
  for (int i = 0; i < 20000; ++i) tool.step(kT, spring(400, 0.01));
  const double x = tool.x(0);
  EXPECT_NEAR(400 * (0.01 - x), 300 * x + 1e6 * x * x * x, 1e-6);
  EXPECT_GT(x, 0.005);
}

TEST(VirtualTool, IsNeverPulledByASurface) {
  VirtualTool tool({.m = 0.02, .b = 0}, 1, wall_at_zero(20000, 50));
  for (int i = 0; i < 2000; ++i) tool.step(kT, spring(400, 0.005));
  double strongest = 0;
  for (int i = 0; i < 50; ++i) {
    tool.step(kT, spring(4000, -0.05));  // pulled away
    strongest = std::max(strongest, tool.surface_force()[0]);
  }
  EXPECT_EQ(strongest, 0) << "its force is along -x or none";
  EXPECT_LT(tool.x(0), -0.01);
}

TEST(VirtualTool, RestsInACornerInBothDirections) {
  ContactSet set = wall_at_zero(20000);
  set.add({.normal = {0, 0, 1}, .at = 0, .k = 1000});  // floor: below z = 0
  VirtualTool tool({.m = 0.02, .b = 2}, 3, set);
  VirtualTool::Pulls pulls{};
  pulls[0].spring(400, 0.0102);
  pulls[2].spring(400, -0.0035);
  for (int i = 0; i < 5000; ++i) tool.step(kT, pulls);
  EXPECT_NEAR(tool.x(0), 0.0002, 1e-9);
  EXPECT_NEAR(tool.x(2), -0.001, 1e-9);  // 400 (0.0035 - z) = 1000 z
  EXPECT_NEAR(tool.surface_force()[2], 1, 1e-6);
}

TEST(VirtualTool, ASlopingSurfacePushesAlongItsNormal) {
  ContactSet set;
  const double r = std::sqrt(0.5);
  set.add({.normal = {-r, 0, r}, .at = 0, .k = 10000});
  VirtualTool tool({.m = 0.02, .b = 2}, 3, set);
  VirtualTool::Pulls pulls{};
  for (auto& p : pulls) p.spring(400, 0);
  pulls[0] = {};
  pulls[0].spring(400, 0.01);
  for (int i = 0; i < 8000; ++i) tool.step(kT, pulls);
  EXPECT_NEAR(tool.surface_force()[0], -tool.surface_force()[2], 1e-9);
  EXPECT_GT(tool.surface_force()[2], 1);
  EXPECT_EQ(tool.surface_force()[1], 0);
  // Each axis balances its own spring.
  EXPECT_NEAR(400 * (0.01 - tool.x(0)), -tool.surface_force()[0], 1e-6);
  EXPECT_NEAR(400 * tool.x(2), tool.surface_force()[2], 1e-6);
}

// Property, for any pulls and any stiffness of the surfaces. A step raises the energy of mass, springs and surfaces at
// most by the energy that the moving ends of the dampers supply.
TEST(VirtualTool, CreatesNoEnergyInAnyStep) {
  const RandomKey key{20261122};
  const std::uint64_t cases = test::seeds(300);
  for (std::uint64_t c = 0; c < cases; ++c) {
    std::uint64_t n = 0;
    const auto draw = [&](double low, double high) { return low + (high - low) * key.derive(c).uniform(n++); };
    const double k_wall = std::pow(10, draw(1, 6)), k = std::pow(10, draw(0, 4)), anchor = draw(-0.02, 0.02);
    VirtualTool tool({.m = std::pow(10, draw(-3, 0)), .b = draw(0, 2)}, 1, wall_at_zero(k_wall, draw(0, 50)));
    AxisArray start{};
    start[0] = draw(-0.01, 0.01);
    tool.rest_at(start);
    const auto stored = [&] {
      const double d = std::max(0.0, tool.x(0));
      return 0.5 * tool.gains().m * tool.v(0) * tool.v(0) + 0.5 * k * (anchor - tool.x(0)) * (anchor - tool.x(0)) +
             0.5 * k_wall * d * d;
    };
    double before = stored();
    for (int i = 0; i < 200; ++i) {
      ASSERT_TRUE(tool.step(kT, spring(k, anchor)));
      const double now = stored();
      ASSERT_LE(now, before * (1 + 1e-9) + 1e-12) << "case " << c << " step " << i;
      before = now;
    }
  }
}

TEST(VirtualTool, IgnoresNonFiniteInput) {
  VirtualTool tool({}, 3, wall_at_zero(20000));
  tool.step(kT, spring(400, 0.01));
  const double x = tool.x(0);
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
    EXPECT_FALSE(tool.step(kT, spring(400, bad)));
    EXPECT_EQ(tool.x(0), x);
    EXPECT_EQ(tool.v(0), 0);
  }
}

TEST(VirtualTool, ReducesRelativeDampingAtAStiffSurface) {
  VirtualTool tool({.m = 0.02, .b = 0.2}, 1, wall_at_zero(20000, 5));
  EXPECT_EQ(tool.relative_damping_share(0, 12, 0, 400, 0), 1);
  for (int i = 0; i < 1000; ++i) tool.step(kT, spring(400, 0.01));
  EXPECT_DOUBLE_EQ(tool.relative_damping_share(0, 12, 0, 400, 0), (0.2 + 5) * 400 / 20000 / 12);
  EXPECT_DOUBLE_EQ(tool.relative_damping_share(0, 12, 6, 400, 200), (0.2 + 5 + 6) * 400 / 20200 / 12);
}

TEST(VirtualTool, RunsWithoutHeap) {
  VirtualTool tool({}, 3, wall_at_zero(20000));
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) tool.step(kT, spring(400, 0.01));
  EXPECT_EQ(guard.count(), 0u);
}

/// A tool without surfaces takes a shorter way. Twin: a surface out of reach changes no bit.
TEST(VirtualTool, MovesAlikeWithoutSurfacesAndFarFromThem) {
  for (std::uint64_t seed = 1; seed <= test::seeds(50); ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    const std::size_t axes = 1 + random.below(3);
    const VirtualTool::Gains gains{.m = random.uniform(0.01, 0.1), .b = random.uniform(0, 1)};
    ContactSet far;
    far.add({.normal = {-1, 0, 0}, .at = -1000, .k = 20000, .b = 5});
    VirtualTool free(gains, axes), other(gains, axes, far);
    for (int tick = 0; tick < 300; ++tick) {
      VirtualTool::Pulls pulls{};
      for (std::size_t a = 0; a < axes; ++a) {
        pulls[a].spring(random.uniform(0, 2000), random.uniform(-0.1, 0.1));
        pulls[a].damper(random.uniform(0, 20), random.uniform(-1, 1));
      }
      ASSERT_TRUE(free.step(kT, pulls) && other.step(kT, pulls));
      for (std::size_t a = 0; a < axes; ++a) {
        ASSERT_EQ(free.x(a), other.x(a));
        ASSERT_EQ(free.v(a), other.v(a));
      }
    }
  }
}

TEST(VirtualTool, FeelsNoSurfaceAfterTheLastOneIsRemoved) {
  VirtualTool tool({.m = 0.05, .b = 0.2}, 1);
  tool.set_received_contacts(wall_at_zero(1000));
  for (int tick = 0; tick < 500; ++tick) ASSERT_TRUE(tool.step(kT, spring(500, 0.01)));
  ASSERT_LT(tool.surface_force()[0], -1) << "it presses";
  ASSERT_LT(tool.relative_damping_share(0, 1e6, 0, 400, 0), 1);
  tool.set_received_contacts({});
  ASSERT_TRUE(tool.step(kT, spring(500, 0.01)));
  EXPECT_EQ(tool.surface_force()[0], 0);
  EXPECT_EQ(tool.relative_damping_share(0, 1e6, 0, 400, 0), 1);
}

}  // namespace
}  // namespace tandem::control
