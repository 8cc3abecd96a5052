// The audit log as a server writes it: which events, how many per source, and what it reports about failures.
#include "server/app/control/audit_writer.h"

#include <gtest/gtest.h>

#include "tests/common/auth/io/temporary_folder.h"

namespace tandem::server {
namespace {

class AuditWriterTest : public ::testing::Test {
 protected:
  AuditWriterTest() {
    EXPECT_TRUE(auth::ServerKeystore::init(folder.path("server"), auth::wall_seconds()));
    trust.emplace(std::move(*auth::ServerKeystore::open(folder.path("server"))));
    writer.emplace(
        context, *trust, [this](const ControlEventRecord& news) { events.push_back(news.detail); },
        [this](const std::string& line) { messages.push_back(line); });
  }
  [[nodiscard]] std::string log() const { return folder.read("server/audit.log"); }
  [[nodiscard]] std::size_t lines() const { return static_cast<std::size_t>(std::ranges::count(log(), '\n')); }

  auth::test::Folder folder;
  asio::io_context context;
  std::optional<auth::ServerKeystore> trust;
  std::optional<AuditWriter> writer;
  std::vector<std::string> events, messages;
};

TEST_F(AuditWriterTest, WritesJoinsAndRejectionsOnly) {
  EXPECT_TRUE(writer->record({ControlEvent::kAccepted, "10.0.0.1:7", "", ""}));
  EXPECT_TRUE(writer->record({ControlEvent::kEnrolled, "10.0.0.1:7", "desk", "key"}));
  EXPECT_TRUE(writer->record({ControlEvent::kForbidden, "10.0.0.1:7", "desk", ""})) << "only counted";
  EXPECT_EQ(lines(), 0U);
  EXPECT_TRUE(writer->record({ControlEvent::kWelcomed, "10.0.0.1:7", "desk", "trainee"}));
  EXPECT_TRUE(writer->record({ControlEvent::kForbidden, "10.0.0.1:7", "desk", "may not"}));
  EXPECT_EQ(lines(), 2U);
  EXPECT_NE(log().find(R"("event":"welcomed","name":"desk","detail":"10.0.0.1:7 trainee")"), std::string::npos)
      << log();
}

TEST_F(AuditWriterTest, LimitsRejectionsPerNetworkAndReportsTheirNumber) {
  const auto refuse = [&](const std::string& address) {
    return writer->record({ControlEvent::kRefused, address, "", "no"});
  };
  for (int i = 0; i < 10; ++i) EXPECT_TRUE(refuse("[2001:db8::" + std::to_string(i) + "]:7")) << i;
  EXPECT_FALSE(refuse("[2001:db8::99]:8")) << "a site has a whole /64 network";
  EXPECT_TRUE(refuse("[2001:db9::1]:7"));
  EXPECT_TRUE(refuse("10.0.0.1:7"));
  EXPECT_EQ(lines(), 12U);
  EXPECT_EQ(writer->state().left_out, 1U);
  writer->close();
  EXPECT_NE(log().find("\"event\":\"suppressed\""), std::string::npos);
  EXPECT_NE(log().find("2001:db8:0:0::/64"), std::string::npos) << log();
}

TEST_F(AuditWriterTest, ReportsAFailureAndTheRecoveryOnceEach) {
  std::filesystem::create_directory(folder.path("server/audit.log"));
  EXPECT_TRUE(writer->record({ControlEvent::kWelcomed, "10.0.0.1:7", "desk", "trainee"}));
  writer->service();
  writer->service();
  ASSERT_EQ(events.size(), 1U);
  EXPECT_NE(events[0].find("the audit log fails"), std::string::npos);
  EXPECT_FALSE(writer->state().trouble.empty());
  std::filesystem::remove(folder.path("server/audit.log"));
  writer->service();
  writer->service();
  EXPECT_EQ(messages, (std::vector<std::string>{"the audit log is written again; lines lost so far: 1"}));
  EXPECT_EQ(events.size(), 1U);
  EXPECT_TRUE(writer->state().trouble.empty());
  EXPECT_EQ(writer->state().lost, 1U);
}

TEST_F(AuditWriterTest, AppendsEventsOfSessionsOnTheControlThread) {
  writer->post("seat-joined", "lesson", "trainee tick 1");
  EXPECT_EQ(lines(), 0U);
  context.run();
  EXPECT_NE(log().find(R"("event":"seat-joined","name":"lesson","detail":"trainee tick 1")"), std::string::npos)
      << log();
}

}  // namespace
}  // namespace tandem::server
