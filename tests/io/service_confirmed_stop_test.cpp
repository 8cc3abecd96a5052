// A stop that the owner of a session has confirmed is still there at the next owner. Durations are printed, not
// asserted.
#include "tests/common/base/counts.h"
#include "tests/io/operator_console.h"
#include "tests/io/service_fixture.h"

namespace tandem::test {
namespace {

using Clock = std::chrono::steady_clock;

class ServiceConfirmedStop : public ::testing::Test {
 protected:
  void SetUp() override {
    if (etcd_program("etcd").empty() || etcd_program("etcdctl").empty()) GTEST_SKIP() << kNoEtcd;
  }
  /// Starts servers a, which has session lab, and b.
  void start(int ttl_s) {
    service_.emplace("session { name: \"lab\" scene: \"free_motion\" }", 1, ttl_s);
    service_->start("a");
    service_->wait_for_sessions("a", 1);
    Process& b = service_->start("b");
    ASSERT_TRUE(b.wait_for("is a member of the service")) << b.err();
    own_ = service_->enrolled("desk");
  }
  /// An operator's console at a server, with a ticket of its own.
  [[nodiscard]] client::JoinOptions at(const std::string& name) const {
    client::JoinOptions asking;
    asking.server = *io::parse_address(address_of(service_->of(name)), 0);
    asking.session = "lab";
    asking.state = own_;
    asking.ticket = first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--workstation",
                                                 "desk", "--state", service_->folder().file(name)}));
    return asking;
  }

  std::optional<LiveService> service_;
  std::string own_;
};

TEST_F(ServiceConfirmedStop, SurvivesAKillOfTheOwnerAtTheMomentOfItsConfirmation) {
  ASSERT_NO_FATAL_FAILURE(start(3));
  LiveService& service = *service_;
  const std::size_t kills = draws(2, 10, 30);
  ConfirmationTimes stops, resumes;
  std::size_t kept = 0;
  std::string owner = "a", next = "b";
  for (std::size_t n = 0; n < kills; ++n, std::swap(owner, next)) {
    std::this_thread::sleep_for(std::chrono::milliseconds(2500));  // until the standby is named
    Operator console(at(owner));
    auto began = Clock::now();
    const auto reply = console.order(rpc::StopSession{console.session(), "test"});
    service.of(owner).signal(SIGKILL);
    stops.add(Clock::now() - began);
    ASSERT_EQ(reply, "") << n;
    service.of(owner).wait();
    service.wait_for_sessions(next, 1);
    ASSERT_TRUE(service.of(next).wait_for("session lab RESTORED")) << service.of(next).err();
    Operator again(at(next));
    kept += again.status().phase == rpc::SessionPhase::kStopped ? 1 : 0;
    began = Clock::now();
    EXPECT_EQ(again.order(rpc::ResumeSession{again.session(), again.status().stops}), "");
    resumes.add(Clock::now() - began);
    Process& back = service.start(owner);
    ASSERT_TRUE(back.wait_for("is a member of the service")) << back.err();
  }
  stops.print("stop in a service", kept);
  resumes.print("resume in a service", resumes.count);
  EXPECT_EQ(kept, kills);
}

TEST_F(ServiceConfirmedStop, SaysSoWhileTheDirectoryIsSilent) {
  ASSERT_NO_FATAL_FAILURE(start(20));  // longer than it is silent
  Process& etcd = service_->etcd().process();
  Operator console(at("a"));
  ASSERT_EQ(console.order(rpc::StopSession{console.session(), "test"}), "");
  etcd.signal(SIGSTOP);
  const auto silent = console.order(rpc::StopSession{console.session(), "test"});
  ASSERT_TRUE(silent);
  EXPECT_EQ(silent->find("the session is STOPPED, but this is not stored yet: "), 0u) << *silent;
  EXPECT_NE(silent->find("directory of "), std::string::npos) << *silent;
  etcd.signal(SIGCONT);
  for (int n = 0; n < 100 && !console.status().not_stored.empty(); ++n)
    std::this_thread::sleep_for(std::chrono::milliseconds(200));
  EXPECT_EQ(console.order(rpc::StopSession{console.session(), "test"}), "");
}

}  // namespace
}  // namespace tandem::test
