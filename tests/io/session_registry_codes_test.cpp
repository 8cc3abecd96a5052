// Session codes, and the connection that owns a seat: over TLS, against a session on its own tick thread.
#include <array>
#include <barrier>

#include "tests/io/live_server.h"

namespace tandem::server::test {
namespace {

using rpc::ErrorCode;

/// Limits that count every source, also on this computer.
ControlLimits strict() {
  ControlLimits limits = LiveServer::limits();
  limits.loopback_exempt = false;
  return limits;
}
const rpc::Credential kRight = rpc::CodeCredential{LiveServer::kCode}, kWrong = rpc::CodeCredential{"ABCDE12346"};

TEST(Codes, AdmitEightClientsAtOnce) {
  LiveServer live_server("eight_seats", {}, strict());
  constexpr std::array<const char*, 8> kSeats{"trainee",    "evaluator1", "evaluator2", "evaluator3",
                                              "evaluator4", "evaluator5", "evaluator6", "evaluator7"};
  std::vector<auth::Identity> keys;
  for (const char* const seat : kSeats) keys.push_back(live_server.enrolled(seat));
  std::barrier all(8);
  std::array<std::string, 8> trouble;
  std::vector<std::thread> people;
  for (std::size_t i = 0; i < 8; ++i)
    people.emplace_back([&, i] {
      auto client = live_server.connect(keys[i]);
      rpc::Hello hello = LiveServer::hello(kRight, kSeats[i]);
      if (i % 2 == 0) hello.session = std::string(LiveServer::kCode);  // as clients send it
      all.arrive_and_wait();
      const auto answer = client.ask(hello, kTimeout);
      if (!answer || !std::holds_alternative<rpc::Welcome>(*answer)) trouble[i] = kSeats[i] + (": " + text_of(answer));
    });
  for (std::thread& t : people) t.join();
  for (const std::string& text : trouble) EXPECT_EQ(text, "");
}

TEST(Codes, BlockKeyAndSourceAfterWrongCodesButNoResumeOrTicket) {
  LiveServer live_server("eight_seats", {}, strict());
  const auto neighbour = live_server.enrolled("neighbour"), guesser = live_server.enrolled("guesser");
  const auto ask = [&](const auth::Identity& key, const rpc::Hello& hello) {
    return live_server.connect(key).ask(hello, kTimeout);
  };
  const auto seated = ask(neighbour, LiveServer::hello(kRight, "trainee"));
  ASSERT_TRUE(seated && std::holds_alternative<rpc::Welcome>(*seated)) << text_of(seated);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(
        reason_of(ask(guesser, LiveServer::hello(live_server.ticket(neighbour, AccessRole::kTrainee, "evaluator1"),
                                                 "evaluator1"))),
        ErrorCode::kTicket)
        << "no code: costs nothing";
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(reason_of(ask(guesser, LiveServer::hello(kWrong, "evaluator1"))), ErrorCode::kCode) << i;
  const auto blocked = ask(guesser, LiveServer::hello(kRight, "evaluator1"));
  EXPECT_EQ(reason_of(blocked), ErrorCode::kBlocked);
  EXPECT_NE(text_of(blocked).find("join by a ticket"), std::string::npos) << text_of(blocked);
  EXPECT_EQ(reason_of(ask(neighbour, LiveServer::hello(kRight, "evaluator1"))), ErrorCode::kBlocked)
      << "the same source";
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(*ask(
      guesser, LiveServer::hello(live_server.ticket(guesser, AccessRole::kEvaluator, "evaluator1"), "evaluator1"))));
  const auto back = ask(
      neighbour, LiveServer::hello(rpc::ResumeCredential{std::get<rpc::Welcome>(*seated).resume_secret}, "trainee"));
  EXPECT_TRUE(back && std::holds_alternative<rpc::Welcome>(*back)) << text_of(back);
}

TEST(Codes, BlockOnlyTheKeyOnLoopback) {
  LiveServer live_server("eight_seats");
  const auto neighbour = live_server.enrolled("neighbour"), guesser = live_server.enrolled("guesser");
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(reason_of(live_server.connect(guesser).ask(LiveServer::hello(kWrong, "evaluator1"), kTimeout)),
              ErrorCode::kCode);
  EXPECT_EQ(reason_of(live_server.connect(guesser).ask(LiveServer::hello(kRight, "evaluator1"), kTimeout)),
            ErrorCode::kBlocked);
  EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(
      *live_server.connect(neighbour).ask(LiveServer::hello(kRight, "evaluator1"), kTimeout)));
}

// A session may be named by its code: this is an attempt at the code too, whatever other credential is sent.
TEST(Codes, NamingASessionByAWrongCodeCostsAnAttempt) {
  LiveServer live_server("eight_seats", {}, strict());
  const auto guesser = live_server.enrolled("guesser"), neighbour = live_server.enrolled("neighbour");
  rpc::Hello hello = LiveServer::hello(rpc::ResumeCredential{}, "trainee");
  hello.session = std::string("ABCDE12346");
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(reason_of(live_server.connect(guesser).ask(hello, kTimeout)), ErrorCode::kCode) << i;
  hello.session = std::string(LiveServer::kCode);
  EXPECT_EQ(reason_of(live_server.connect(guesser).ask(hello, kTimeout)), ErrorCode::kBlocked) << "its key";
  EXPECT_EQ(reason_of(live_server.connect(neighbour).ask(hello, kTimeout)), ErrorCode::kResume)
      << "a resume of another key is not blocked";
}

// A seat has one connection. Earlier ones may ask for the reason, and are closed like all that have not joined.
TEST(Seats, CloseTheEarlierConnectionAfterAResume) {
  ControlLimits limits = LiveServer::limits();
  limits.unjoined_idle = 1000ms;
  LiveServer live_server("free_motion", {}, limits);
  JoinedClient first = joined(live_server, "desk-1", AccessRole::kInstructor, "trainer");
  ASSERT_TRUE(first.welcomed()) << text_of(first.welcome);
  auth::ControlClient second = live_server.connect(first.key);
  const auto back = second.ask(LiveServer::hello(rpc::ResumeCredential{first.in().resume_secret}, "trainer"), kTimeout);
  ASSERT_TRUE(back && std::holds_alternative<rpc::Welcome>(*back)) << text_of(back);
  for (const auto until = std::chrono::steady_clock::now() + kTimeout;
       live_server.count(ControlEvent::kIdle) == 0 && std::chrono::steady_clock::now() < until;)
    std::this_thread::sleep_for(20ms);
  EXPECT_EQ(live_server.count(ControlEvent::kIdle), 1u);
  EXPECT_FALSE(first.ask(rpc::StatusRequest{LiveServer::kId}));
  EXPECT_TRUE(second.ask(rpc::StatusRequest{LiveServer::kId}, kTimeout));
}

}  // namespace
}  // namespace tandem::server::test
