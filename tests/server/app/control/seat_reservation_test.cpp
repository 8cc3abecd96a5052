// Owners of seats and their resume secrets, join by join.
#include "server/app/control/seat_reservation.h"

#include <gtest/gtest.h>

#include "server/session/session_snapshot.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;
using ResumeMatch = SeatReservation::ResumeMatch;

constexpr Time kNow = Time{} + 1h;
const SeatReservation::Hash kDesk{std::byte{1}}, kOtherDesk{std::byte{2}};

Secret<32> secret(unsigned number) {
  Secret<32> made;
  made.bytes[0] = static_cast<std::byte>(number);
  return made;
}

/// A whole join. @param match of its resume secret; kNone: a new owner
void join(SeatReservation& seat, std::uint32_t cid, unsigned secret_number, ResumeMatch match = ResumeMatch::kNone,
          bool ever_heard = true, double scale = 1) {
  seat.begin_join();
  seat.offer(match, ever_heard, scale, std::nullopt);
  seat.admit({"desk", kDesk, 0}, cid, resume_hash(secret(secret_number).bytes, kDesk), "", kNow);
  EXPECT_EQ(seat.end_join(), std::nullopt) << "its ticket is used";
}

TEST(SeatReservation, MatchesTheSecretOfItsOwnersWorkstationOnly) {
  SeatReservation seat;
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kNone) << "no owner";
  EXPECT_EQ(seat.match(Secret<32>{}, {}), ResumeMatch::kNone);
  join(seat, 7, 1);
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kLatest);
  EXPECT_EQ(seat.match(secret(2), kDesk), ResumeMatch::kNone);
  EXPECT_EQ(seat.match(secret(1), kOtherDesk), ResumeMatch::kNone);
  EXPECT_TRUE(seat.owned_by(7));
  EXPECT_FALSE(seat.owned_by(8));
}

// A Welcome may be lost: the secret before it stays valid until datagrams of the new connection arrive.
TEST(SeatReservation, KeepsThePreviousSecretUntilTheNewConnectionIsHeard) {
  SeatReservation seat;
  join(seat, 7, 1);
  join(seat, 8, 2, ResumeMatch::kLatest, true);
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kPrevious);
  EXPECT_TRUE(seat.may_resume(ResumeMatch::kPrevious, 0s, false, kNow));
  EXPECT_FALSE(seat.may_resume(ResumeMatch::kPrevious, 0s, true, kNow)) << "the latest secret has arrived";
  join(seat, 9, 3, ResumeMatch::kPrevious, false);
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kPrevious) << "the last one under which datagrams arrived";
  EXPECT_EQ(seat.match(secret(2), kDesk), ResumeMatch::kNone);
  EXPECT_EQ(seat.match(secret(3), kDesk), ResumeMatch::kLatest);
}

TEST(SeatReservation, LeavesNoSecretOfAFormerOwner) {
  SeatReservation seat;
  join(seat, 7, 1);
  join(seat, 8, 2);
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kNone);
}

TEST(SeatReservation, ExpiresTenMinutesAfterItsOwnerWasLost) {
  SeatReservation seat;
  join(seat, 7, 1);
  EXPECT_TRUE(seat.may_resume(ResumeMatch::kLatest, kResumeLife, true, kNow));
  EXPECT_FALSE(seat.may_resume(ResumeMatch::kLatest, kResumeLife + 1ns, true, kNow));
  EXPECT_FALSE(seat.may_resume(ResumeMatch::kNone, 0s, true, kNow));
}

TEST(SeatReservation, IsReservedForTwoSecondsAfterARestart) {
  SeatReservation seat;
  seat.restore({true, resume_hash(secret(1).bytes, kDesk), 0.5}, kNow + 600s, kNow);
  EXPECT_TRUE(seat.reserved(kNow + 2s - 1ns));
  EXPECT_FALSE(seat.reserved(kNow + 2s));
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kLatest);
  EXPECT_TRUE(seat.may_resume(ResumeMatch::kLatest, 0s, false, kNow + 600s));
  EXPECT_FALSE(seat.may_resume(ResumeMatch::kLatest, 0s, false, kNow + 600s + 1ns));
  EXPECT_EQ(seat.force_scale(), 0.5);
  join(seat, 7, 2, ResumeMatch::kLatest, false, seat.force_scale());
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kPrevious) << "the server before had heard its owner";
  EXPECT_TRUE(seat.may_resume(ResumeMatch::kLatest, 0s, true, kNow + 700s)) << "the restart is over for this seat";
  EXPECT_FALSE(seat.reserved(kNow));
  EXPECT_EQ(seat.force_scale(), 0.5);
}

