#include "client/app/transfer_tracker.h"

#include <gtest/gtest.h>

namespace tandem::client {
namespace {

using wire::TransferNotice;

/// A seat of a running session at 1 kHz.
struct Ticks {
  Ticks() { force.session = wire::SessionState::kRunning; }
  const TransferStatus& run(int ticks) {
    for (int k = 0; k < ticks; ++k) tracker.update(force);
    return tracker.status();
  }
  void announce(std::uint32_t ticks) {
    force.transfer = TransferNotice::kGaining;
    force.transfer_ticks = ticks;
    ++force.authority_version;
  }
  wire::ForceMessage force;
  TransferTracker tracker{1000};
};

TEST(TransferTracker, CountsDownToTheBeginOfAnAnnouncedTransfer) {
  Ticks seat;
  seat.run(10);
  seat.force.alpha = 0.25;
  seat.announce(50);
  const TransferStatus& s = seat.run(1);
  EXPECT_EQ(s.notice, TransferNotice::kGaining);
  EXPECT_EQ(s.count, 1U);
  EXPECT_DOUBLE_EQ(s.from, 0.25);
  EXPECT_DOUBLE_EQ(s.begins_s, 0.05);
  seat.run(20);
  EXPECT_DOUBLE_EQ(s.begins_s, 0.03);
  EXPECT_EQ(s.count, 1U) << "the same notice again";
  seat.announce(50);
  EXPECT_EQ(seat.run(1).count, 2U);
}

TEST(TransferTracker, IsDone100TicksAfterTheLastChangeOfAuthority) {
  Ticks seat;
  seat.announce(1);
  seat.run(1);
  seat.force.transfer = TransferNotice::kNone;
  for (int k = 0; k < 100; ++k) {
    seat.force.alpha += 0.01;
    EXPECT_FALSE(seat.run(1).done);
  }
  EXPECT_FALSE(seat.run(100).done);
  EXPECT_TRUE(seat.run(1).done);
}

TEST(TransferTracker, KeepsTheNoticeFor1000Ticks) {
  Ticks seat;
  seat.announce(1);
  seat.run(1);
  seat.force.transfer = TransferNotice::kNone;
  EXPECT_EQ(seat.run(1000).notice, TransferNotice::kGaining);
  EXPECT_EQ(seat.run(1).notice, TransferNotice::kNone);
}

TEST(TransferTracker, KeepsTheNoticeWhileTheAuthorityChanges) {
  Ticks seat;
  seat.announce(1);
  seat.run(1);
  seat.force.transfer = TransferNotice::kNone;
  for (int k = 0; k < 2000; ++k) {
    seat.force.alpha += 1e-4;
    ASSERT_EQ(seat.run(1).notice, TransferNotice::kGaining);
  }
}

TEST(TransferTracker, DropsTheNoticeWhenTheToolIsBraked) {
  Ticks seat;
  seat.announce(1);
  seat.run(1);
  seat.force.transfer = TransferNotice::kNone;
  seat.force.session = wire::SessionState::kPaused;
  EXPECT_EQ(seat.run(1).notice, TransferNotice::kGaining);
  seat.force.session = wire::SessionState::kHeld;
  EXPECT_EQ(seat.run(1).notice, TransferNotice::kNone);
}

}  // namespace
}  // namespace tandem::client
