#include "common/control/hand_coupling.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <set>
#include <string>
#include <vector>

namespace tandem::control {
namespace {

constexpr double kK = 500;

/// One axis: hands at 10 and 40 mm with authority 0.8 and 0.2, which pull with 1 and -2 N; the tool at 20 mm, pushed
/// back by its surroundings with -3 N.
struct Two {
  std::array<CoupledBody, 2> hands{};
  CoupledBody tool;
  HandCouplingParams params{.axes = 1, .k = kK, .saturation = 4, .v_app = 0.1, .dt = 0.001};

  Two() {
    hands[0] = {.x = {0.01}, .v = {0.1}, .f = {1}, .alpha = 0.8};
    hands[1] = {.x = {0.04}, .v = {0.4}, .f = {-2}, .alpha = 0.2};
    tool = {.x = {0.02}, .v = {0.2}, .f = {-3}};
  }
  [[nodiscard]] double x(HandCoupling coupling, std::size_t i, double last = 0) const {
    return coupled_target(coupling, params, hands, i, tool, {.x = {last}}).x[0];
  }
  [[nodiscard]] double v(HandCoupling coupling, std::size_t i) const {
    return coupled_target(coupling, params, hands, i, tool, {}).v[0];
  }
};

TEST(HandCouplings, MatchTheirEquationsForTwoHands) {
  const Two two;
  // 1/2 (0.8 * 20 + 0.2 * 40) + 1/2 (10 + (0.8 * -3 + 0.2 * -2) N / 500 N/m) = 12 + 5 - 2.8 mm
  EXPECT_NEAR(two.x(HandCoupling::kClc, 0), 0.0142, 1e-15);
  // 1/2 (0.2 * 20 + 0.8 * 10) + 1/2 (40 + (0.2 * -3 + 0.8 * 1) N / 500 N/m) = 6 + 20 + 0.2 mm
  EXPECT_NEAR(two.x(HandCoupling::kClc, 1), 0.0262, 1e-15);
  EXPECT_NEAR(two.v(HandCoupling::kClc, 0), 0.8 * 0.2 + 0.2 * 0.4, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kMcet, 0), 0.5 * (0.04 + 0.01 - 0.006), 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kMcet, 1), 0.5 * (0.01 + 0.04 - 0.006), 1e-15);
  // The disagreement of 30 mm, scaled by the other's authority, pulls both towards the same point.
  EXPECT_NEAR(two.x(HandCoupling::kNudehi, 0), 0.016, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kNudehi, 1), 0.016, 1e-15);
  const double pull = 0.8 * 4 * std::tanh(500 * 0.01 / 4) + 0.2 * 4 * std::tanh(500 * 0.03 / 4);
  EXPECT_NEAR(two.x(HandCoupling::kNpdSaturated, 0), 0.01 + pull / kK, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kPdPeer, 0), 0.04, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kPdPeer, 1), 0.01, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kAveragePosition, 0), 0.025, 1e-15);
  EXPECT_NEAR(two.v(HandCoupling::kAveragePosition, 1), 0.25, 1e-15);
}

TEST(HandCouplings, FeelTheContactOnceWhenHandsAndToolStandStill) {  // a leader who presses: k (x_1 - x_s) = -F_e
  Two two;
  two.hands[0] = {.x = {0.026}, .v = {}, .f = {3}, .alpha = 1};
  two.hands[1].alpha = 0;
  two.hands[1].x = two.tool.x;
  for (const HandCoupling coupling : {HandCoupling::kClc, HandCoupling::kMcet})
    EXPECT_NEAR(kK * (two.x(coupling, 0) - 0.026), -3, 1e-12) << row_of(coupling).name;
}

TEST(HandCouplings, TheTargetOfABoundedDelayRateMovesNoFasterThanTheBodies) {
  const Two two;
  const double goal = 0.8 * 0.02 + 0.2 * 0.04, speed = 0.8 * 0.2 + 0.2 * 0.4;
  EXPECT_NEAR(two.x(HandCoupling::kPdVariableDelay, 0, 0), (1.5 * speed + 0.1) * 0.001, 1e-15);
  EXPECT_NEAR(two.x(HandCoupling::kPdVariableDelay, 0, goal + 1e-5), goal, 1e-15);
}

TEST(HandCouplings, SaturatedSpringsPullWithAtMostTheirLimit) {
  Two two;
  two.hands[1].x[0] = 50;
  two.tool.x[0] = 50;
  EXPECT_NEAR(kK * (two.x(HandCoupling::kNpdSaturated, 0) - 0.01), 4, 1e-9);
}

TEST(HandCouplings, HandsOfOnePlaceStayThereUnderEveryCoupling) {
  for (std::size_t n = 1; n <= 8; ++n) {
    std::vector<CoupledBody> hands(n);
    CoupledBody tool;
    tool.x[0] = 0.03;
    for (CoupledBody& hand : hands) hand = {.x = {0.03}, .v = {}, .f = {}, .alpha = 1.0 / static_cast<double>(n)};
    for (std::size_t c = 0; c < kHandCouplings; ++c) {
      const auto coupling = static_cast<HandCoupling>(c);
      if (n > row_of(coupling).hands_max) continue;
      for (std::size_t i = 0; i < n; ++i) {
        const CoupledTarget target = coupled_target(coupling, {.axes = 1, .k = kK}, hands, i, tool, {.x = {0.03}});
        EXPECT_NEAR(target.x[0], 0.03, 1e-15) << row_of(coupling).name << ", " << n << " hands";
        EXPECT_EQ(target.v[0], 0);
      }
    }
  }
}

TEST(HandCouplings, HaveDistinctNames) {
  std::set<std::string_view> names;
  for (std::size_t c = 0; c < kHandCouplings; ++c) names.insert(row_of(static_cast<HandCoupling>(c)).name);
  EXPECT_EQ(names.size(), kHandCouplings);
  EXPECT_EQ(row_of(HandCoupling{}).name, "esc");
}

}  // namespace
}  // namespace tandem::control
