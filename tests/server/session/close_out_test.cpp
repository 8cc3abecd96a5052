// The orderly end of a connection: 150 ms to ramp out, then CLOSE in 20 ticks.
#include "server/session/close_out.h"

#include <gtest/gtest.h>

namespace tandem::server {
namespace {

TEST(CloseOut, SendsCloseIn20TicksAfterTheRampAndIsOverInTheNext) {
  for (const auto& [hz, ramp] : {std::pair{1000.0, 150}, {100.0, 15}}) {
    CloseOut close;
    EXPECT_FALSE(close.begun() || close.over() || close.sends_close() || close.step());
    close.begin(wire::CloseReason::kRevoked, 1 / hz);
    EXPECT_EQ(close.reason(), wire::CloseReason::kRevoked);
    int silent = 0, closes = 0;
    while (!close.step()) {
      EXPECT_TRUE(close.begun() && close.in_progress() && !close.over());
      ++(close.sends_close() ? closes : silent);
      ASSERT_LT(silent + closes, 1000);
    }
    EXPECT_EQ(silent, ramp);
    EXPECT_EQ(closes, 20);
    EXPECT_TRUE(close.over() && close.sends_close() && !close.in_progress());
    EXPECT_FALSE(close.step()) << "it ends once";
    EXPECT_TRUE(close.over());
  }
}

TEST(CloseOuts, PreferTheReasonOfTheSessionToThatOfASeat) {
  CloseOuts all;
  EXPECT_EQ(all.due(0), nullptr);
  all.seats[1].begin(wire::CloseReason::kRemoved, 0.001);
  EXPECT_EQ(all.due(1), nullptr) << "its gate ramps out first";
  for (int n = 0; n < 151; ++n) all.seats[1].step();
  ASSERT_EQ(all.due(1), &all.seats[1]);
  EXPECT_EQ(all.due(0), nullptr) << "another seat";
  all.session.begin(wire::CloseReason::kDone, 0.001);
  EXPECT_EQ(all.due(1), &all.seats[1]) << "until the session itself sends CLOSE";
  for (int n = 0; n < 151; ++n) all.session.step();
  EXPECT_EQ(all.due(1), &all.session);
  EXPECT_EQ(all.due(0), &all.session);
}

}  // namespace
}  // namespace tandem::server
