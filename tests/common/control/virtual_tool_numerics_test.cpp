// A simulated tool with other numerics than one implicit step: parts, surfaces, accounts, input that is not finite.
#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "common/control/virtual_tool.h"
#include "tests/support/alloc_guard.h"

namespace tandem::control {
namespace {

constexpr double kT = 0.001;

ContactSet bone(double mu = 0) {
  ContactSet set;
  set.add({.normal = {-1, 0, 0}, .at = 0, .k = 20000, .b = 5, .mu = mu});  // beyond x = 0
  return set;
}
VirtualTool::Pulls pull_to(double x, double y = 0, double z = 0) {
  VirtualTool::Pulls pulls{};
  pulls[0].spring(400, x);
  pulls[1].spring(400, y);
  pulls[2].spring(400, z);
  for (Pull& pull : pulls) pull.damper(14, 0);
  return pulls;
}
struct Case {
  Numerics numerics;
  std::string name;
};
std::vector<Case> every_choice(std::uint8_t substeps) {
  std::vector<Case> out;
  for (std::size_t i = 0; i < kIntegrators; ++i)
    for (std::size_t p = 0; p < kPrecisionNames.size(); ++p)
      out.push_back({{static_cast<Integrator>(i), static_cast<Precision>(p), substeps},
                     std::string(kIntegratorNames[i]) + " " + std::string(kPrecisionNames[p])});
  return out;
}

TEST(VirtualToolNumerics, SubstepsOfTheDefaultAreItsOwnShorterSteps) {
  VirtualTool parts({}, 3, bone(0.3), {.substeps = 4}), steps({}, 3, bone(0.3));
  EXPECT_TRUE(parts.in_parts());
  EXPECT_FALSE(steps.in_parts());
  double squares = 0;
  for (int i = 0; i < 500; ++i) {
    const auto pulls = pull_to(0.01 * std::sin(0.02 * i), 0.005 * std::cos(0.03 * i));
    const VirtualTool::Parts account = parts.step_in_parts(kT, pulls);
    ASSERT_TRUE(account.finite);
    squares = 0;
    for (int part = 0; part < 4; ++part) {
      steps.step(kT / 4, pulls);
      squares += steps.v(1) * steps.v(1) * kT / 4;
    }
    for (std::size_t a = 0; a < 3; ++a) {
      ASSERT_EQ(parts.x(a), steps.x(a)) << i;
      ASSERT_EQ(parts.v(a), steps.v(a)) << i;
    }
    ASSERT_DOUBLE_EQ(account.squares[1], squares);
    ASSERT_DOUBLE_EQ(parts.heat(account, 1, 0.2, 300, kT), (0.2 + 0.5 * 300 * kT / 4) * squares);
  }
  EXPECT_GT(squares, 0);
}

TEST(VirtualToolNumerics, EveryChoiceRestsWhereSpringAndSurfaceBalance) {
  for (const Case& c : every_choice(4)) {  // 4 steps: the explicit methods are stable on bone
    VirtualTool tool({}, 3, bone(), c.numerics);
    for (int i = 0; i < 4000; ++i) ASSERT_TRUE(tool.step(kT, pull_to(0.0102, 0.003))) << c.name;
    const bool coarse = c.numerics.precision == Precision::kFloat;
    EXPECT_NEAR(tool.x(0), 0.0002, coarse ? 5e-8 : 1e-12) << c.name;  // 400 (0.0102 - x) = 20000 x
    EXPECT_NEAR(tool.x(1), 0.003, coarse ? 5e-8 : 1e-12) << c.name;
    EXPECT_NEAR(tool.surface_force()[0], -4, coarse ? 2e-4 : 1e-8) << c.name;
    EXPECT_NEAR(tool.relative_damping_share(0, 14, 0, 400, 0), 5.2 * 400 / 20000 / 14, 1e-12) << c.name;
  }
}

// A surface along no axis couples the axes. Seen along its normal, the tool moves as at a surface along one axis.
TEST(VirtualToolNumerics, MeetsSurfacesInAnyDirectionAlike) {
  const double s = std::sqrt(0.5);
  for (const Case& c : every_choice(4)) {
    ContactSet oblique;
    oblique.add({.normal = {-s, -s, 0}, .at = 0, .k = 20000, .b = 5});
    VirtualTool turned({}, 3, oblique, c.numerics), straight({}, 3, bone(), c.numerics);
    const bool coarse = c.numerics.precision == Precision::kFloat;
    for (int i = 0; i < 300; ++i) {
      const double to = 0.004 * std::sin(0.05 * i), across = 0.002 * std::sin(0.03 * i);
      turned.step(kT, pull_to(s * (to - across), s * (to + across)));
      straight.step(kT, pull_to(to, across));
      ASSERT_NEAR(s * (turned.x(0) + turned.x(1)), straight.x(0), coarse ? 2e-6 : 1e-11) << c.name << " " << i;
      ASSERT_NEAR(s * (turned.x(1) - turned.x(0)), straight.x(1), coarse ? 2e-6 : 1e-11) << c.name << " " << i;
    }
  }
}

TEST(VirtualToolNumerics, IsNeverPulledByASurface) {
  for (const Case& c : every_choice(8)) {
    VirtualTool tool({.m = 0.02, .b = 0}, 1, bone(), c.numerics);
    for (int i = 0; i < 1000; ++i) tool.step(kT, pull_to(0.005));
    for (int i = 0; i < 50; ++i) {
      tool.step(kT, pull_to(-0.05));
      ASSERT_LE(tool.surface_force()[0], 0) << c.name;
    }
    EXPECT_LT(tool.x(0), -0.01) << c.name;
  }
}

TEST(VirtualToolNumerics, CreditsHeatOnlyWithTheProof) {
  for (const Case& c : every_choice(2)) {
    VirtualTool tool({}, 1, {}, c.numerics);
    const VirtualTool::Parts parts = tool.step_in_parts(kT, pull_to(0.01));
    ASSERT_GT(parts.squares[0], 0) << c.name;
    EXPECT_EQ(tool.heat(parts, 0, 1, 0, kT) > 0, c.numerics.keeps_proof()) << c.name;
  }
}

TEST(VirtualToolNumerics, StaysWhereItWasAfterInputThatIsNotFinite) {
  for (const Case& c : every_choice(3)) {
    VirtualTool tool({}, 3, bone(), c.numerics);
    for (int i = 0; i < 20; ++i) tool.step(kT, pull_to(0.01, 0.02, -0.01));
    const double x = tool.x(1);
    ASSERT_NE(x, 0);
    for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      auto pulls = pull_to(0.01);
      pulls[1].k_anchor = bad;
      EXPECT_FALSE(tool.step(kT, pulls)) << c.name;
      EXPECT_EQ(tool.x(1), x) << c.name;
      EXPECT_EQ(tool.v(1), 0) << c.name;
    }
    EXPECT_TRUE(tool.step(kT, pull_to(0.01))) << c.name;
  }
}

TEST(VirtualToolNumerics, RunsWithoutHeap) {
  for (const Case& c : every_choice(2)) {
    VirtualTool tool({}, 3, bone(), c.numerics);
    const auto pulls = pull_to(0.005, 0.01);
    const test::AllocGuard guard;
    for (int i = 0; i < 100; ++i) tool.step(kT, pulls);
    EXPECT_EQ(guard.count(), 0u) << c.name;
  }
}

// The default has no part of the others: neither more state, nor another result.
TEST(VirtualToolNumerics, TheDefaultIsTheImplicitStep) {
  static_assert(Numerics{}.is_default());
  static_assert(!Numerics{.substeps = 2}.is_default() && Numerics{.substeps = 2}.keeps_proof());
  static_assert(!Numerics{.precision = Precision::kFloat}.keeps_proof());
  VirtualTool tool({.m = 0.05, .b = 0.2}, 1, {}, Numerics{});
  VirtualTool::Pulls pulls{};
  pulls[0].spring(400, 0.01);
  ASSERT_TRUE(tool.step(kT, pulls));
  EXPECT_EQ(tool.v(0), 0.001 * (400 * 0.01) / (0.05 + 0.001 * 0.2 + 0.001 * 0.001 * 400));
}

}  // namespace
}  // namespace tandem::control
