#include "client/seat/seat_requests.h"

#include <gtest/gtest.h>

#include <array>

namespace tandem::client {
namespace {

using namespace std::chrono_literals;
using wire::SessionState;

SeatRequests requests_of(Role role, SeatKind kind = SeatKind::kMaster, bool may_end_pauses = false) {
  SeatSetup s;
  s.seat.role = role;
  s.seat.kind = kind;
  s.may_end_pauses = may_end_pauses;
  return SeatRequests{s};
}

wire::ForceMessage force(SessionState session, std::uint32_t stops = 0, std::uint32_t authority_version = 0) {
  wire::ForceMessage f;
  f.session = session;
  f.stops = stops;
  f.authority_version = authority_version;
  return f;
}

wire::StateMessage state_of(const SeatRequests& r) {
  wire::StateMessage out;
  r.fill(out);
  return out;
}

TEST(SeatRequests, RepeatsAStopUntilTheServerCountsIt) {
  SeatRequests r = requests_of(Role::kTrainee);
  r.on_force(force(SessionState::kRunning, 3));
  EXPECT_TRUE(r.stop_all());
  EXPECT_TRUE(state_of(r).stop_all);
  r.on_force(force(SessionState::kRunning, 3));
  EXPECT_TRUE(state_of(r).stop_all);
  r.on_force(force(SessionState::kPaused, 4));
  EXPECT_FALSE(state_of(r).stop_all);
}

TEST(SeatRequests, TakesAStopBeforeTheFirstForceAsSettledIfTheSessionIsStopped) {
  for (const SessionState session : {SessionState::kStopped, SessionState::kRunning}) {
    SeatRequests r = requests_of(Role::kInstructor);
    EXPECT_TRUE(r.stop_all());
    r.on_force(force(session, 7));
    EXPECT_EQ(state_of(r).stop_all, session == SessionState::kRunning);
  }
}

TEST(SeatRequests, RejectsAStopOfObserversAndSlaves) {
  SeatRequests observer = requests_of(Role::kObserver), slave = requests_of(Role::kTrainee, SeatKind::kSlave);
  EXPECT_FALSE(observer.stop_all());
  EXPECT_FALSE(slave.stop_all());
  EXPECT_FALSE(state_of(observer).stop_all || state_of(slave).stop_all);
}

TEST(SeatRequests, NamesTheNewestStopInAResumeUntilTheSessionRuns) {
  SeatRequests r = requests_of(Role::kInstructor);
  r.stop_locally();
  r.on_force(force(SessionState::kStopped, 5));
  EXPECT_TRUE(r.locally_stopped() && state_of(r).stop);
  r.resume();
  EXPECT_FALSE(r.locally_stopped());
  EXPECT_EQ(state_of(r).resume_stop, 5U);
  r.on_force(force(SessionState::kStopped, 5));
  EXPECT_EQ(state_of(r).resume_stop, 5U);
  r.on_force(force(SessionState::kStopped, 6));
  EXPECT_EQ(state_of(r).resume_stop, 0U) << "a later stop is not ended";
  r.resume();
  r.on_force(force(SessionState::kRunning, 6));
  EXPECT_EQ(state_of(r).resume_stop, 0U);
}

TEST(SeatRequests, EndsAPauseOnlyWhereTheSessionHasNoInstructor) {
  for (const bool may : {false, true})
    for (const SessionState session : {SessionState::kPaused, SessionState::kStopped}) {
      SeatRequests r = requests_of(Role::kTrainee, SeatKind::kMaster, may);
      r.on_force(force(session, 2));
      r.resume();
      EXPECT_EQ(state_of(r).resume_stop, may && session == SessionState::kPaused ? 2U : 0U);
    }
}

TEST(SeatRequests, SendsAuthorityEvery20MsForOneSecond) {
  SeatRequests r = requests_of(Role::kInstructor);
  r.on_force(force(SessionState::kRunning, 0, 9));
  EXPECT_FALSE(r.take_authority(Time{1s}));
  EXPECT_TRUE(r.change_authority(2, std::array{0.25, 0.75}));
  int sent = 0;
  for (Duration t = 0ms; t < 2s; t += 1ms)
    if (const auto m = r.take_authority(Time{1s} + t)) {
      ++sent;
      EXPECT_EQ(t % 20ms, 0ms);
      EXPECT_EQ(m->version, 9U);
      EXPECT_EQ(m->tool, 2U);
      EXPECT_EQ(m->masters, 2U);
      EXPECT_EQ(m->alpha[1], 0.75);
    }
  EXPECT_EQ(sent, 51);
}

TEST(SeatRequests, DropsAuthorityAfterTheDecisionOfAnotherSeat) {
  SeatRequests r = requests_of(Role::kInstructor);
  EXPECT_TRUE(r.change_authority(0, std::array{1.0}));
  r.on_force(force(SessionState::kRunning, 0, 1));
  EXPECT_FALSE(r.take_authority(Time{1s}));
}

TEST(SeatRequests, RenewsAuthorityThatFollowsAGrantedRequest) {
  for (const std::uint32_t by : {1U, 2U}) {  // own_master is 0, so this seat is number 1
    SeatRequests r = requests_of(Role::kInstructor);
    EXPECT_TRUE(r.change_authority(0, std::array{0.9, 0.1}));
    EXPECT_TRUE(r.take_authority(Time{1s}));
    EXPECT_TRUE(r.change_authority(0, std::array{0.8, 0.2}));
    wire::ForceMessage granted = force(SessionState::kRunning, 0, 1);
    granted.transfer = wire::TransferNotice::kLosing;
    granted.transfer_parties.by = by;
    r.on_force(granted);
    const auto next = r.take_authority(Time{1001ms});
    ASSERT_EQ(next.has_value(), by == 1U);
    if (next) {
      EXPECT_EQ(next->version, 1U);
      EXPECT_EQ(next->alpha[1], 0.2);
    }
  }
}

TEST(SeatRequests, RejectsAuthorityOfOtherRolesAndOfTooManyMasters) {
  SeatRequests evaluator = requests_of(Role::kEvaluator), trainee = requests_of(Role::kTrainee);
  EXPECT_FALSE(evaluator.change_authority(0, std::array{1.0}));
  EXPECT_FALSE(trainee.change_authority(0, std::array<double, kMastersMax + 1>{}));
  EXPECT_TRUE(trainee.change_authority(0, std::array{1.0}));
}

TEST(SeatRequests, KeepsOnlyStopsOnANewConnection) {
  SeatRequests r = requests_of(Role::kInstructor);
  r.on_force(force(SessionState::kStopped, 3));
  EXPECT_TRUE(r.change_authority(0, std::array{1.0}));
  r.resume();
  r.stop_locally();
  EXPECT_TRUE(r.stop_all());
  r.on_reconnect();
  EXPECT_FALSE(r.take_authority(Time{1s}));
  EXPECT_EQ(state_of(r).resume_stop, 0U);
  EXPECT_TRUE(state_of(r).stop && state_of(r).stop_all);
  r.on_force(force(SessionState::kRunning, 3));
  EXPECT_TRUE(state_of(r).stop_all) << "the new server has not counted it";
}

}  // namespace
}  // namespace tandem::client
