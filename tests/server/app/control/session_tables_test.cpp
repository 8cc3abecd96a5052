// Small tables of a session on the control plane: consoles, link tests, removed workstations, and the drain of a
// server.
#include <gtest/gtest.h>

#include "server/app/control/console_tickets.h"
#include "server/app/control/drain_schedule.h"
#include "server/app/control/removed_workstations.h"
#include "server/app/control/slot_reservations.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

Secret<32> console(int number) {
  Secret<32> secret;
  secret.bytes[0] = static_cast<std::byte>(number);
  return secret;
}
constexpr std::uint32_t kCid = 70, kOther = 71;
const WorkstationRow kDesk{"desk", {std::byte{7}}, 1000};

/// A console whose Welcome was sent.
ConsoleTickets joined_console(const auth::Id16& ticket) {
  ConsoleTickets consoles;
  consoles.add(console(1), kCid, {ticket, AccessRole::kOperator, "ann", kDesk});
  consoles.join(console(1), kCid);
  return consoles;
}

TEST(ConsoleTickets, ReturnATicketOnce) {
  ConsoleTickets consoles;
  const auth::Id16 ticket{std::byte{5}};
  consoles.add(console(1), kCid, {ticket});
  EXPECT_TRUE(consoles.contains(console(1), kCid));
  EXPECT_FALSE(consoles.contains(console(2), kCid));
  EXPECT_EQ(consoles.take(console(2), kCid), std::nullopt);
  EXPECT_EQ(consoles.take(console(1), kCid), ticket);
  EXPECT_EQ(consoles.take(console(1), kCid), std::nullopt);
  EXPECT_FALSE(consoles.contains(console(1), kCid));
}

TEST(ConsoleTickets, LetAConsoleComeBackWithItsSecretForAMinute) {
  const auth::Id16 ticket{std::byte{5}};
  ConsoleTickets consoles = joined_console(ticket);
  const auto may = [&](Time now) { return consoles.may_come_back(console(1), kDesk, now) != nullptr; };
  EXPECT_TRUE(may(Time{})) << "the server may not have noticed the end";
  consoles.leave(console(1), kCid, Time{10s});
  EXPECT_TRUE(consoles.empty());
  EXPECT_FALSE(consoles.contains(console(1), kCid));
  EXPECT_TRUE(consoles.returning_next().empty()) << "it has left";
  EXPECT_TRUE(may(Time{69s}));
  EXPECT_FALSE(may(Time{70s}));
  EXPECT_EQ(consoles.may_come_back(console(1), kDesk, Time{69s})->person, "ann");
  EXPECT_EQ(consoles.may_come_back(console(2), kDesk, Time{69s}), nullptr);
  WorkstationRow other = kDesk;
  other.spki = {std::byte{8}};
  EXPECT_EQ(consoles.may_come_back(console(1), other, Time{69s}), nullptr);
  other = kDesk;
  other.enrolled_at = 2000;
  EXPECT_EQ(consoles.may_come_back(console(1), other, Time{69s}), nullptr) << "its key was revoked meanwhile";
  consoles.join(console(1), kOther);
  EXPECT_TRUE(consoles.contains(console(1), kOther));
  EXPECT_EQ(consoles.returning_next(), std::vector{ticket});
}

TEST(ConsoleTickets, GiveTheRightOfAConsoleToItsNewestConnectionAlone) {
  ConsoleTickets consoles = joined_console({std::byte{5}});
  EXPECT_FALSE(consoles.came_back(console(1)));
  consoles.join(console(1), kOther);
  EXPECT_TRUE(consoles.came_back(console(1)));
  EXPECT_FALSE(consoles.contains(console(1), kCid));
  EXPECT_TRUE(consoles.replaced(console(1), kCid));
  EXPECT_FALSE(consoles.replaced(console(1), kOther));
  consoles.leave(console(1), kCid, Time{10s});
  EXPECT_EQ(consoles.take(console(1), kCid), std::nullopt);
  EXPECT_TRUE(consoles.contains(console(1), kOther)) << "the end of the old connection changes nothing";
}

TEST(ConsoleTickets, AreBoundedForConsolesThatAreAway) {
  ConsoleTickets consoles;
  for (int n = 0; n < 100; ++n) {
    consoles.add(console(n), kCid, {});
    consoles.join(console(n), kCid);
    consoles.leave(console(n), kCid, Time{10s});
  }
  const WorkstationRow none{};
  EXPECT_EQ(consoles.may_come_back(console(35), none, Time{11s}), nullptr);
  EXPECT_NE(consoles.may_come_back(console(36), none, Time{11s}), nullptr);
}

TEST(ConsoleTickets, LetNoConsoleComeBackThatHasGotNoWelcome) {
  ConsoleTickets consoles;
  consoles.add(console(1), kCid, {{}, AccessRole::kOperator, "", kDesk});
  EXPECT_EQ(consoles.may_come_back(console(1), kDesk, Time{}), nullptr);
}

TEST(ConsoleTickets, OfTheFormerOwnerReturnOnceUntilTheirTimeIsOver) {
  const auth::Id16 one{std::byte{1}}, two{std::byte{2}}, other{std::byte{3}};
  ConsoleTickets consoles({one, two}, Time{10s});
  EXPECT_TRUE(consoles.empty()) << "no console is joined yet";
  EXPECT_TRUE(consoles.returns(one, Time{9s}));
  EXPECT_FALSE(consoles.returns(one, Time{10s}));
  EXPECT_FALSE(consoles.returns(other, Time{9s}));
  consoles.add(console(1), kCid, {one});
  EXPECT_FALSE(consoles.returns(one, Time{9s})) << "it must not admit a second console";
  EXPECT_TRUE(consoles.returned(console(1)));
  consoles.join(console(1), kCid);
  EXPECT_EQ(consoles.take(console(1), kCid), one);
  EXPECT_FALSE(consoles.returns(one, Time{9s})) << "its console has left";
  EXPECT_TRUE(consoles.returns(two, Time{9s}));
}

