// The list of sessions for people.
#include "proto/rpc/session_list_text.h"

#include <gtest/gtest.h>

#include <string>

namespace tandem {
namespace {

TEST(SessionListText, SaysThatRunningSessionsMayBeHeldWhileTheDirectoryIsSilent) {
  rpc::SessionList list;
  list.sessions.push_back({{}, "lab", rpc::SessionPhase::kRunning, {}, "desk-b"});
  const std::string now = session_list_text(list);
  EXPECT_NE(now.find("lab: running, 0 of 0 seats free"), std::string::npos) << now;
  EXPECT_EQ(now.find("may be held"), std::string::npos) << now;
  list.old = true;
  const std::string old = session_list_text(list);
  EXPECT_NE(old.find("sessions of other servers may have changed, and running ones may be held"), std::string::npos)
      << old;
}

}  // namespace
}  // namespace tandem
