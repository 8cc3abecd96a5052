// The state of its sessions that a server publishes for their next owner.
#include "server/app/service/directory_snapshots.h"

#include <gtest/gtest.h>
#include <poll.h>

#include <chrono>
#include <optional>
#include <vector>

#include "server/service/service_consoles.h"

namespace tandem::server {
namespace {

class DirectorySnapshotsTest : public testing::Test {
 protected:
  /// A session "lab" of this server, as the owner of this epoch has it.
  std::shared_ptr<CheckpointMailbox> add(std::uint64_t epoch) {
    SessionSnapshot kept;
    kept.name = "lab";
    kept.id = kId;
    kept.checkpoint.epoch = epoch;
    return snapshots.add(std::move(kept));
  }
  /// A checkpoint with this number of orders.
  static Checkpoint with_orders(std::uint32_t orders) {
    Checkpoint checkpoint;
    checkpoint.epoch = 12;
    checkpoint.tools_n = checkpoint.masters_n = checkpoint.dof = checkpoint.seats_n = 1;
    checkpoint.tools[0].alpha[0] = 1;
    checkpoint.orders = orders;
    return checkpoint;
  }
  [[nodiscard]] bool order_waits() const {
    pollfd file{snapshots.order_fd(), POLLIN, 0};
    return poll(&file, 1, 0) == 1;
  }
  static constexpr rpc::Id kId{std::byte{9}};
  static constexpr auth::Id16 kTicket{std::byte{1}};
  Time now{std::chrono::seconds(1000)};
  DirectorySnapshots snapshots;
};

TEST_F(DirectorySnapshotsTest, TakeConsolesOnceWhenTheyChangeAlsoWithoutASnapshot) {
  static_cast<void>(add(12));
  EXPECT_TRUE(snapshots.take(now).empty());
  snapshots.set_consoles("lab", {kTicket});
  snapshots.set_consoles("other", {kTicket});
  const auto first = snapshots.take(now);
  ASSERT_EQ(first.size(), 1u);
  EXPECT_EQ(first[0].session, "lab");
  EXPECT_TRUE(first[0].snapshot.empty());
  ASSERT_TRUE(first[0].consoles);
  EXPECT_EQ(parse_service_consoles(*first[0].consoles), (ServiceConsoles{kId, 12, {kTicket}}));
  EXPECT_TRUE(snapshots.take(now).empty());
  snapshots.set_consoles("lab", {kTicket});
  EXPECT_TRUE(snapshots.take(now).empty()) << "the same ones";
  snapshots.set_consoles("lab", {});
  const auto last = snapshots.take(now);
  ASSERT_EQ(last.size(), 1u);
  EXPECT_EQ(parse_service_consoles(last[0].consoles.value_or("")), (ServiceConsoles{kId, 12, {}}));
}

/// Snapshot and consoles go to the directory with one epoch, so that the next owner knows that they belong together.
TEST_F(DirectorySnapshotsTest, TakeCheckpointsWithoutConsolesThatHaveNotChanged) {
  const auto mailbox = add(12);
  Checkpoint checkpoint;
  checkpoint.epoch = 12;
  checkpoint.tools_n = checkpoint.masters_n = checkpoint.dof = 1;
  checkpoint.seats_n = 1;
  checkpoint.tools[0].alpha[0] = 1;
  snapshots.set_consoles("lab", {kTicket});
  ASSERT_TRUE(mailbox->publish(checkpoint));
  const auto both = snapshots.take(now);
  ASSERT_EQ(both.size(), 1u);
  const auto snapshot = decode_snapshot(std::as_bytes(std::span(both[0].snapshot)));
  ASSERT_TRUE(snapshot) << snapshot.error();
  EXPECT_EQ(tickets_for_next_owner(both[0].consoles.value_or(""), kId, snapshot->checkpoint.epoch),
            std::vector{kTicket});
  ++checkpoint.session_tick;
  ASSERT_TRUE(mailbox->publish(checkpoint));
  const auto later = snapshots.take(now);
  ASSERT_EQ(later.size(), 1u);
  EXPECT_FALSE(later[0].snapshot.empty());
  EXPECT_FALSE(later[0].consoles);
}

TEST_F(DirectorySnapshotsTest, OnlyANewOrderWakesItsReader) {
  const auto mailbox = add(12);
  ASSERT_TRUE(mailbox->publish(with_orders(0)));
  EXPECT_FALSE(order_waits());
  ASSERT_TRUE(mailbox->publish(with_orders(1)));
  EXPECT_TRUE(order_waits()) << "also while an older checkpoint waits";
  ASSERT_TRUE(mailbox->publish(with_orders(1)));
  const auto news = snapshots.take(now);
  ASSERT_EQ(news.size(), 1u);
  EXPECT_TRUE(news[0].order);
  EXPECT_FALSE(order_waits());
  ASSERT_TRUE(mailbox->publish(with_orders(1)));
  EXPECT_FALSE(order_waits());
  EXPECT_TRUE(snapshots.take(now).empty());
}

TEST_F(DirectorySnapshotsTest, AnOrderCountsOnceTheSnapshotThatHasItIsInTheDirectory) {
  const auto mailbox = add(12);
  ASSERT_TRUE(mailbox->publish(with_orders(0)));
  const auto before = snapshots.take(now);
  ASSERT_EQ(before.size(), 1u);
  ASSERT_TRUE(mailbox->publish(with_orders(1)));
  const auto stopped = snapshots.take(now);
  ASSERT_EQ(stopped.size(), 1u) << "an order that changes nothing else is written, too";
  snapshots.set_stored(before[0].mark);
  EXPECT_FALSE(mailbox->stored().has(1)) << "it was taken before the order, though written afterwards";
  snapshots.set_stored(stopped[0].mark);
  EXPECT_TRUE(mailbox->stored().has(1));
  EXPECT_FALSE(mailbox->stored().has(2));
  // A late answer for the run of before says nothing about the next one of the same name.
  const auto next = add(13);
  snapshots.set_stored(stopped[0].mark);
  EXPECT_FALSE(next->stored().has(1));
}

TEST_F(DirectorySnapshotsTest, TellEverySessionWhyTheDirectoryStoresNothing) {
  const auto mailbox = add(12);
  snapshots.set_problem("it is silent");
  EXPECT_EQ(mailbox->stored().problem(), "it is silent");
  EXPECT_EQ(add(13)->stored().problem(), "it is silent") << "one that begins meanwhile";
  snapshots.set_problem("");
  EXPECT_EQ(add(14)->stored().problem(), "");
}

/// Else a next owner would give an unused session the whole time once more.
TEST_F(DirectorySnapshotsTest, TakeTheRestOfTheTimeOfASessionAgainThoughNothingElseChanges) {
  SessionSnapshot kept;
  kept.name = "lab";
  kept.life_left_s = 3600;
  const auto mailbox = snapshots.add(std::move(kept));
  EXPECT_TRUE(snapshots.take(now).empty());
  const auto left_in = [](const std::vector<DirectorySnapshots::News>& news) -> std::optional<std::int64_t> {
    if (news.size() != 1) return std::nullopt;
    const auto snapshot = decode_snapshot(std::as_bytes(std::span(news[0].snapshot)));
    return snapshot ? snapshot->life_left_s : std::nullopt;
  };
  now += std::chrono::milliseconds(1500);
  ASSERT_TRUE(mailbox->publish(with_orders(0)));
  EXPECT_EQ(left_in(snapshots.take(now)), 3599);
  now += std::chrono::seconds(29);
  EXPECT_TRUE(snapshots.take(now).empty());
  now += std::chrono::seconds(1);
  EXPECT_EQ(left_in(snapshots.take(now)), 3569);
  EXPECT_TRUE(snapshots.take(now).empty());
  now += std::chrono::hours(2);
  EXPECT_EQ(left_in(snapshots.take(now)), 0) << "its owner ends it now";
}

}  // namespace
}  // namespace tandem::server