TEST(SeatReservation, IsNotReservedForAnOwnerWhoCannotResume) {
  SeatReservation free_seat, without_secret;
  free_seat.restore({false, resume_hash(secret(1).bytes, kDesk), 1}, kNow + 600s, kNow);
  without_secret.restore({true, {}, 1}, kNow + 600s, kNow);
  EXPECT_FALSE(free_seat.reserved(kNow));
  EXPECT_FALSE(without_secret.reserved(kNow));
  EXPECT_EQ(without_secret.match(Secret<32>{}, kDesk), ResumeMatch::kNone);
}

TEST(SeatReservation, ReturnsTheTicketOfAFailedJoinOnce) {
  SeatReservation seat;
  join(seat, 7, 1);
  const auth::Id16 ticket{std::byte{9}};
  seat.begin_join();
  EXPECT_TRUE(seat.joining());
  seat.offer(ResumeMatch::kNone, true, 0.25, ticket);
  EXPECT_EQ(seat.end_join(), ticket);
  EXPECT_FALSE(seat.joining());
  EXPECT_EQ(seat.end_join(), std::nullopt);
  EXPECT_TRUE(seat.owned_by(7)) << "a failed join changes nothing";
  EXPECT_EQ(seat.force_scale(), 1);
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kLatest);
}

TEST(SeatReservation, TakesSeatAndSecretFromARemovedOwnerWithAReason) {
  SeatReservation seat;
  join(seat, 7, 1);
  const auto owner = seat.remove_owner("removed by desk-1");
  ASSERT_TRUE(owner);
  EXPECT_EQ(owner->spki, kDesk);
  EXPECT_FALSE(seat.owned_by(7));
  EXPECT_EQ(seat.match(secret(1), kDesk), ResumeMatch::kNone);
  EXPECT_EQ(seat.lost_reason(7), "removed by desk-1");
  EXPECT_EQ(seat.lost_reason(8), "") << "another connection";
  EXPECT_EQ(seat.remove_owner("again"), std::nullopt);
}

TEST(SeatReservation, KnowsTheNamesOfItsLastTwoOwnersByTime) {
  SeatReservation seat;
  EXPECT_EQ(seat.person_at(kNow), "");
  const auto take = [&seat](const std::string& person, Time at) {
    seat.begin_join();
    seat.offer(ResumeMatch::kNone, true, 1, std::nullopt);
    seat.admit({"desk", kDesk, 0}, 7, {}, person, at);
    EXPECT_EQ(seat.end_join(), std::nullopt);
  };
  take("ann", kNow);
  EXPECT_EQ(seat.person(), "ann");
  EXPECT_EQ(seat.person_at(kNow - 1ns), "");
  EXPECT_EQ(seat.person_at(kNow), "ann");
  take("bob", kNow + 1s);
  EXPECT_EQ(seat.person_at(kNow + 1s - 1ns), "ann") << "an event of the owner before";
  EXPECT_EQ(seat.person_at(kNow + 1s), "bob");
  take("", kNow + 2s);
  EXPECT_EQ(seat.person(), "") << "the ticket names no person";
  EXPECT_EQ(seat.person_at(kNow + 1s), "bob");
  EXPECT_EQ(seat.person_at(kNow), "") << "two owners are known: no name rather than a wrong one";
  SeatReservation restored;
  restored.restore({true, resume_hash(secret(1).bytes, kDesk), 1}, kNow + 600s, kNow, "ann");
  EXPECT_EQ(restored.person(), "ann");
}

}  // namespace
}  // namespace tandem::server
