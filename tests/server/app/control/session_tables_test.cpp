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

TEST(ConsoleTickets, ReturnATicketOnce) {
  ConsoleTickets consoles;
  Secret<32> first, second;
  second.bytes[0] = std::byte{1};
  const auth::Id16 ticket{std::byte{5}};
  consoles.add(first, ticket);
  EXPECT_TRUE(consoles.contains(first));
  EXPECT_FALSE(consoles.contains(second));
  EXPECT_EQ(consoles.take(second), std::nullopt);
  EXPECT_EQ(consoles.take(first), ticket);
  EXPECT_EQ(consoles.take(first), std::nullopt);
  EXPECT_FALSE(consoles.contains(first));
}

Secret<32> console(int number) {
  Secret<32> secret;
  secret.bytes[0] = static_cast<std::byte>(number);
  return secret;
}

TEST(ConsoleTickets, OfTheFormerOwnerReturnOnceUntilTheirTimeIsOver) {
  const auth::Id16 one{std::byte{1}}, two{std::byte{2}}, other{std::byte{3}};
  ConsoleTickets consoles({one, two}, Time{10s});
  EXPECT_TRUE(consoles.empty()) << "no console is joined yet";
  EXPECT_TRUE(consoles.returns(one, Time{9s}));
  EXPECT_FALSE(consoles.returns(one, Time{10s}));
  EXPECT_FALSE(consoles.returns(other, Time{9s}));
  consoles.add(console(1), one);
  EXPECT_FALSE(consoles.returns(one, Time{9s})) << "it must not admit a second console";
  EXPECT_TRUE(consoles.returned(console(1)));
  consoles.join(console(1));
  EXPECT_EQ(consoles.take(console(1)), one);
  EXPECT_FALSE(consoles.returns(one, Time{9s})) << "its console has left";
  EXPECT_TRUE(consoles.returns(two, Time{9s}));
}

TEST(ConsoleTickets, ReturnAgainWhenTheWelcomeWasNotSent) {
  const auth::Id16 one{std::byte{1}}, fresh{std::byte{2}};
  ConsoleTickets consoles({one}, Time{10s});
  consoles.add(console(1), one);
  consoles.add(console(2), fresh);
  EXPECT_FALSE(consoles.returned(console(2)));
  EXPECT_EQ(consoles.take(console(1)), one);
  EXPECT_EQ(consoles.take(console(2)), fresh);
  EXPECT_TRUE(consoles.returns(one, Time{}));
  EXPECT_FALSE(consoles.returns(fresh, Time{})) << "a ticket that no former owner has had";
}

TEST(ConsoleTickets, NextOwnerGetsThoseOfJoinedConsolesAndThoseThatReturn) {
  const auth::Id16 one{std::byte{1}}, two{std::byte{2}}, fresh{std::byte{3}}, unsent{std::byte{4}};
  ConsoleTickets consoles({one, two}, Time{10s});
  consoles.add(console(1), one);  // its Welcome is not sent yet
  consoles.add(console(2), fresh);
  consoles.join(console(2));
  consoles.add(console(3), unsent);
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
