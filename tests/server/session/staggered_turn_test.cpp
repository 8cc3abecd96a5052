#include "server/session/staggered_turn.h"

#include <gtest/gtest.h>

#include <array>
#include <vector>

namespace tandem::server {
namespace {

std::vector<std::uint32_t> turns(StaggeredTurn& turn, std::uint32_t begin, std::uint32_t end, std::uint32_t interval) {
  std::vector<std::uint32_t> out;
  for (std::uint32_t tick = begin; tick != end; ++tick)
    if (turn.begins(tick, interval)) out.push_back(tick - begin);
  return out;
}

TEST(StaggeredTurn, RecursAtMultiplesOfItsIntervalShiftedByItsPhase) {
  StaggeredTurn plain, shifted;
  shifted.set_phase(4);
  EXPECT_EQ(turns(plain, 0, 40, 17), (std::vector<std::uint32_t>{0, 17, 34}));
  EXPECT_EQ(turns(shifted, 0, 40, 17), (std::vector<std::uint32_t>{13, 30}));
  StaggeredTurn every;
  EXPECT_EQ(turns(every, 5, 9, 1), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(StaggeredTurn, OfDifferentPhasesNeverMeetsInOneTick) {
  std::array<StaggeredTurn, 17> turns;
  for (std::uint32_t i = 0; i < turns.size(); ++i) turns[i].set_phase(1000 + i);
  for (std::uint32_t tick = 0; tick < 500; ++tick) {
    int now = 0;
    for (StaggeredTurn& turn : turns) now += turn.begins(tick, 17) ? 1 : 0;
    ASSERT_EQ(now, 1) << tick;
  }
}

TEST(StaggeredTurn, BeginsOnceAfterMissedTicksAndThenOnTime) {
  StaggeredTurn turn;
  EXPECT_TRUE(turn.begins(0, 10));
  EXPECT_TRUE(turn.begins(35, 10)) << "late";
  EXPECT_EQ(turns(turn, 36, 60, 10), (std::vector<std::uint32_t>{4, 14})) << "at the ticks 40 and 50";
  EXPECT_TRUE(turn.begins(60 + 0x90000000U, 10)) << "after any silence";
}

TEST(StaggeredTurn, FollowsAChangedIntervalAtOnce) {
  StaggeredTurn turn;
  EXPECT_TRUE(turn.begins(0, 500));
  EXPECT_EQ(turns(turn, 1, 40, 17), (std::vector<std::uint32_t>{16, 33}));
}

TEST(StaggeredTurn, WrapsWithTheNumberOfTheTick) {
  StaggeredTurn turn;
  const std::uint32_t last = ~std::uint32_t{0};
  const auto seen = turns(turn, last - 99, 100, 8);  // 2^32 is a multiple of 8
  ASSERT_EQ(seen.size(), 25u);
  for (std::size_t i = 1; i < seen.size(); ++i) EXPECT_EQ(seen[i] - seen[i - 1], 8u);
}

}  // namespace
}  // namespace tandem::server
