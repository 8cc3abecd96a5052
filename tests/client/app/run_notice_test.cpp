// "the session runs" is said once per break that a client has named.
#include "client/app/run_notice.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using State = wire::SessionState;

TEST(RunNotice, IsGivenAtTheBeginAndAfterANamedBreakOnly) {
  RunNotice notice;
  EXPECT_FALSE(notice.update(State::kWaiting, false));
  EXPECT_TRUE(notice.update(State::kRunning, false));
  for (int n = 0; n < 24; ++n) {
    EXPECT_FALSE(notice.update(State::kHeld, false));
    EXPECT_FALSE(notice.update(State::kRunning, false)) << "the tool was held for a moment that no status has";
  }
  notice.on_break();
  EXPECT_FALSE(notice.update(State::kWaiting, false));
  EXPECT_TRUE(notice.update(State::kRunning, false));
  notice.on_break();
  EXPECT_FALSE(notice.update(State::kRunning, true)) << "the server's status says so";
  EXPECT_FALSE(notice.update(State::kRunning, false));
}

}  // namespace
}  // namespace tandem::client
