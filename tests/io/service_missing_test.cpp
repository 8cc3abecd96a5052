// Clients of a service whose session has ended while they were away: real servers that do not have it.
#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "client/app/run_seat.h"
#include "common/io/clock.h"
#include "tests/io/service_join_fixture.h"

namespace tandem::client {
namespace {

using server::ControlEvent;

/// A seat of server "a", which then dies. Servers "b" and "c" know no session.
class ServiceMissing : public ServiceJoin {
 protected:
  ServiceMissing() {
    know(*a);
    a->serve(5);
    a->on_thread([&] { a->directory.addresses = {a->at(), b->at(), c->at()}; });
  }
  struct Ended {
    std::string words, report;
    [[nodiscard]] bool says(const char* text) const { return words.find(text) != words.npos; }
    [[nodiscard]] bool ended_by(const char* reason) const {
      return report.find("\"ended_by\": \"" + std::string(reason) + "\"") != report.npos;
    }
  };
  /// Runs a client until its seat ends.
  Ended ended(double reconnect_timeout_s) {
    SeatOptions plan;
    plan.join = options({a.get()}, 5s);
    plan.device = "sim";
    plan.reconnect_timeout_s = reconnect_timeout_s;
    plan.quiet = true;
    plan.json = folder.path("report.json");
    testing::internal::CaptureStdout();  // the log of a program without `log_to_stderr`
    std::thread person([&] { EXPECT_EQ(run_seat(plan), 1); });
    static_cast<void>(a->resume_hash_of_trainee());
    while (!a->hears_trainee()) std::this_thread::sleep_for(20ms);
    a->silence();
    a.reset();
    const Time died = io::monotonic_now();
    person.join();
    const double after_s = seconds(io::monotonic_now() - died);
    Ended seat{testing::internal::GetCapturedStdout(), {}};
    std::stringstream report;
    report << std::ifstream(plan.json).rdbuf();
    seat.report = report.str();
    std::printf("[ measured ] ended %.2f s after the server died; connections: %d, %d\n", after_s,
                static_cast<int>(b->count(ControlEvent::kAccepted)),
                static_cast<int>(c->count(ControlEvent::kAccepted)));
    return seat;
  }

  std::unique_ptr<MemberServer> a = member("desk-a"), b = member("desk-b"), c = member("desk-c");
};

TEST_F(ServiceMissing, EndsTheSeatWithTheAnswerOfTheServersAfter15Seconds) {
  const Ended seat = ended(60);
  EXPECT_TRUE(seat.says("the seat is gone: no session is open in this service; join again")) << seat.words;
  EXPECT_TRUE(seat.ended_by("seat_gone"));
  for (const MemberServer* other : {b.get(), c.get()}) EXPECT_LE(other->count(ControlEvent::kAccepted), 6U);
}

TEST_F(ServiceMissing, GivesTheAnswerOfTheServersAlsoWhenTheTimeForReconnectsIsOver) {
  const Ended seat = ended(4);
  EXPECT_TRUE(
      seat.says("server lost: a server was reached, but none has given the seat back for 4 s. Newest reason: no "
                "session is open in this service. Ask its operator, then join again"))
      << seat.words;
  EXPECT_FALSE(seat.says("no news"));
  EXPECT_TRUE(seat.ended_by("server_lost"));
  for (const MemberServer* other : {b.get(), c.get()}) EXPECT_LE(other->count(ControlEvent::kAccepted), 2U);
}

/// One server that cannot tell, or that sends the client to another one, is enough to ask on.
TEST_F(ServiceMissing, IsTheAnswerOnlyIfAllServersThatWereReachedGiveIt) {
  const auto joined = join_seat(options({a.get()}, 5s));
  ASSERT_TRUE(joined) << joined.error().reason;
  const JoinOptions asking = options({a.get(), b.get(), c.get()}, 3s);
  const ServerLocation dead = a->location(9);
  a.reset();
  const auto failed = [&] {
    // "b" and "c" are asked once each; the wait for an owner that does not answer ends at the third question.
    const auto back = resume_seat(asking, resume_state(*joined), [asked = 0]() mutable { return ++asked <= 2; });
    EXPECT_FALSE(back);
    return back.error();
  };
  ResumeError error = failed();
  EXPECT_EQ(error.kind, ResumeError::Kind::kAgain);
  EXPECT_EQ(error.heard, SeatAnswer::kMissing);
  EXPECT_EQ(error.answer, "no session is open in this service");
  EXPECT_NE(error.reason.find("cannot be reached"), std::string::npos) << "of the dead server: " << error.reason;
  point(*c, SessionLocator::Unknown{"its directory does not answer"});
  error = failed();
  EXPECT_EQ(error.heard, SeatAnswer::kOther);
  EXPECT_NE(error.answer.find("its directory does not answer"), std::string::npos) << error.answer;
  point(*c, dead);
  error = failed();
  EXPECT_EQ(error.heard, SeatAnswer::kOther);
  EXPECT_NE(error.answer.find("sends this client to " + dead.address), std::string::npos) << error.answer;
  b.reset();
  c.reset();
  error = failed();
  EXPECT_EQ(error.heard, SeatAnswer::kNone);
  EXPECT_EQ(error.answer, "");
}

}  // namespace
}  // namespace tandem::client
