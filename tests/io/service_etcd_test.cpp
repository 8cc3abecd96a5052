// Failures of etcd while hands press in a session of the service over it: its leader is killed together with the
// session's owner, most of its members fail, its history is compacted, its disks are slow.
#include "tests/common/base/counts.h"
#include "tests/io/pressing_service.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

class ServiceEtcd : public PressingServiceTest {};

void kill(Process& process) {
  process.signal(SIGKILL);
  ASSERT_EQ(process.wait(), -SIGKILL);
}

TEST_F(ServiceEtcd, LeaderAndOwnerKilledTogetherKeepNoHandAwayForMoreThan12Seconds) {
  const std::size_t rounds = draws(3, 20, 50);
  PressingService pressed(3);
  LiveService& service = pressed.service();
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  std::vector<double> back;
  for (std::size_t n = 0; n < rounds; ++n) {
    const std::string owner = pressed.witness().owner(), standby = owner == "a" ? "b" : "a";
    const std::size_t leader = service.etcds().leader();
    Process& etcd = service.etcd(leader).process();
    etcd.signal(SIGKILL);
    service.of(owner).signal(SIGKILL);
    back.push_back(pressed.wait_until_active(standby));
    ASSERT_EQ(etcd.wait(), -SIGKILL);
    ASSERT_EQ(service.of(owner).wait(), -SIGKILL);
    ASSERT_TRUE(service.of(standby).wait_for("session lab RESTORED from its checkpoint")) << service.of(standby).err();
    service.etcd(leader).start();
    ASSERT_TRUE(service.start(owner).wait_for("is a member of the service")) << service.of(owner).err();
    std::this_thread::sleep_for(milliseconds(3500));  // until a standby is named, and the etcd is whole
  }
  const std::vector<Absence> all = pressed.expect_safe(rounds);
  ASSERT_GE(all.size(), 2 * rounds);
  for (const Absence& absence : all) EXPECT_LE(absence.back_s, 12);
  print("leader and owner: killed until all are active [s]", back);
  print("leader and owner: release to active [s], asked <= 12", values(all, &Absence::back_s));
}

TEST_F(ServiceEtcd, WithoutItsQuorumHandsAreFreeAndTheOwnerGoesOnWhenItIsBack) {
  PressingService pressed(3);
  LiveService& service = pressed.service();
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  const std::size_t leader = service.etcds().leader();
  for (std::size_t n = 0; n < 2; ++n) kill(service.etcd((leader + n) % 3).process());
  ASSERT_TRUE(service.of("a").wait_for("1 session HELD")) << service.of("a").err();
  pressed.wait_until_released("a");
  std::this_thread::sleep_for(milliseconds(4000));  // longer than the lease
  for (const char* server : {"a", "b"})
    EXPECT_EQ(pressed.witness().newest(server).engaged, 0U) << "a hand is engaged without the directory";
  for (std::size_t n = 0; n < 2; ++n) service.etcd((leader + n) % 3).start();
  pressed.wait_until_active("a");
  ASSERT_TRUE(service.of("a").wait_for("not HELD by the directory any more")) << service.of("a").err();
  const std::vector<Absence> all = pressed.expect_safe(0);
  ASSERT_FALSE(all.empty());
  EXPECT_EQ(service.of("a").err().find("GIVEN UP"), std::string::npos) << service.of("a").err();
}

/// The revision of etcd now.
std::string revision_of(const Etcd& etcd) {
  const Json status = Json::parse(etcd.etcdctl({"endpoint", "status", "-w", "json"}), nullptr, false);
  return std::to_string(status[0]["Status"]["header"]["revision"].get<std::int64_t>());
}

