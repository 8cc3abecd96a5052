// Codes of sessions, and whose connection speaks for a seat: over TLS, against a session that ticks on its own thread.
#include <array>
#include <barrier>

#include "tests/io/live_house.h"

namespace tandem::server::test {
namespace {

using control::Reason;

/// Every source counts, also those on this computer.
ControlLimits strict() {
  ControlLimits limits = LiveHouse::limits();
  limits.loopback_exempt = false;
  return limits;
}
const control::Credential kRight = control::CodeCredential{LiveHouse::kCode}, kWrong = control::CodeCredential{"ABCDE12346"};

TEST(Codes, EightPeopleWithTheRightCodeJoinAtOnce) {
  LiveHouse house("eight_seats", {}, strict());
  constexpr std::array<const char*, 8> kSeats{"trainee", "evaluator1", "evaluator2", "evaluator3", "evaluator4", "evaluator5", "evaluator6", "evaluator7"};
  std::vector<trust::Identity> keys;
  for (const char* const seat : kSeats) keys.push_back(house.enrolled(seat));
  std::barrier all(8);
  std::array<std::string, 8> trouble;
  std::vector<std::thread> people;
  for (std::size_t i = 0; i < 8; ++i)
    people.emplace_back([&, i] {
      auto client = house.connect(keys[i]);
      control::Hello hello = LiveHouse::hello(kRight, kSeats[i]);
      if (i % 2 == 0) hello.session = std::string(LiveHouse::kCode);  // as clients say it
      all.arrive_and_wait();
      const auto answer = client.ask(hello, kPatience);
      if (!answer || !std::holds_alternative<control::Welcome>(*answer)) trouble[i] = kSeats[i] + (": " + text_of(answer));
    });
  for (std::thread& t : people) t.join();
  for (const std::string& text : trouble) EXPECT_EQ(text, "");
}

TEST(Codes, WrongOnesBlockTheirKeyAndSourceAndNobodysResumeOrTicket) {
  LiveHouse house("eight_seats", {}, strict());
  const auto neighbour = house.enrolled("neighbour"), guesser = house.enrolled("guesser");
  const auto ask = [&](const trust::Identity& key, const control::Hello& hello) { return house.connect(key).ask(hello, kPatience); };
  const auto seated = ask(neighbour, LiveHouse::hello(kRight, "trainee"));
  ASSERT_TRUE(seated && std::holds_alternative<control::Welcome>(*seated)) << text_of(seated);
  for (int i = 0; i < 20; ++i)
    EXPECT_EQ(reason_of(ask(guesser, LiveHouse::hello(house.ticket(neighbour, AccessRole::kTrainee, "evaluator1"), "evaluator1"))), Reason::kTicket) << "no code: costs nothing";
  for (int i = 0; i < 10; ++i) EXPECT_EQ(reason_of(ask(guesser, LiveHouse::hello(kWrong, "evaluator1"))), Reason::kCode) << i;
  const auto blocked = ask(guesser, LiveHouse::hello(kRight, "evaluator1"));
  EXPECT_EQ(reason_of(blocked), Reason::kBlocked);
  EXPECT_NE(text_of(blocked).find("join by a ticket"), std::string::npos) << text_of(blocked);
  EXPECT_EQ(reason_of(ask(neighbour, LiveHouse::hello(kRight, "evaluator1"))), Reason::kBlocked) << "the same source";
  EXPECT_TRUE(std::holds_alternative<control::Welcome>(*ask(guesser, LiveHouse::hello(house.ticket(guesser, AccessRole::kEvaluator, "evaluator1"), "evaluator1"))));
  const auto back = ask(neighbour, LiveHouse::hello(control::ResumeCredential{std::get<control::Welcome>(*seated).resume_secret}, "trainee"));
  EXPECT_TRUE(back && std::holds_alternative<control::Welcome>(*back)) << text_of(back);
}

TEST(Codes, OnLoopbackOnlyTheKeyIsBlocked) {
  LiveHouse house("eight_seats");
  const auto neighbour = house.enrolled("neighbour"), guesser = house.enrolled("guesser");
  for (int i = 0; i < 10; ++i) EXPECT_EQ(reason_of(house.connect(guesser).ask(LiveHouse::hello(kWrong, "evaluator1"), kPatience)), Reason::kCode);
  EXPECT_EQ(reason_of(house.connect(guesser).ask(LiveHouse::hello(kRight, "evaluator1"), kPatience)), Reason::kBlocked);
  EXPECT_TRUE(std::holds_alternative<control::Welcome>(*house.connect(neighbour).ask(LiveHouse::hello(kRight, "evaluator1"), kPatience)));
}

// A session may be named by its code: this is a guess too, whatever else is shown.
TEST(Codes, NamingASessionByAWrongCodeCostsAnAttempt) {
  LiveHouse house("eight_seats", {}, strict());
  const auto guesser = house.enrolled("guesser"), neighbour = house.enrolled("neighbour");
  control::Hello hello = LiveHouse::hello(control::ResumeCredential{}, "trainee");
  hello.session = std::string("ABCDE12346");
  for (int i = 0; i < 10; ++i) EXPECT_EQ(reason_of(house.connect(guesser).ask(hello, kPatience)), Reason::kCode) << i;
  hello.session = std::string(LiveHouse::kCode);
  EXPECT_EQ(reason_of(house.connect(guesser).ask(hello, kPatience)), Reason::kBlocked) << "its key";
  EXPECT_EQ(reason_of(house.connect(neighbour).ask(hello, kPatience)), Reason::kResume) << "a resume of another key is not blocked";
}

// A seat has one connection: those before it may ask why they lost it, and are closed like all that have not joined.
TEST(Seats, AConnectionWhoseSeatCameBackOverAnotherIsBare) {
  ControlLimits limits = LiveHouse::limits();
  limits.bare_idle = 1000ms;
  LiveHouse house("free_motion", {}, limits);
  Guest first = joined(house, "desk-1", AccessRole::kInstructor, "trainer");
  ASSERT_TRUE(first.welcomed()) << text_of(first.welcome);
  trust::ControlClient second = house.connect(first.key);
  const auto back = second.ask(LiveHouse::hello(control::ResumeCredential{first.in().resume_secret}, "trainer"), kPatience);
  ASSERT_TRUE(back && std::holds_alternative<control::Welcome>(*back)) << text_of(back);
  for (const auto until = std::chrono::steady_clock::now() + kPatience; house.count(ControlEvent::kIdle) == 0 && std::chrono::steady_clock::now() < until;)
    std::this_thread::sleep_for(20ms);
  EXPECT_EQ(house.count(ControlEvent::kIdle), 1u);
  EXPECT_FALSE(first.ask(control::StatusRequest{LiveHouse::kId}));
  EXPECT_TRUE(second.ask(control::StatusRequest{LiveHouse::kId}, kPatience));
}

}  // namespace
}  // namespace tandem::server::test
