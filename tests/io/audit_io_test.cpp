// The state directory of a real server, and its monitoring endpoints.
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/stat.h>
#include <unistd.h>

#include <filesystem>
#include <thread>

#include "common/auth/io/append_file.h"
#include "common/auth/io/control_client.h"
#include "common/auth/io/directory_lock.h"
#include "common/auth/io/state_directory.h"
#include "tests/common/auth/faults/state_files.h"
#include "tests/io/metrics_page.h"
#include "tests/io/multi_client_fixture.h"

namespace tandem::test {
namespace {

namespace fs = std::filesystem;

constexpr const char* kLab = "metrics: \"127.0.0.1:0\" session { name: \"lab\" scene: \"free_motion\" }";

std::string metrics_of(Process& host) {
  const std::string at = host.after("metrics on http://");
  return at.substr(0, at.find('/'));
}

/// Repeats the request until the response contains `word`, or until the time limit.
bool comes_to_say(const std::string& address, const std::string& word, const char* path = "/metrics") {
  for (int i = 0; i < 300; ++i) {
    if (page(address, path).find(word) != std::string::npos) return true;
    std::this_thread::sleep_for(std::chrono::milliseconds(100));
  }
  return false;
}

std::size_t count(const std::string& text, const std::string& word) {
  std::size_t n = 0;
  for (auto at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) ++n;
  return n;
}

TEST(StateDirectoryLive, ReportsAnUnwritableAuditLogAsErrorMetricAndNotReady) {
  MultiClientFixture fixture{kLab};
  const std::string metrics = metrics_of(fixture.host), log = fixture.state + "/audit.log";
  ASSERT_TRUE(comes_to_say(metrics, "200 OK", "/readyz"));
  EXPECT_NE(page(metrics).find("tandem_audit_failing 0"), std::string::npos);
  fs::rename(log, log + ".aside");
  ASSERT_EQ(mkdir(log.c_str(), 0700), 0);
  Process stranger = fixture.join("trainee", {"--session", "AAAAABBBBB"});
  EXPECT_EQ(stranger.wait(), 1);
  EXPECT_TRUE(comes_to_say(metrics, "503", "/readyz"));
  EXPECT_TRUE(comes_to_say(metrics, "tandem_audit_failing 1"));
  EXPECT_EQ(page(metrics).find("tandem_audit_lost_total 0"), std::string::npos);
  EXPECT_TRUE(fixture.host.wait_for("the audit log fails")) << fixture.host.err();
  EXPECT_NE(page(metrics, "/healthz").find("200 OK"), std::string::npos) << "it lives, and sessions go on";
  ASSERT_EQ(rmdir(log.c_str()), 0);
  EXPECT_TRUE(comes_to_say(metrics, "200 OK", "/readyz"));
  EXPECT_TRUE(fixture.host.wait_for("the audit log is written again")) << fixture.host.err();
  EXPECT_NE(fixture.folder.read("state/audit.log").find("\"audit_lost\""), std::string::npos);
}

/// Codes are printed on terminals only.
TEST(StateDirectoryLive, ServesWithAnOversizedTruncatedAuditLogAndLogsNoCode) {
  const MultiClientFixture fixture{kLab};
  fixture.host.signal(SIGTERM);
  Process& host = const_cast<Process&>(fixture.host);
  EXPECT_EQ(host.wait(), 0) << host.err();
  std::ofstream(fixture.state + "/audit.log", std::ios::app) << std::string(9U << 20, 'x') << "\n{\"ts\":1,\"ev";
  const std::string config = fixture.folder.file("s.textproto");
  Process checked = server({"serve", config, "--check"});
  EXPECT_EQ(checked.wait(), 0) << checked.err();
  Process again = serving(config);
  ASSERT_FALSE(address_of(again).empty()) << again.err();
  const std::string code = fixture.code();
  ASSERT_EQ(code.size(), 11u) << "the operator reads it here";
  EXPECT_EQ(again.out().find(code), std::string::npos) << "standard output is kept by a journal";
  EXPECT_EQ(again.err().find(code), std::string::npos);
  EXPECT_NE(again.out().find("tandem-server sessions --state"), std::string::npos) << again.out();
  Process joined = client(address_of(again), "trainee", {"--state", fixture.own, "--session", code});
  ASSERT_TRUE(again.wait_for("trainee joined")) << again.err();
  EXPECT_NE(fixture.folder.read("state/audit.log").find("audit_rotated"), std::string::npos);
  EXPECT_GT(fs::file_size(fixture.state + "/audit.log.1"), 9U << 20);
  for (const auto& entry : fs::directory_iterator(fixture.state)) {
    const std::string name = entry.path().filename().string();
    const std::string_view beside = written_beside(name);
    EXPECT_NE(state_file(beside.empty() ? name : beside), nullptr)
        << name << ": add it to tests/common/auth/faults/state_files.h, and its check";
  }
  again.signal(SIGTERM);
  EXPECT_EQ(again.wait(), 0) << again.err();
}

// A writer waits for the lock for at most DirectoryLock::kTimeout, then continues without the line.
TEST(StateDirectoryLive, DropsALineWhileAnotherProgramLocksTheFile) {
  const Folder folder;
  const auto state = auth::StateDirectory::open(folder.file("state"), auth::StateDirectory::Missing::kIsMade);
  ASSERT_TRUE(state) << state.error();
  const auth::AppendFile log(*state, "audit.log");
  ASSERT_EQ(log.append("one\n"), "");
  {
    const auto held = auth::DirectoryLock::wait(*state, "audit.log");
    ASSERT_TRUE(held) << held.error();
    const std::string problem = log.append("two\n");
    EXPECT_NE(problem.find("is held by process " + std::to_string(::getpid())), std::string::npos) << problem;
  }
  EXPECT_EQ(log.append("three\n"), "");
  EXPECT_EQ(folder.read("state/audit.log"), "one\nthree\n");
}

TEST(StateDirectoryLive, CountsUnknownPeersWithoutFillingTheAuditLog) {
  MultiClientFixture fixture{kLab};
  const std::string metrics = metrics_of(fixture.host);
  std::array<std::byte, 16> serial{};
  const auth::Identity stranger = auth::Identity::make("stranger", serial, auth::wall_seconds());
  for (int i = 0; i < 30; ++i) {
    auto connected = auth::ControlClient::connect(
        *io::parse_address(fixture.address, 1),
        [&](const auth::KeyFingerprint&) -> std::expected<const auth::Identity*, std::string> { return &stranger; },
        std::chrono::seconds(30), -1);
    ASSERT_TRUE(connected) << connected.error().text;
    (void)connected->ask(rpc::SessionListRequest{}, std::chrono::seconds(30));
  }
  EXPECT_TRUE(comes_to_say(metrics, "tandem_joins_total{result=\"not_enrolled\"} 30")) << page(metrics);
  const std::string shown = page(metrics), log = fixture.folder.read("state/audit.log");
  const auto left = shown.find("\ntandem_audit_suppressed_total ");
  ASSERT_NE(left, std::string::npos) << shown;
  const auto suppressed = std::stoul(shown.substr(left + 31));
  EXPECT_GE(suppressed, 10u);
  EXPECT_EQ(count(log, "\"not_enrolled\"") + suppressed, 30u) << log;
  fixture.host.signal(SIGTERM);
  EXPECT_EQ(fixture.host.wait(), 0) << fixture.host.err();
  EXPECT_NE(fixture.folder.read("state/audit.log").find("lines about refused peers were left out"), std::string::npos)
      << "the summary, at the latest at the end";
}

TEST(StateDirectoryLive, WarnsInACheckOfMetricsThatOtherHostsCanReach) {
  const Folder folder;
  const std::string config = folder.write(
      "s.textproto",
      "version: 1 listen: \"127.0.0.1:0\" metrics: \"0.0.0.0:0\" session { name: \"a\" scene: \"contact\" }");
  Process checked = server({"serve", config, "--check"});
  EXPECT_EQ(checked.wait(), 0) << checked.err();
  EXPECT_NE(checked.err().find("s.textproto:1:"), std::string::npos) << checked.err();
  EXPECT_NE(checked.err().find("without a password"), std::string::npos) << checked.err();
  Process quiet = server(
      {"serve",
       folder.write(
           "q.textproto",
           "version: 1 listen: \"127.0.0.1:0\" metrics: \"127.0.0.1:0\" session { name: \"a\" scene: \"contact\" }"),
       "--check"});
  EXPECT_EQ(quiet.wait(), 0);
  EXPECT_EQ(quiet.err(), "");
}

}  // namespace
}  // namespace tandem::test