/// A watch that begins again after the restart of etcd asks for changes that the compaction has removed.
TEST_F(ServiceEtcd, ServerThatMissedCompactedChangesReadsAllAgainAndFollows) {
  PressingService pressed;
  LiveService& service = pressed.service();
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  Process& owner = service.of("a");
  owner.signal(SIGSTOP);  // its watch stands still
  kill(service.etcd().process());
  service.etcd().start();
  directory::EtcdOptions options;
  options.endpoints = {service.etcd().endpoint()};
  directory::EtcdDirectory through(options);
  service.etcd().wait_until_ready(through);
  // An order that the owner can learn of only by reading, because the change itself is not in the history any more.
  static_cast<void>(service.etcd().etcdctl({"put", "/tandem/v1/catalogue/lab/move", "b"}));
  static_cast<void>(service.etcd().etcdctl({"put", "/tandem/v1/other", "x"}));
  static_cast<void>(service.etcd().etcdctl({"compact", revision_of(service.etcd())}));
  owner.signal(SIGCONT);
  pressed.wait_until_active("b");
  // A compaction under watches that stand and are not broken.
  service.of("b").signal(SIGSTOP);
  static_cast<void>(service.etcd().etcdctl({"put", "/tandem/v1/catalogue/lab/move", "a"}));
  static_cast<void>(service.etcd().etcdctl({"compact", revision_of(service.etcd())}));
  std::this_thread::sleep_for(milliseconds(1000));  // shorter than the lease
  service.of("b").signal(SIGCONT);
  pressed.wait_until_active("a");
  EXPECT_EQ(service.etcd().etcdctl({"get", "--print-value-only", "/tandem/v1/catalogue/lab/move"}), "\n");
  // At least one reconnection for each move; a client may also come back to a server that has just gone on.
  const std::vector<Absence> all = pressed.expect_safe(std::nullopt);
  ASSERT_GE(all.size(), 4U);
}

/// Delays each sync of a process's files by a second, as long as it lives.
class SlowDisk {
 public:
  explicit SlowDisk(const Process& of)
      : strace_({"/usr/bin/strace", "-f", "-e", "trace=fdatasync,fsync", "-e",
                 "inject=fdatasync,fsync:delay_enter=1000000", "-p", std::to_string(of.id())}) {}
  ~SlowDisk() {
    strace_.signal(SIGINT);  // detaches
    static_cast<void>(strace_.wait());
  }
  SlowDisk(const SlowDisk&) = delete;
  SlowDisk& operator=(const SlowDisk&) = delete;
  /// Why it does not work here; empty: it does.
  [[nodiscard]] std::string problem() { return strace_.wait_for("attached") ? "" : strace_.err(); }
  /// Waits until a sync was delayed.
  [[nodiscard]] bool delayed() { return strace_.wait_for("(DELAYED)"); }

 private:
  Process strace_;
};

TEST_F(ServiceEtcd, SlowDisksCostTimeAndNeverSafety) {
  if (!std::filesystem::exists("/usr/bin/strace")) GTEST_SKIP() << "strace is not installed (Debian: strace)";
  PressingService pressed(3);
  LiveService& service = pressed.service();
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  const std::size_t leader = service.etcds().leader();
  for (const std::size_t slow : {std::size_t{1}, std::size_t{3}}) {
    std::vector<std::unique_ptr<SlowDisk>> disks;
    for (std::size_t n = 0; n < slow; ++n) {
      disks.push_back(std::make_unique<SlowDisk>(service.etcd((leader + n) % 3).process()));
      if (const std::string why = disks.back()->problem(); !why.empty()) GTEST_SKIP() << "no ptrace here: " << why;
    }
    for (auto& disk : disks) EXPECT_TRUE(disk->delayed());
    std::this_thread::sleep_for(std::chrono::seconds(12));
    disks.clear();
    const double taken = pressed.wait_until_active();
    std::printf("[  figures ] %zu of 3 disks slow for 12 s: hands are active %.2f s afterwards\n", slow, taken);
    std::this_thread::sleep_for(milliseconds(2000));
  }
  const std::vector<Absence> all = pressed.expect_safe(std::nullopt);
  if (!all.empty()) print("slow disks: release to wholly active [s]", values(all, &Absence::back_s));
  static_cast<void>(service.of("a").wait_for(" HELD"));
  std::printf("[  figures ] slow disks: server a says HELD: %s, GIVEN UP: %s\n",
              service.of("a").err().find("HELD:") != std::string::npos ? "yes" : "no",
              service.of("a").err().find("GIVEN UP") != std::string::npos ? "yes" : "no");
}

}  // namespace
}  // namespace tandem::test
