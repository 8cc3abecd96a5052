// A server of a service whose wall clock is wrong by a year, at its start and while hands press in its session.
#include "tests/io/pressing_service.h"

namespace tandem::test {
namespace {

using std::chrono::milliseconds;

/// Path of the library that sets a program's wall clock; empty if it is missing.
std::string faketime_library() {
  std::error_code none;
  for (const auto& folder : std::filesystem::directory_iterator("/usr/lib", none)) {
    const auto path = folder.path() / "faketime" / "libfaketimeMT.so.1";
    if (std::filesystem::exists(path, none)) return path;
  }
  return "";
}

class ServiceClock : public PressingServiceTest {
 protected:
  void SetUp() override {
    PressingServiceTest::SetUp();
    if (!IsSkipped() && faketime_library().empty()) GTEST_SKIP() << "faketime is not installed (Debian: faketime)";
  }
  /// Sets the wall clock of server a, now and after its next start. Its other clocks stay right.
  /// @param shift  such as +365d
  void set_clock(const std::string& shift) {
    static_cast<void>(pressed.service().folder().write("clock.new", shift + "\n"));
    std::filesystem::rename(pressed.service().folder().file("clock.new"), clock());
  }
  [[nodiscard]] std::string clock() { return pressed.service().folder().file("clock"); }
  [[nodiscard]] Words under() {
    return {"/usr/bin/env",
            "LD_PRELOAD=" + faketime_library(),
            "FAKETIME_TIMESTAMP_FILE=" + clock(),
            "FAKETIME_CACHE_DURATION=1",
            "FAKETIME_DONT_FAKE_MONOTONIC=1",
            "NO_FAKE_STAT=1"};
  }
  /// An operator's ticket, made now on a computer with the right time.
  [[nodiscard]] std::string operator_ticket(const std::string& name) {
    return pressed.service().folder().write(
        name, first_line(LiveService::run({"ticket", "--session", "lab", "--role", "operator", "--workstation", "desk",
                                           "--state", pressed.service().folder().file("a")})));
  }
  /// Uses a ticket at server a.
  Process operate(const std::string& ticket, const Words& command) {
    Words words{TANDEM_CLIENT,   "control",
                "--server",      pressed.service().address("a"),
                "--session",     "lab",
                "--ticket-file", ticket,
                "--state",       pressed.service().folder().file("own-desk")};
    words.insert(words.end(), command.begin(), command.end());
    return Process(std::move(words));
  }
  /// Expects that a new ticket is refused at server a, and that client and server name the clock.
  void expect_refusal_names_the_clock(const std::string& ticket, const std::string& span) {
    Process refused = operate(ticket, {"create", "exam", "lesson"});
    EXPECT_EQ(refused.wait(), 1) << refused.out();
    for (const std::string& words : {std::string("by the clock of this server, the ticket "), span,
                                     std::string("the clock of this server is wrong")}) {
      EXPECT_NE(refused.err().find(words), std::string::npos) << refused.err();
      EXPECT_TRUE(pressed.service().of("a").wait_for(words)) << pressed.service().of("a").err();
    }
  }

  PressingService pressed;
};

TEST_F(ServiceClock, SetByAYearWhileHandsPressDisturbsNoHandAndRefusesTicketsWithTheCause) {
  LiveService& service = pressed.service();
  set_clock("+0");
  service.set("a", {.under = under()});
  pressed.start({"a", "b"});
  pressed.join(service.address("a"));
  const std::string ticket = operator_ticket("operator.ticket");
  set_clock("+365d");
  ASSERT_TRUE(service.of("a").wait_for("the clock of this computer was set 365 days forward")) << service.of("a").err();
  expect_refusal_names_the_clock(ticket, "expired 364 days ago");
  std::this_thread::sleep_for(milliseconds(4000));  // longer than the lease
  set_clock("-365d");
  ASSERT_TRUE(service.of("a").wait_for("days back while the server runs")) << service.of("a").err();
  expect_refusal_names_the_clock(ticket, "valid only in 36");
  std::this_thread::sleep_for(milliseconds(4000));
  EXPECT_EQ(service.of("a").err().find("HELD"), std::string::npos) << service.of("a").err();
  EXPECT_EQ(pressed.witness().newest("a").active, 2U) << "a hand was released";
  set_clock("+0");
  // The library reads the file once a second. The refusals have not used the ticket up.
  pressed.wait_until([&] { return operate(ticket, {"create", "exam", "lesson"}).wait() == 0; },
                     "the ticket is valid by the right clock");
  // Snapshots of a server with a wrong clock serve its standby as any others.
  set_clock("+365d");
  std::this_thread::sleep_for(milliseconds(3000));
  service.of("a").signal(SIGKILL);
  pressed.wait_until_active("b");
  const std::vector<Absence> all = pressed.expect_safe(1);
  ASSERT_EQ(all.size(), 2U) << "one absence of each hand, after the death of the server";
  for (const Absence& absence : all) EXPECT_LE(absence.back_s, 7);
}

TEST_F(ServiceClock, WrongAtTheStartRefusesTicketsOrTheStartWithTheCause) {
  LiveService& service = pressed.service();
  set_clock("+0");
  service.set("a", {.under = under()});
  service.start("a");
  service.wait_for_sessions("a", 1);
  static_cast<void>(service.enrolled("desk"));
  service.of("a").signal(SIGTERM);
  EXPECT_EQ(service.of("a").wait(), 0);
  set_clock("+365d");
  service.start("a");
  service.wait_for_sessions("a", 1);
  const std::string ticket = operator_ticket("operator.ticket");
  expect_refusal_names_the_clock(ticket, "expired 364 days ago");
  // A year back, the server's own voucher is not valid yet.
  service.of("a").signal(SIGTERM);
  EXPECT_EQ(service.of("a").wait(), 0);
  set_clock("-365d");
  Words words = under();
  words.insert(words.end(), {TANDEM_SERVER, "serve", service.folder().file("a.textproto")});
  Process refused(words);
  EXPECT_EQ(refused.wait(), 2) << refused.err();
  EXPECT_NE(refused.err().find("clock"), std::string::npos) << refused.err();
  // With the right time it starts, and the ticket is valid.
  set_clock("+0");
  service.start("a");
  service.wait_for_sessions("a", 1);
  Process accepted = operate(ticket, {"create", "exam", "lesson"});
  EXPECT_EQ(accepted.wait(), 0) << accepted.err();
}

}  // namespace
}  // namespace tandem::test