TEST(ConsoleTickets, ReturnAgainWhenTheWelcomeWasNotSent) {
  const auth::Id16 one{std::byte{1}}, fresh{std::byte{2}};
  ConsoleTickets consoles({one}, Time{10s});
  consoles.add(console(1), kCid, {one});
  consoles.add(console(2), kCid, {fresh});
  EXPECT_FALSE(consoles.returned(console(2)));
  EXPECT_EQ(consoles.take(console(1), kCid), one);
  EXPECT_EQ(consoles.take(console(2), kCid), fresh);
  EXPECT_TRUE(consoles.returns(one, Time{}));
  EXPECT_FALSE(consoles.returns(fresh, Time{})) << "a ticket that no former owner has had";
}

TEST(ConsoleTickets, NextOwnerGetsThoseOfJoinedConsolesAndThoseThatReturn) {
  const auth::Id16 one{std::byte{1}}, two{std::byte{2}}, fresh{std::byte{3}}, unsent{std::byte{4}};
  ConsoleTickets consoles({one, two}, Time{10s});
  consoles.add(console(1), kCid, {one});  // its Welcome is not sent yet
  consoles.add(console(2), kCid, {fresh});
  consoles.join(console(2), kCid);
  consoles.add(console(3), kCid, {unsent});
  EXPECT_EQ(consoles.returning_next(), (std::vector{one, fresh, two}));
  EXPECT_EQ(consoles.release_all(), (std::vector{one, fresh, unsent}));
  EXPECT_TRUE(consoles.empty());
  EXPECT_EQ(consoles.returning_next(), (std::vector{two, one, fresh, unsent}));
}

TEST(LinkTestSlots, BeginNoMoreJoinsThanThereAreSlots) {
  LinkTestSlots slots;
  for (std::size_t i = 0; i < LinkTestSlots::kMax; ++i) EXPECT_TRUE(slots.begin_join()) << i;
  EXPECT_FALSE(slots.begin_join());
  EXPECT_TRUE(slots.enough(LinkTestSlots::kMax));
  EXPECT_FALSE(slots.enough(LinkTestSlots::kMax - 1)) << "one join in progress would find no slot";
  slots.cancel_join();
  EXPECT_TRUE(slots.enough(LinkTestSlots::kMax - 1));
  EXPECT_TRUE(slots.begin_join());
}

TEST(LinkTestSlots, KnowThePeerOfEachSlotUntilItIsRemoved) {
  LinkTestSlots slots;
  ASSERT_TRUE(slots.begin_join());
  slots.admit(2, {"desk", {}, 0}, 77);
  EXPECT_TRUE(slots.find(77));
  EXPECT_FALSE(slots.find(0)) << "empty slots have no peer";
  EXPECT_EQ(slots.slots()[2].owner->name, "desk");
  slots.remove(2);
  EXPECT_FALSE(slots.find(77));
  for (std::size_t i = 0; i < LinkTestSlots::kMax; ++i) EXPECT_TRUE(slots.begin_join()) << "no join is in progress";
}

TEST(LinkTestSlots, AssignPlacesBehindTheSeatsInTurn) {
  LinkTestSlots slots;
  const unsigned first = slots.next_place();
  EXPECT_EQ(first, kSeatsMax + 1);
  for (unsigned i = 1; i < 64; ++i) EXPECT_EQ(slots.next_place(), first + i);
  EXPECT_EQ(slots.next_place(), first);
  for (int i = 0; i < 256; ++i) EXPECT_GE(slots.next_place(), first) << "also when its counter wraps";
}

TEST(RemovedWorkstations, StoreEachWorkstationOnce) {
  std::vector<std::size_t> stored;
  RemovedWorkstations removed({}, [&](const auto& keys) { stored.push_back(keys.size()); });
  const RemovedWorkstations::Key desk{std::byte{1}}, other{std::byte{2}};
  EXPECT_FALSE(removed.contains(desk));
  removed.add(desk);
  removed.add(desk);
  removed.add(other);
  EXPECT_TRUE(removed.contains(desk));
  EXPECT_EQ(stored, (std::vector<std::size_t>{1, 2}));
}

TEST(RemovedWorkstations, ContainAllWorkstationsOnceTheyAreFull) {
  std::vector<RemovedWorkstations::Key> keys(kRemovedWorkstationsMax - 1);
  for (std::size_t i = 0; i < keys.size(); ++i) keys[i][0] = static_cast<std::byte>(i);
  RemovedWorkstations removed(keys);
  const RemovedWorkstations::Key fresh{std::byte{200}}, unknown{std::byte{201}};
  EXPECT_FALSE(removed.contains(fresh));
  removed.add(fresh);
  EXPECT_TRUE(removed.contains(unknown));
}

TEST(DrainSchedule, BecomesSoonerButNeverLater) {
  DrainSchedule drain;
  EXPECT_FALSE(drain.active());
  drain.begin();
  EXPECT_TRUE(drain.active());
  EXPECT_EQ(drain.due(), std::nullopt);
  drain.schedule(Time{} + 30s);
  drain.schedule(Time{} + 60s);
  EXPECT_EQ(drain.due(), Time{} + 30s);
  drain.schedule(Time{} + 5s);
  EXPECT_EQ(drain.due(), Time{} + 5s);
}

}  // namespace
}  // namespace tandem::server
