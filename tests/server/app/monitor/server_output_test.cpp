// Lines for the operator of a server, and the options in printed commands.
#include "server/app/monitor/server_output.h"

#include <gtest/gtest.h>

#include <sstream>

#include "server/app/monitor/server_hints.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

/// Lines that a server prints above its status line, as `[level] text`.
class ServerOutputLines : public ::testing::Test {
 protected:
  ServerOutputLines() { ::testing::internal::CaptureStdout(); }
  ~ServerOutputLines() override { static_cast<void>(::testing::internal::GetCapturedStdout()); }
  /// Returns the lines since the last call, without their times.
  std::string take() {
    output.print_posted();
    std::istringstream printed(::testing::internal::GetCapturedStdout());
    ::testing::internal::CaptureStdout();
    std::string text;
    for (std::string line; std::getline(printed, line);) text += line.substr(line.find("] ") + 2) + "\n";
    return text;
  }
  ServerOutput output{"serve", true, false};
};

TEST_F(ServerOutputLines, NameThePeerOfARejectionAndSanitiseTheDetail) {
  output.post_control_event({ControlEvent::kRefused, "10.0.0.1:7", "desk", "no\x1bseat"});
  EXPECT_EQ(take(), "[warning] 10.0.0.1:7 desk was refused: no\\x1bseat\n");
  output.post_control_event({ControlEvent::kNotEnrolled, "10.0.0.1:7", "", ""});
  EXPECT_EQ(take(), "[warning] 10.0.0.1:7  is not enrolled here\n");
}

TEST_F(ServerOutputLines, ReportAnErrorOfTheServerItselfWithoutAPeer) {
  output.post_control_event({ControlEvent::kTrouble, "", "", "disk full"});
  EXPECT_EQ(take(), "[error] disk full\n");
  output.post_control_event({ControlEvent::kTrouble, "10.0.0.1:7", "desk", "no keys"});
  EXPECT_EQ(take(), "[error] 10.0.0.1:7 desk: no keys\n");
  output.post_checkpoint_error("read-only");
  EXPECT_EQ(take(), "[error] checkpoint: read-only\n");
}

TEST_F(ServerOutputLines, OmitEventsThatAreOnlyCounted) {
  for (const ControlEvent event : {ControlEvent::kAccepted, ControlEvent::kWelcomed, ControlEvent::kForbidden})
    output.post_control_event({event, "10.0.0.1:7", "desk", "detail"});
  EXPECT_EQ(take(), "");
}

TEST_F(ServerOutputLines, ReportWarningsAsSuch) {
  output.report(io::Level::kWarn, {.event = "x"}, "late");
  output.report(io::Level::kInfo, {.event = "x"}, "joined");
  output.post_message("STOPPED by desk");
  output.error("no keys");
  EXPECT_EQ(take(), "[warning] late\n[info] joined\n[error] serve: no keys\n[info] STOPPED by desk\n");
}

TEST_F(ServerOutputLines, ShowTheStatusNoMoreOftenThanItsInterval) {
  const Time now = Time{} + 1h;
  EXPECT_TRUE(output.due(now));
  output.show(now, {}, "", "");
  EXPECT_FALSE(output.due(now + 200ms));
  EXPECT_TRUE(output.due(now + 5s));
}

TEST(ServerHints, NameTheSessionOnlyBesideOthersAndTheTicketOnlyWithRealKeys) {
  const io::SocketAddress at = *io::parse_address("127.0.0.1:7000", 0);
  const ServerHints one(at, "/state", true, false), many(at, "/state", false, true);
  EXPECT_EQ(one.client_options("lesson"), " --server 127.0.0.1:7000");
  EXPECT_EQ(many.client_options("lesson"), " --server 127.0.0.1:7000 --session lesson --ticket-file FILE");
  EXPECT_EQ(one.list_command(), "tandem-client sessions --server 127.0.0.1:7000");
  EXPECT_EQ(many.list_command(), "tandem-server sessions --state /state");
  EXPECT_EQ(one.prefix("lesson"), "");
  EXPECT_EQ(many.prefix("lesson"), "lesson: ");
}

}  // namespace
}  // namespace tandem::server
