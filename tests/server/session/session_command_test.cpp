// Commands over control connections, executed by a real session with real client cores at its seats.
#include "server/session/session_command.h"

#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "server/policy/admission_control.h"
#include "server/policy/new_client_load.h"
#include "tests/server/session/session_fixture.h"
#include "tests/support/alloc_guard.h"

namespace tandem::server {
namespace {

using namespace test;
using Result = CommandOutcome::Result;

constexpr std::size_t kTrainer = 0, kTrainee = 1;

CommandOutcome execute(SessionFixture& rig, const SessionCommand& command) {
  return execute_command(*rig.session, rig.now, command);
}
CommandOutcome execute(SessionFixture& rig, rpc::Body body, AccessRole role) {
  return execute(rig, SessionCommand{std::move(body), role});
}
CommandOutcome stop(SessionFixture& rig, AccessRole role) { return execute(rig, rpc::StopSession{}, role); }
CommandOutcome pause(SessionFixture& rig, AccessRole role) { return execute(rig, rpc::PauseSession{}, role); }
CommandOutcome resume(SessionFixture& rig, AccessRole role, std::uint32_t number) {
  return execute(rig, rpc::ResumeSession{{}, number}, role);
}
CommandOutcome status(SessionFixture& rig) { return execute(rig, rpc::StatusRequest{}, AccessRole::kRecorder); }

SessionCommand weights(AccessRole role, std::uint32_t version, std::vector<double> alpha, std::uint32_t tool = 0) {
  return {rpc::SetAuthority{{}, tool, version, std::move(alpha)}, role};
}

/// Removes the client of a seat: by an instructor's command, or because its workstation was revoked.
Result remove(SessionFixture& rig, std::size_t seat, wire::CloseReason why = wire::CloseReason::kRemoved) {
  if (why == wire::CloseReason::kRevoked) return remove_client(*rig.session, seat, 0, why);
  return execute(rig, rpc::RemoveParticipant{{}, rig.session->scene().seats[seat].name, ""}, AccessRole::kInstructor)
      .result;
}

std::vector<AuditEvent> events(Session& session) {
  std::vector<AuditEvent> out;
  while (const auto e = session.audit().poll()) out.push_back(*e);
  return out;
}

TEST(Commands, PutTheirOrderOnTheEventsThatFollowFromThem) {
  SessionFixture rig("free_motion");
  rig.run(2s);
  static_cast<void>(events(*rig.session));
  SessionCommand change = weights(AccessRole::kInstructor, status(rig).authority_version, {0.5, 0.5});
  change.order = 7;
  ASSERT_EQ(execute(rig, change).result, Result::kDone);
  SessionCommand halt{rpc::StopSession{}, AccessRole::kOperator};
  halt.order = 8;
  ASSERT_EQ(execute(rig, halt).result, Result::kDone);
  ASSERT_EQ(stop(rig, AccessRole::kInstructor).result, Result::kDone);
  rig.run(100ms);
  std::map<std::uint32_t, std::vector<AuditEvent::What>> by_order;
  for (const AuditEvent& event : events(*rig.session)) by_order[event.order].push_back(event.what);
  EXPECT_EQ(by_order[7], (std::vector{AuditEvent::What::kAuthority}));
  EXPECT_EQ(by_order[8], (std::vector{AuditEvent::What::kStop}));
  EXPECT_FALSE(by_order[0].empty()) << "the second stop has no order";
}

TEST(Commands, LatchAStopAndEndOnlyTheNewest) {
  SessionFixture rig("free_motion");
  rig.run(2s);
  ASSERT_TRUE(rig.seats[kTrainer].core->gate().active());
  EXPECT_EQ(resume(rig, AccessRole::kOperator, 0).result, Result::kNothingToDo) << "nothing is stopped";
  EXPECT_EQ(stop(rig, AccessRole::kOperator).stops, 1U);
  rig.run(200ms);
  for (const FixtureSeat& s : rig.seats) EXPECT_FALSE(s.core->gate().active());
  EXPECT_EQ(rig.session->state(), wire::SessionState::kStopped);
  EXPECT_EQ(stop(rig, AccessRole::kInstructor).stops, 2U);
  const CommandOutcome old = resume(rig, AccessRole::kOperator, 1);
  EXPECT_EQ(old.result, Result::kOutdated);
  EXPECT_EQ(old.stop_latch.level(), StopLatch::Level::kStopped);
  EXPECT_EQ(resume(rig, AccessRole::kRecorder, 2).result, Result::kForbidden)
      << "the session looks at the role once more";
  rig.run(100ms);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kStopped);
  EXPECT_EQ(resume(rig, AccessRole::kOperator, 2).result, Result::kDone);
  rig.run(1s);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kRunning);
  EXPECT_TRUE(rig.seats[kTrainer].core->gate().active());
}

