// Joins that meet the removal of the seat's participant, and joins while a shard has no place for a question.
#include <gtest/gtest.h>
#include <poll.h>

#include <memory>
#include <optional>
#include <utility>

#include "tests/server/app/control/joining.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

/// A participant in the seat trainee, and an operator who removes it. The shard executes requests at once; the control
/// plane sees their results only in `wait_until`.
struct Removal : Joining {
  Removal() {
    serve();
    const JoinRequest first = request("trainee", rpc::CodeCredential{kCode});
    const JoinReply reply = join(first);
    welcome = std::get<rpc::Welcome>(reply);
    resume = request("trainee", rpc::ResumeCredential{welcome.resume_secret});
    joins.on_joined(first, welcome, {});
    wait_until([&] { return !seat().joining(); });
    operating.session_id = id_of(1);
    operating.session_name = "lesson";
    operating.role = AccessRole::kOperator;
  }
  [[nodiscard]] SeatReservation& seat() { return lesson.seats[1]; }
  /// Begins to remove the trainee.
  void remove() {
    commands.execute(operating, {"office", {std::byte{9}}, 0}, rpc::RemoveParticipant{id_of(1), "trainee", "late"},
                     [this](rpc::Body body) { removed = std::move(body); });
  }
  /// Begins to resume the seat.
  void begin_resume() {
    joins.admit(resume, [this](JoinReply decided) { resumed = std::move(decided); });
  }
  void wait_for_both() {
    wait_until([&] { return removed && resumed; });
    EXPECT_TRUE(std::holds_alternative<rpc::Ok>(*removed));
  }
  /// The participant is out, and stays out.
  void expect_gone() {
    wait_until([&] { return !seat().joining(); });
    EXPECT_FALSE(seat().owner());
    EXPECT_FALSE(joins.is_current(welcome));
    EXPECT_EQ(error_of(join(resume)).code, ErrorCode::kResume);
    for (int i = 0; i < 1000 && taken(); ++i) poll(nullptr, 0, 10);
    EXPECT_FALSE(taken()) << "the session has the removed participant still";
  }
  /// Whether the session has a client in the seat.
  [[nodiscard]] bool taken() {
    std::optional<rpc::Body> status;
    commands.execute(operating, {}, rpc::StatusRequest{id_of(1)}, [&](rpc::Body body) { status = std::move(body); });
    wait_until([&] { return status.has_value(); });
    return std::get<rpc::Status>(*status).seats[1].taken;
  }
  /// Joins, again while the hand of the removed participant is being released.
  [[nodiscard]] JoinReply join_when_free(const JoinRequest& by) {
    JoinReply reply = join(by);
    for (int i = 0; i < 3000 && error_of(reply).code == ErrorCode::kSeatTaken; ++i) {
      poll(nullptr, 0, 10);
      reply = join(by);
    }
    return reply;
  }
  static void expect_welcome(const JoinReply& reply) {
    EXPECT_TRUE(std::holds_alternative<rpc::Welcome>(reply)) << error_of(reply).text;
  }

  rpc::Welcome welcome, operating;
  JoinRequest resume;
  std::optional<rpc::Body> removed;
  std::optional<JoinReply> resumed;
};

TEST(RemovedJoins, AreNotResumedByARequestThatFollowsTheRemoval) {
  Removal r;
  r.remove();
  r.begin_resume();
  r.wait_for_both();
  EXPECT_EQ(error_of(*r.resumed).code, ErrorCode::kResume);
  r.expect_gone();
}

TEST(RemovedJoins, AreNotResumedByARequestThatTheRemovalFollows) {
  Removal r;
  r.begin_resume();
  r.remove();
  r.wait_for_both();
  EXPECT_EQ(error_of(*r.resumed).code, ErrorCode::kSeatTaken);
  r.expect_gone();
}

TEST(RemovedJoins, AreNotResumedByAClientThatHasItsWelcomeAlready) {
  Removal r;
  r.begin_resume();
  r.wait_until([&] { return r.resumed.has_value(); });
  const auto* const again = std::get_if<rpc::Welcome>(&*r.resumed);
  ASSERT_NE(again, nullptr) << error_of(*r.resumed).text;
  r.remove();
  r.joins.on_joined(r.resume, *again, {});
  r.wait_for_both();
  EXPECT_FALSE(r.joins.is_current(*again));
  r.expect_gone();
}

TEST(RemovedJoins, LeaveTheTicketOfANewParticipantValid) {
  Removal r;
  r.remove();
  r.wait_until([&] { return r.removed.has_value(); });
  const JoinRequest next = Joining::request("trainee", r.ticket_for({std::byte{3}}, "trainee", AccessRole::kTrainee));
  const JoinReply first = r.join_when_free(next);
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(first)) << error_of(first).text;
  r.remove();
  r.joins.on_joined(next, std::get<rpc::Welcome>(first), {});
  EXPECT_FALSE(r.seat().owner());
  Removal::expect_welcome(r.join(next));
}

TEST(BusyShard, IsNamedToClientsThatAskAndEndsNothing) {
  Joining j;
  const auto full = std::make_shared<bool>(false);
  for (int i = 0; !*full && i < 10000; ++i)
    j.registry.post(j.lesson, {.what = ShardRequest::What::kQueryPeers,
                               .done = [full](ShardRequest& r) { *full = *full || r.result == JoinResult::kBusy; }});
  const JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  EXPECT_EQ(error_of(j.join(request)).code, ErrorCode::kFull) << "a client asks again after that";
  EXPECT_FALSE(j.lesson.seats[1].joining());
  JoinRequest link_test = Joining::request("");
  link_test.hello.link_test = true;
  EXPECT_EQ(error_of(j.join(link_test)).code, ErrorCode::kFull);
  rpc::Welcome console;
  console.session_id = id_of(1);
  console.role = AccessRole::kOperator;
  std::optional<rpc::Body> status, stopped;
  j.commands.execute(console, {}, rpc::StatusRequest{id_of(1)}, [&](rpc::Body body) { status = std::move(body); });
  ASSERT_TRUE(status);
  EXPECT_EQ(error_of(*status).code, ErrorCode::kFull);
  j.commands.execute(console, {}, rpc::StopSession{id_of(1), ""}, [&](rpc::Body body) { stopped = std::move(body); });
  EXPECT_FALSE(stopped) << "a stop waits for a place";
  j.serve();
  j.wait_until([&] { return stopped.has_value(); });
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(*stopped));
  Removal::expect_welcome(j.join(request));
}

}  // namespace
}  // namespace tandem::server
