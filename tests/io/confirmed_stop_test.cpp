// A stop that the server has confirmed is still there when the server was killed at the moment of the confirmation.
// Durations are printed, not asserted.
#include <gtest/gtest.h>
#include <signal.h>

#include <fstream>

#include "tests/common/base/counts.h"
#include "tests/io/free_address.h"
#include "tests/io/operator_console.h"
#include "tests/io/programs.h"
#include "tests/io/slow_disk.h"

namespace tandem::test {
namespace {

using Clock = std::chrono::steady_clock;

class ConfirmedStop : public ::testing::Test {
 protected:
  ConfirmedStop() { setenv("TANDEM_RUNTIME", folder.file("runtime").c_str(), 1); }
  ~ConfirmedStop() override { unsetenv("TANDEM_RUNTIME"); }

  /// An operator's console of a server of this user.
  static client::JoinOptions at(const std::string& address) {
    client::JoinOptions asking;
    asking.server = *io::parse_address(address, 0);
    return asking;
  }
  /// Restarts the server where it listened. @return whether it restored a stopped session
  bool restarts_stopped(Process& host) {
    EXPECT_EQ(host.wait(), -SIGKILL);
    host = hosting("free_motion", {"--listen", address});
    EXPECT_NE(host.err().find("RESTORED from its checkpoint"), std::string::npos) << host.err();
    return host.err().find(kStaysStopped) != std::string::npos;
  }

  Folder folder;
  std::string address = free_address();
};

TEST_F(ConfirmedStop, SurvivesAKillAtTheMomentOfItsConfirmation) {
  const std::size_t kills = draws(8, 50, 200);
  ConfirmationTimes latency;
  std::size_t kept = 0;
  for (std::size_t n = 0; n < kills; ++n) {
    Process host = hosting("free_motion", {"--listen", address});
    ASSERT_EQ(address_of(host), address) << host.err();
    Operator console(at(address));
    const bool pause = n % 4 == 3;
    const auto began = Clock::now();
    const auto reply = console.order(pause ? rpc::Body{rpc::PauseSession{console.session(), "test"}}
                                           : rpc::Body{rpc::StopSession{console.session(), "test"}});
    host.signal(SIGKILL);
    latency.add(Clock::now() - began);
    ASSERT_EQ(reply, "") << n;
    kept += restarts_stopped(host) ? 1 : 0;
    host.signal(SIGINT);
    ASSERT_TRUE(host.wait());
  }
  latency.print("stop of a session without hands", kept);
  EXPECT_EQ(kept, kills);
}

TEST_F(ConfirmedStop, SurvivesAKillWhileHandsAreEngagedAndSoDoesItsEnd) {
  const std::size_t kills = draws(3, 20, 50);
  ConfirmationTimes stops, resumes;
  std::size_t kept = 0, ended = 0;
  for (std::size_t n = 0; n < kills; ++n) {
    Process host = hosting("free_motion", {"--listen", address});
    Process trainer = client(address, "trainer"), trainee = client(address, "trainee");
    ASSERT_TRUE(host.wait_for("the session runs")) << host.err();
    Operator console(at(address));
    auto began = Clock::now();
    ASSERT_EQ(console.order(rpc::StopSession{console.session(), "test"}), "");
    host.signal(SIGKILL);
    stops.add(Clock::now() - began);
    kept += restarts_stopped(host) ? 1 : 0;
    // The restart counts as a stop, which ends into the one of before.
    Operator again(at(address));
    ASSERT_EQ(again.order(rpc::ResumeSession{again.session(), again.status().stops}), "");
    EXPECT_EQ(again.status().phase, rpc::SessionPhase::kStopped);
    const std::uint32_t newest = again.status().stops;
    began = Clock::now();
    ASSERT_EQ(again.order(rpc::ResumeSession{again.session(), newest}), "");
    host.signal(SIGKILL);
    resumes.add(Clock::now() - began);
    ended += restarts_stopped(host) ? 0 : 1;
    host.signal(SIGINT);
    ASSERT_TRUE(host.wait());
  }
  stops.print("stop of engaged hands", kept);
  resumes.print("resume", ended);
  EXPECT_EQ(kept, kills);
  EXPECT_EQ(ended, kills);
}

TEST_F(ConfirmedStop, IsAtOnceAndSaysSoWhereTheDiskIsFullOrStuck) {
  const std::string disk = folder.write("disk", "ok");
  Process host(on_slow_disk(disk, {TANDEM_SERVER, "run", "free_motion", "--listen", address}));
  ASSERT_TRUE(host.wait_for("Ctrl-C ends")) << host.err();
  Operator console(at(address)), other(at(address));
  ASSERT_EQ(console.order(rpc::StopSession{console.session(), "test"}), "");
  EXPECT_EQ(console.status().not_stored, "");
  std::ofstream(disk) << "nospace";
  const auto full = console.order(rpc::StopSession{console.session(), "test"});
  ASSERT_TRUE(full);
  EXPECT_EQ(
      full->find("the session is STOPPED, but this is not stored yet: the checkpoint file cannot be written: the "
                 "disk is full (No space left on device); free some space there, then repeat. If the server is killed"),
      0u)
      << *full;
  rpc::Status status = other.status();
  EXPECT_EQ(status.phase, rpc::SessionPhase::kStopped);
  EXPECT_NE(status.not_stored.find("No space left on device"), std::string::npos);
  ASSERT_FALSE(status.events.empty());
  EXPECT_NE(status.events.back().text.find("NOT STORED"), std::string::npos) << status.events.back().text;
  // The console of a person says it as well, and `--json` names the cause.
  Process said({TANDEM_CLIENT, "control", "--server", address, "stop"});
  EXPECT_EQ(said.wait(), 0) << said.err();
  EXPECT_NE(said.out().find("STOPPED: all hands are released"), std::string::npos) << said.out();
  EXPECT_NE(said.err().find("WARNING: the session is STOPPED, but this is not stored yet"), std::string::npos)
      << said.err();
  Process asked({TANDEM_CLIENT, "control", "--server", address, "--json", "status"});
  EXPECT_EQ(asked.wait(), 0) << asked.err();
  EXPECT_NE(Json::parse(asked.out()).value("not_stored", "").find("No space left on device"), std::string::npos)
      << asked.out();
  std::ofstream(disk) << "ok";
  EXPECT_EQ(console.order(rpc::StopSession{console.session(), "test"}), "");
  status = other.status();
  EXPECT_EQ(status.not_stored, "");
  EXPECT_NE(status.events.back().text.find("stored again"), std::string::npos) << status.events.back().text;

  std::ofstream(disk) << "stuck";
  const auto stuck = console.order(rpc::StopSession{console.session(), "test"});
  ASSERT_TRUE(stuck);
  EXPECT_NE(stuck->find("it is not written in time"), std::string::npos) << *stuck;
}

}  // namespace
}  // namespace tandem::test