// Two commands between the same two ticks: the reply to the second one already shows the effect of the first.
TEST(Commands, ReturnTheNewStateBeforeTheNextTick) {
  SessionFixture waiting, running("free_motion");
  running.run(2s);
  for (SessionFixture* rig : {&waiting, &running}) {
    const wire::SessionState before = rig->session->state();
    EXPECT_EQ(pause(*rig, AccessRole::kTrainee).state, wire::SessionState::kPaused);
    EXPECT_EQ(stop(*rig, AccessRole::kOperator).state, wire::SessionState::kStopped);
    EXPECT_EQ(resume(*rig, AccessRole::kOperator, 2).state, before);
  }
  running.session->participants().end(wire::CloseReason::kDone);
  EXPECT_EQ(stop(running, AccessRole::kOperator).state, wire::SessionState::kEnding);
}

TEST(Commands, PauseForEveryPermittedRoleWithoutWeakeningAStop) {
  SessionFixture rig;
  rig.run(1s);
  EXPECT_EQ(pause(rig, AccessRole::kInstructor).stop_latch.level(), StopLatch::Level::kPaused);
  EXPECT_EQ(stop(rig, AccessRole::kOperator).stop_latch.level(), StopLatch::Level::kStopped);
  EXPECT_EQ(pause(rig, AccessRole::kTrainee).stop_latch.level(), StopLatch::Level::kStopped);
  EXPECT_EQ(pause(rig, AccessRole::kObserver).result, Result::kForbidden);
  EXPECT_EQ(rig.session->stop_control().latch().stops(), 3U);
}

// With real clients: the trainee pauses from its seat. An evaluator cannot end the pause, the trainee can.
TEST(Commands, LetOnlyThePausingSeatEndItsPauseWithoutAnInstructor) {
  SessionFixture rig("eight_seats");
  rig.run(2s);
  ASSERT_TRUE(rig.seats[0].core->gate().active());
  ASSERT_TRUE(rig.seats[0].core->requests().stop_all());
  rig.run(300ms);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kPaused);
  for (const FixtureSeat& s : rig.seats) EXPECT_FALSE(s.core->gate().active());
  rig.seats[1].core->requests().resume();
  rig.run(300ms);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kPaused) << "a pause of another participant";
  const CommandOutcome look = status(rig);
  EXPECT_EQ(look.stop_latch.latest().by, 0);
  EXPECT_TRUE(look.stop_latch.may_end(AccessRole::kTrainee, 0));
  EXPECT_GT(look.stop_age, 0.5);
  rig.seats[0].core->requests().resume();
  rig.run(1s);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kRunning);
  EXPECT_TRUE(rig.seats[0].core->gate().active());
  // They cannot end a stop by an operator.
  EXPECT_EQ(stop(rig, AccessRole::kOperator).result, Result::kDone);
  rig.run(100ms);
  rig.seats[0].core->requests().resume();
  rig.run(100ms);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kStopped);
}

