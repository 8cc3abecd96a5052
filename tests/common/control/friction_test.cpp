// Coulomb friction of surfaces, at a virtual tool and its copies.
#include <gtest/gtest.h>

#include <cmath>

#include "common/base/rng.h"
#include "common/control/virtual_tool.h"
#include "tests/common/base/counts.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

/// Surface below z = 0. A tool pressed into it by 400 N/m over 10 mm exerts 4 N.
ContactSet floor_with(double mu) {
  ContactSet set;
  set.add({.normal = {0, 0, 1}, .at = 0, .k = 1e6, .b = 5, .mu = mu});
  return set;
}
VirtualTool::Pulls pressed(double k_across, double anchor_across) {
  VirtualTool::Pulls pulls{};
  pulls[2].spring(400, -0.01);
  pulls[0].spring(k_across, anchor_across);
  return pulls;
}
constexpr double kPress = 4 / (1 + 400e-6);  // [N]; the floor yields by 4 um

TEST(Friction, SticksBelowMuTimesTheNormalForce) {
  VirtualTool tool({.m = 0.02, .b = 5}, 3, floor_with(0.3));
  for (int i = 0; i < 3000; ++i) tool.step(kT, pressed(100, 0));
  for (int i = 0; i < 3000; ++i) tool.step(kT, pressed(100, 0.01));  // 1.0 N of at most 1.2 N
  EXPECT_NEAR(tool.x(0), 0, 1e-6);
  EXPECT_NEAR(tool.surface_force()[0], -1, 1e-4) << "it gives back just the pull";
  EXPECT_NEAR(tool.surface_force()[2], kPress, 1e-3);
}

TEST(Friction, SlipsAboveMuTimesTheNormalForceAndStopsAtIt) {
  VirtualTool tool({.m = 0.02, .b = 5}, 3, floor_with(0.3));
  for (int i = 0; i < 3000; ++i) tool.step(kT, pressed(100, 0));
  for (int i = 0; i < 5000; ++i) tool.step(kT, pressed(100, 0.02));  // 2 N: slides until 100 (0.02 - x) = 1.2
  EXPECT_NEAR(tool.x(0), 0.02 - 0.3 * kPress / 100, 1e-5);
  EXPECT_NEAR(tool.surface_force()[0], -0.3 * kPress, 1e-3);
}

TEST(Friction, OpposesSlipWithMuTimesTheForceInEveryDirection) {
  for (const double angle : {0.0, 0.7, 2.0, 4.0}) {
    VirtualTool tool({.m = 0.02, .b = 2}, 3, floor_with(0.5));
    for (int i = 0; i < 2000; ++i) {
      VirtualTool::Pulls pulls = pressed(0, 0);
      pulls[0].spring(400, 0.05 * i * kT * std::cos(angle));
      pulls[1].spring(400, 0.05 * i * kT * std::sin(angle));
      tool.step(kT, pulls);
    }
    EXPECT_NEAR(std::hypot(tool.v(0), tool.v(1)), 0.05, 1e-4);
    EXPECT_NEAR(tool.surface_force()[0], -0.5 * kPress * std::cos(angle), 1e-3);
    EXPECT_NEAR(tool.surface_force()[1], -0.5 * kPress * std::sin(angle), 1e-3);
  }
}

TEST(Friction, DoesNotChatter) {
  VirtualTool tool({}, 3, floor_with(0.8));
  for (int i = 0; i < 3000; ++i) tool.step(kT, pressed(400, 0.005));
  double most = 0, before = tool.surface_force()[0], change = 0;
  for (int i = 0; i < 1000; ++i) {
    tool.step(kT, pressed(400, 0.005));
    most = std::max(most, std::abs(tool.v(0)));
    change = std::max(change, std::abs(tool.surface_force()[0] - before));
    before = tool.surface_force()[0];
  }
  EXPECT_LT(most, 1e-7);
  EXPECT_LT(change, 1e-6);
}

/// Damping that differs by axis, as it does beside a stiff surface. The friction is still bounded by mu times the
/// force.
TEST(Friction, IsBoundedAlsoWhereAxesDiffer) {
  VirtualTool tool({.m = 0.02, .b = 0.2}, 3, floor_with(0.5));
  for (int i = 0; i < 2000; ++i) {
    VirtualTool::Pulls pulls = pressed(0, 0);
    pulls[0].spring(400, 0.05 * i * kT);
    pulls[0].damper(50, 0.05);
    pulls[1].spring(2000, 0.05 * i * kT + 0.002 * std::sin(0.05 * i));
    tool.step(kT, pulls);
    const auto& f = tool.surface_force();
    ASSERT_LE(std::hypot(f[0], f[1]), 0.5 * f[2] * 1.001 + 1e-6) << i;
  }
}

