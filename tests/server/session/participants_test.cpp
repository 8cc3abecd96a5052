// Admission, presence and removal of participants.
#include "server/session/participants.h"

#include <gtest/gtest.h>

#include "server/session/seat_catalogue.h"
#include "tests/server/session/session_parts.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using test::SessionParts;
using What = AuditEvent::What;

struct People : SessionParts {
  People() : SessionParts("free_motion") {}
  SeatConnection connection(std::size_t seat) {
    transport::SecureChannel::Params keys;
    keys.outgoing = transport::Direction::kToClient;
    keys.own_cid = static_cast<std::uint32_t>(seat + 1);
    keys.tick = clock.tick_length();
    SeatConnection out = catalogue.make_connection(seat, keys, {});
    out.resume.fill(std::byte{7});
    return out;
  }
  JoinResult join(Time at, std::size_t seat, bool same_owner = false) {
    SeatConnection entry = connection(seat);
    return participants.admit(at, seat, entry, same_owner);
  }
  std::vector<What> whats() {
    std::vector<What> out;
    for (const AuditEvent& e : events()) out.push_back(e.what);
    return out;
  }
  static AxisArray ones() {
    AxisArray scale;
    scale.fill(1);
    return scale;
  }
  Time now{1h};
  SeatCatalogue catalogue{scene, ones()};
  Participants participants{seats, clock, audit};
};

TEST(Participants, ReserveASeatForItsOwnerUntilItIsSilentForTwoSeconds) {
  People p;
  EXPECT_EQ(p.participants.may_admit(p.now, 2, false), JoinResult::kNoSuchSeat);
  ASSERT_EQ(p.join(p.now, 0), JoinResult::kAccepted);
  EXPECT_EQ(p.join(p.now + 2s, 0), JoinResult::kSeatTaken);
  EXPECT_EQ(p.participants.may_admit(p.now + 2s, 1, false), JoinResult::kAccepted) << "another seat";
  EXPECT_EQ(p.participants.may_admit(p.now, 0, true), JoinResult::kAccepted) << "its owner";
  EXPECT_EQ(p.join(p.now + 2s + 1ns, 0), JoinResult::kAccepted);
  EXPECT_EQ(p.whats(), (std::vector{What::kJoin, What::kJoin}));
}

TEST(Participants, RemoveAParticipantAfterItsCloseOut) {
  People p;
  EXPECT_FALSE(p.participants.remove(0, wire::CloseReason::kRemoved)) << "the seat is free";
  EXPECT_FALSE(p.participants.remove(2, wire::CloseReason::kRemoved)) << "no such seat";
  ASSERT_EQ(p.join(p.now, 0), JoinResult::kAccepted);
  ASSERT_TRUE(p.participants.remove(0, wire::CloseReason::kRevoked));
  EXPECT_FALSE(p.participants.remove(0, wire::CloseReason::kRemoved)) << "it is in progress";
  EXPECT_EQ(p.participants.may_admit(p.now, 0, false), JoinResult::kSeatTaken);
  for (int n = 0; n < 170; ++n) {
    EXPECT_TRUE(p.participants.removing(0)) << n;
    EXPECT_EQ(p.participants.closing().due(0) != nullptr, n > 150) << n;
    p.participants.step_removals(p.now);
  }
  EXPECT_EQ(p.participants.closing().due(0)->reason(), wire::CloseReason::kRevoked);
  EXPECT_TRUE(p.seats[0].taken());
  p.participants.step_removals(p.now);
  EXPECT_FALSE(p.participants.removing(0));
  EXPECT_FALSE(p.seats[0].taken());
  EXPECT_EQ(p.seats[0].resume(), (std::array<std::byte, 32>{})) << "the old secret resumes no seat";
  EXPECT_EQ(p.whats(), (std::vector{What::kJoin, What::kRemoved}));
  p.participants.step_removals(p.now);
  EXPECT_TRUE(p.whats().empty()) << "once";
}

TEST(Participants, EndARemovalSilentlyIfTheClientLeavesOnItsOwn) {
  People p;
  ASSERT_EQ(p.join(p.now, 0), JoinResult::kAccepted);
  p.participants.remove(0, wire::CloseReason::kRemoved);
  p.participants.leave(p.now, 0);
  for (int n = 0; n < 200; ++n) p.participants.step_removals(p.now);
  EXPECT_EQ(p.whats(), (std::vector{What::kJoin, What::kLeave}));
}

TEST(Participants, AdmitNoClientToASessionThatEnds) {
  People p;
  p.participants.end(wire::CloseReason::kServerReturns);
  p.participants.end(wire::CloseReason::kDone);
  EXPECT_EQ(p.participants.closing().session.reason(), wire::CloseReason::kServerReturns) << "the first reason stays";
  EXPECT_EQ(p.join(p.now, 0), JoinResult::kSessionOver);
  for (int n = 0; n < 171; ++n) {
    EXPECT_FALSE(p.participants.closing().session.over()) << n;
    p.participants.step_end();
  }
  EXPECT_TRUE(p.participants.closing().session.over());
  EXPECT_EQ(p.join(p.now, 0), JoinResult::kSessionOver);
}

TEST(Participants, CountNoSilentClientAsPresentOrConnected) {
  People p;
  ASSERT_EQ(p.join(p.now, 0), JoinResult::kAccepted);
  p.participants.step(p.now);
  EXPECT_FALSE(p.participants.present()[0]) << "it has sent nothing yet";
  EXPECT_EQ(p.participants.connected(p.now), 0u);
  EXPECT_EQ(p.whats(), std::vector{What::kJoin}) << "a client that was never heard is not lost either";
}

TEST(Participants, ReportForbiddenRequestsOncePerSecondAndSeat) {
  People p;
  for (const Duration after : {0ms, 1ms, 999ms, 1000ms, 1001ms}) p.participants.reject_forbidden(p.now + after, 0);
  p.participants.reject_forbidden(p.now, 1);
  const auto events = p.events();
  ASSERT_EQ(events.size(), 3u);
  EXPECT_EQ(events[1].at, p.now + 1s);
  EXPECT_EQ(events[2].seat, 1);
}

}  // namespace
}  // namespace tandem::server