TEST(Commands, AcceptOneOfTwoChangesOfAVersionAndReturnTheCurrentValue) {
  for (std::uint64_t seed = 1; seed <= 8; ++seed) {
    SessionFixture rig("free_motion", seed);
    rig.run(1s);
    const std::uint32_t version = rig.session->authority().version();
    const double a = static_cast<double>(seed) / 10;
    // The order of the two is arbitrary: the seed selects it.
    const SessionCommand first = weights(AccessRole::kInstructor, version, {a, 1 - a}),
                         second = weights(AccessRole::kInstructor, version, {1 - a, a});
    const CommandOutcome won = execute(rig, seed % 2 == 0 ? first : second),
                         lost = execute(rig, seed % 2 == 0 ? second : first);
    EXPECT_EQ(won.result, Result::kDone);
    EXPECT_EQ(lost.result, Result::kOutdated);
    EXPECT_EQ(lost.authority_version, version + 1);
    EXPECT_EQ(lost.alpha, won.alpha) << "the loser gets what is in force";
    EXPECT_EQ(won.authority_version, version + 1);
    EXPECT_NE(won.before, won.alpha[0]);
    // With the version of the reply the request can be repeated.
    SessionCommand again = seed % 2 == 0 ? second : first;
    std::get<rpc::SetAuthority>(again.body).version = lost.authority_version;
    EXPECT_EQ(execute(rig, again).result, Result::kDone);
  }
}

TEST(Commands, RejectInvalidAuthorityWithoutEffect) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  const std::uint32_t version = rig.session->authority().version();
  const auto before = rig.session->tool(0).authority.requested();
  const auto result = [&](const SessionCommand& c) { return execute(rig, c).result; };
  EXPECT_EQ(result(weights(AccessRole::kInstructor, version, {1, 0}, 1)), Result::kInvalid) << "no such tool";
  EXPECT_EQ(result(weights(AccessRole::kInstructor, version, {1})), Result::kInvalid) << "a master is missing";
  EXPECT_EQ(result(weights(AccessRole::kInstructor, version, {1, 0, 0})), Result::kInvalid);
  for (const AccessRole who :
       {AccessRole::kEvaluator, AccessRole::kObserver, AccessRole::kOperator, AccessRole::kRecorder})
    EXPECT_EQ(result(weights(who, version, {0.5, 0.5})), Result::kForbidden) << to_text(who);
  EXPECT_EQ(result(weights(AccessRole::kInstructor, version + 1, {0.5, 0.5})), Result::kOutdated)
      << "nor one that never was";
  EXPECT_EQ(rig.session->authority().version(), version);
  EXPECT_EQ(rig.session->tool(0).authority.requested(), before);
}

TEST(Commands, LetATraineeOnlyReturnAuthority) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  ASSERT_EQ(execute(rig, weights(AccessRole::kInstructor, rig.session->authority().version(), {0.4, 0.6})).result,
            Result::kDone);
  SessionCommand c = weights(AccessRole::kTrainee, rig.session->authority().version(), {0.2, 0.8});
  c.seat = kTrainee;
  c.cid = rig.session->seat(kTrainee).link()->own_cid();
  EXPECT_EQ(execute(rig, c).result, Result::kForbidden);
  std::get<rpc::SetAuthority>(c.body).alpha = {0.9, 0.1};
  EXPECT_EQ(execute(rig, c).result, Result::kDone);
}

TEST(Commands, RejectASenderThatNoLongerHasItsSeat) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  SessionCommand c;
  c.body = rpc::StopSession{};
  c.role = AccessRole::kInstructor;
  c.seat = kTrainer;
  c.cid = rig.session->seat(kTrainer).link()->own_cid() ^ 0x10000U;
  EXPECT_EQ(execute(rig, c).result, Result::kSeatLost) << "another client has it now";
  c.cid ^= 0x10000U;
  c.seat = 7;
  EXPECT_EQ(execute(rig, c).result, Result::kSeatLost);
  c.seat = kTrainer;
  ASSERT_EQ(remove(rig, kTrainer), Result::kDone);
  EXPECT_EQ(execute(rig, c).result, Result::kSeatLost) << "from the moment of the removal on";
  EXPECT_EQ(rig.session->stop_control().latch().stops(), 0U);
}