TEST(Friction, NeedsATangentialAxis) {
  ContactSet wall;
  wall.add({.normal = {-1, 0, 0}, .at = 0, .k = 20000, .mu = 1});
  VirtualTool tool({}, 1, wall);
  VirtualTool::Pulls pulls{};
  pulls[0].spring(400, 0.0102);
  for (int i = 0; i < 5000; ++i) tool.step(kT, pulls);
  EXPECT_NEAR(tool.x(0), 0.0002, 1e-9);
}

// Property: with up to three rough surfaces in any pose, no step raises the energy of mass, springs and surfaces. Where
// the springs of all axes are equal, as a hand's are, the friction of one surface is at most mu times its force.
TEST(Friction, CreatesNoEnergyInAnyStep) {
  const RandomKey key{20261123};
  const std::uint64_t cases = test::seeds(300);
  int dragged = 0;
  for (std::uint64_t c = 0; c < cases; ++c) {
    std::uint64_t n = 0;
    const auto draw = [&](double low, double high) { return low + (high - low) * key.derive(c).uniform(n++); };
    ContactSet set;
    const int surfaces = 1 + static_cast<int>(draw(0, 2.99));
    for (int s = 0; s < surfaces; ++s) {
      std::array<double, 3> normal{draw(-1, 1), draw(-1, 1), draw(-1, 1)};
      const double length = std::sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
      for (double& part : normal) part /= length;
      set.add({.normal = normal,
               .at = draw(-0.005, 0.005),
               .k = std::pow(10, draw(1, 6)),
               .b = draw(0, 50),
               .mu = draw(0, 2)});
    }
    VirtualTool tool({.m = std::pow(10, draw(-3, 0)), .b = draw(0, 2)}, 3, set);
    tool.rest_at({draw(-0.01, 0.01), draw(-0.01, 0.01), draw(-0.01, 0.01)});
    VirtualTool::Pulls pulls{};
    std::array<double, 3> k{}, anchor{};
    const bool alike = draw(0, 1) < 0.5;
    for (std::size_t a = 0; a < 3; ++a)
      pulls[a].spring(k[a] = alike && a > 0 ? k[0] : std::pow(10, draw(0, 4)), anchor[a] = draw(-0.02, 0.02));
    const auto stored = [&] {
      double sum = 0;
      for (std::size_t a = 0; a < 3; ++a) {
        sum += 0.5 * tool.gains().m * tool.v(a) * tool.v(a) +
               0.5 * k[a] * (anchor[a] - tool.x(a)) * (anchor[a] - tool.x(a));
      }
      for (std::size_t s = 0; s < set.size(); ++s) {
        const double d = std::max(0.0, set[s].penetration({tool.x(0), tool.x(1), tool.x(2)}));
        sum += 0.5 * set[s].k * d * d;
      }
      return sum;
    };
    double before = stored();
    for (int i = 0; i < 200; ++i) {
      ASSERT_TRUE(tool.step(kT, pulls));
      const double now = stored();
      ASSERT_LE(now, before * (1 + 1e-9) + 1e-12) << "case " << c << " step " << i;
      before = now;
      if (surfaces > 1 || !alike || tool.penetration() <= 0) continue;
      const auto& f = tool.surface_force();
      const double along = f[0] * set[0].normal[0] + f[1] * set[0].normal[1] + f[2] * set[0].normal[2];
      const double square = f[0] * f[0] + f[1] * f[1] + f[2] * f[2] - along * along;
      ASSERT_LE(std::sqrt(std::max(0.0, square)), set[0].mu * along * (1 + 1e-4) + 1e-6)
          << "case " << c << " step " << i;
      dragged += square > 0.01 ? 1 : 0;
    }
  }
  EXPECT_GT(dragged, 500);
}

TEST(Friction, RunsWithoutHeap) {
  VirtualTool tool({}, 3, floor_with(0.3));
  const test::AllocGuard guard;
  for (int i = 0; i < 100; ++i) tool.step(kT, pressed(400, 1e-4 * i));
  EXPECT_EQ(guard.count(), 0u);
}

}  // namespace
}  // namespace tandem::control
