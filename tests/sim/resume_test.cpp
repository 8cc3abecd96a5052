// Hands that go on moving while a server restarts feel no step, and little beside the session without a restart
// (ARCHITECTURE.md, invariants 222 and 223). tests/bench/resume_table prints the figures.
#include <gtest/gtest.h>

#include "tests/sim/resume_cell.h"

namespace tandem::test {
namespace {

constexpr std::uint64_t kSeeds = 3;

class Resume : public testing::TestWithParam<double> {
 protected:
  template <typename Check>
  void each(const Check& check) {
    for (const Moving moving : {Moving::kCircle, Moving::kReaches, Moving::kRests})
      for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
        const ResumeCase run{.moving = moving, .one_way_ms = GetParam(), .seed = seed};
        SCOPED_TRACE(std::string(kMovingNames[static_cast<std::size_t>(moving)]) + ", seed " + std::to_string(seed));
        const Resumed with = resumed(run);
        check(with, undisturbed(run, with));
      }
  }
};

TEST_P(Resume, LeavesAMovingHandWithTheDampingOfTheRampAlone) {
  each([](const Resumed& with, const Resumed& without) {
    const ResumedHand &hand = with.hands[0], &other = without.hands[0];
    EXPECT_EQ(hand.first, 0);
    EXPECT_LE(hand.force, other.force + 1.1) << "5 N s/m fade within 0.5 s; a tool that returns adds nothing [N]";
    EXPECT_LE(hand.force_rms, other.force_rms + 0.25);
    EXPECT_LE(hand.step, other.step + 0.012) << "10 N/s above what the hand itself causes [N/ms]";
    EXPECT_LE(hand.after_4, other.after_4 + 1e-3);
    EXPECT_LE(with.tool_speed, without.tool_speed + 0.18) << "the approach speed in two axes, and noise [m/s]";
  });
}

TEST_P(Resume, GivesAFollowingHandNothingThatTheRampHeldBack) {
  each([](const Resumed& with, const Resumed& without) {
    const ResumedHand &hand = with.hands[1], &other = without.hands[1];
    EXPECT_EQ(hand.first, 0);
    EXPECT_LE(hand.force, other.force + 1.1);
    EXPECT_LE(hand.step, other.step + 0.3) << "1 N per ms where the force of the ramp lags behind its spring [N/ms]";
    EXPECT_LE(hand.after_4, other.after_4 + 1e-3);
  });
}

INSTANTIATE_TEST_SUITE_P(Delays, Resume, testing::Values(0.3, 5.0, 20.0),
                         [](const auto& p) { return std::to_string(static_cast<int>(p.param)) + "ms"; });

}  // namespace
}  // namespace tandem::test