// One participant is removed: the hand is released, the other hand on the same tool feels no jump, and the client
// receives the reason.
TEST(Commands, RemoveAParticipantWithoutAForceStepAndReportTheReason) {
  for (const auto why : {wire::CloseReason::kRemoved, wire::CloseReason::kRevoked}) {
    SessionFixture rig("free_motion");
    rig.run(2s);
    ASSERT_EQ(execute(rig, weights(AccessRole::kInstructor, rig.session->authority().version(), {0.5, 0.5})).result,
              Result::kDone);
    rig.run(2s);
    ASSERT_TRUE(rig.seats[kTrainee].core->gate().active());
    static_cast<void>(events(*rig.session));
    ASSERT_EQ(remove(rig, kTrainee, why), Result::kDone);
    EXPECT_TRUE(rig.session->participants().removing(kTrainee));
    EXPECT_EQ(remove(rig, kTrainee, why), Result::kNothingToDo) << "the removal is in progress";
    EXPECT_EQ(rig.session->participants().may_admit(rig.now, kTrainee, false), JoinResult::kSeatTaken)
        << "until the hand is released";
    const int told_before = rig.forces[2];
    double step = 0, last = rig.seats[kTrainer].device->state().f_out.norm();
    std::optional<int> closed_after, let_go_after;
    for (int ms = 0; ms < 400; ++ms) {
      rig.tick([] {});
      const double now = rig.seats[kTrainer].device->state().f_out.norm();
      step = std::max(step, std::abs(now - last));
      last = now;
      const hal::State& let_go =
          rig.seats[kTrainee]
              .device->state();  // the rest of the force after the ramp brakes the hand and never pushes it
      if (!let_go_after && ms > 100 && (let_go.f_out.norm() < 0.01 || let_go.f_out.dot(let_go.dx) <= 0))
        let_go_after = ms;
      if (!closed_after && rig.seats[kTrainee].core->closed()) closed_after = ms;
    }
    EXPECT_LE(step, 0.2) << "the other hand";
    ASSERT_TRUE(closed_after && let_go_after);
    EXPECT_LE(*let_go_after, 130) << "the gate's own ramp";
    EXPECT_GT(*closed_after, *let_go_after) << "first the release, then the notice";
    EXPECT_GE(rig.forces[2] - told_before, 100) << "it receives datagrams during the release";
    EXPECT_EQ(rig.seats[kTrainee].core->close_reason(), why);
    EXPECT_EQ(rig.seats[kTrainee].core->gate().trips(), 0U);
    EXPECT_FALSE(rig.session->seat(kTrainee).taken());
    EXPECT_EQ(rig.session->seat(kTrainee).resume(), (std::array<std::byte, 32>{})) << "the old secret resumes no seat";
    EXPECT_NEAR(rig.session->tool(0).authority.alpha(kTrainer), 1, 1e-9);
    const auto noted = events(*rig.session);
    EXPECT_EQ(std::ranges::count(noted, AuditEvent::What::kRemoved, &AuditEvent::what), 1);
    EXPECT_EQ(remove(rig, kTrainee), Result::kNothingToDo) << "the seat is free";
    EXPECT_EQ(rig.session->participants().may_admit(rig.now, kTrainee, false), JoinResult::kAccepted);
  }
}

TEST(Commands, IgnoreRequestsOfASeatThatIsBeingRemoved) {
  SessionFixture rig("free_motion");
  rig.run(2s);
  EXPECT_EQ(stop(rig, AccessRole::kOperator).result, Result::kDone);
  rig.run(20ms);
  ASSERT_EQ(remove(rig, kTrainer), Result::kDone);
  const std::uint32_t version = rig.session->authority().version();
  const std::array alpha{0.5, 0.5};
  rig.seats[kTrainer].core->requests().change_authority(0, alpha);
  rig.seats[kTrainer].core->requests().resume();
  rig.run(100ms);
  EXPECT_EQ(rig.session->authority().version(), version);
  EXPECT_EQ(rig.session->state(), wire::SessionState::kStopped);
}

TEST(Commands, DoNotRemoveTheNextOwnerOfASeat) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  const std::uint32_t former = rig.session->seat(kTrainee).link()->own_cid() ^ 0x20000U;
  EXPECT_EQ(remove_client(*rig.session, kTrainee, former, wire::CloseReason::kRevoked), Result::kNothingToDo);
  EXPECT_FALSE(rig.session->participants().removing(kTrainee));
  EXPECT_EQ(remove_client(*rig.session, 9, 0, wire::CloseReason::kRevoked), Result::kNoSuchSeat);
  EXPECT_EQ(execute(rig, rpc::RemoveParticipant{{}, "absent", ""}, AccessRole::kOperator).result, Result::kNoSuchSeat);
}

TEST(Commands, ReturnTheStatusWithoutChangingTheSession) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  const std::uint64_t before = rig.state_hash();
  const CommandOutcome look = status(rig);
  EXPECT_EQ(rig.state_hash(), before);
  EXPECT_EQ(look.result, Result::kDone);
  EXPECT_EQ(look.state, wire::SessionState::kRunning);
  EXPECT_EQ(look.masters, 2);
  EXPECT_EQ(look.tools, 1);
  EXPECT_TRUE(look.seats[kTrainer].taken && look.seats[kTrainer].heard);
  EXPECT_FALSE(look.seats[2].taken);
  EXPECT_EQ(look.alpha[0][kTrainer] + look.alpha[0][kTrainee], 1.0);
}

TEST(Commands, TakeNoHeapBetweenTicks) {
  SessionFixture rig("free_motion");
  rig.run(1s);
  const std::uint32_t version = rig.session->authority().version();
  const std::array<SessionCommand, 5> commands{{{rpc::StopSession{}, AccessRole::kOperator},
                                                {rpc::ResumeSession{{}, 1}, AccessRole::kOperator},
                                                weights(AccessRole::kInstructor, version, {0.5, 0.5}),
                                                {rpc::RemoveParticipant{{}, "trainee", ""}, AccessRole::kInstructor},
                                                {rpc::StatusRequest{}, AccessRole::kRecorder}}};
  const tandem::test::AllocGuard guard;
  for (const SessionCommand& command : commands) EXPECT_EQ(execute(rig, command).result, Result::kDone);
  EXPECT_EQ(guard.count(), 0U);
}

// ---- Admission control ----

TEST(Admission, RejectsJoinsByOneLimitForTheThreadAndTheMachine) {
  const LoadLimits limits;
  EXPECT_EQ(limits.busy, 0.85);
  EXPECT_EQ(rejection_reason({0.80}, 0.80, 2, limits), "") << "195 clients of a core, as measured";
  EXPECT_NE(rejection_reason({0.90}, 0.90, 2, limits), "") << "225 clients of a core: no more";
  EXPECT_EQ(rejection_reason({0.85}, 1.7, 2, limits), "") << "joins at the limit are accepted";
  for (const Load& load : {Load{0.86}, Load{0.1, true}})
    EXPECT_NE(rejection_reason(load, 0.1, 2, limits).find("accepted up to 85 %"), std::string::npos);
  EXPECT_NE(rejection_reason({0.86}, 0.86, 2, limits).find("the session's thread works for 86 % of the time"),
            std::string::npos);
  EXPECT_NE(rejection_reason({0.5}, 1.8, 2, limits).find("the 2 processors busy for 90 % of the time"),
            std::string::npos)
      << "several threads share them";
  EXPECT_EQ(rejection_reason({0.5}, 9, 0, limits), "") << "a machine that does not report its processors";
  EXPECT_NE(rejection_reason({0.3}, 0.1, 2, {0.2}).find("up to 20 %"), std::string::npos);
}

TEST(Admission, CountsTheNewestClientsUntilAMeasurementHasThem) {
  NewClientLoad load;
  Time now{1h};
  for (int n = 0; n < 10; ++n, now += 50ms) load.add(now, 0.004);
  EXPECT_NEAR(load.expected(now), 0.04, 1e-12);
  EXPECT_NEAR(load.expected(now + 950ms), 0.04, 1e-12) << "1.45 s after the first";
  EXPECT_NEAR(load.expected(now + 1100ms), 0.04, 1e-12) << "in the next part";
  EXPECT_EQ(load.expected(now + 2700ms), 0) << "measured by now";
  load.add(now + 1h, 0.004);
  EXPECT_NEAR(load.expected(now + 1h), 0.004, 1e-12);
  EXPECT_EQ(load.expected(now + 2h), 0);
}

}  // namespace
}  // namespace tandem::server
