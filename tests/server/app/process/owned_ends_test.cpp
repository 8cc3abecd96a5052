// How sessions of a service end: by their time limit, and while their server ends. Without clients.
#include "tests/server/app/process/owned_rig.h"

namespace tandem::server {
namespace {

using namespace test;

/// The wall clock of a next owner may be ahead by a year, or behind.
TEST(OwnedEnds, HaveTheRestOfTheirTimeByTheClockOfTheirFormerOwner) {
  for (const auto by_wall_clock : {-24h * 365, 24h * 365}) {
    Member m;
    m.rig.start();
    OwnedSession owned = m.owned(10);
    owned.ends_at = io::monotonic_now() + 1h;
    ASSERT_EQ(m.rig.table->open_owned(std::move(owned)), "");
    SessionSnapshot snapshot = m.kept.last;
    EXPECT_EQ(snapshot.life_left_s, 3600);
    snapshot.checkpoint = m.checkpoint();
    snapshot.life_left_s = 1800;
    m.rig.table->give_up("exam");
    m.service_until_over();
    OwnedSession again = m.owned(500);
    again.snapshot = snapshot;
    again.ends_at = io::monotonic_now() + by_wall_clock;
    ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
    m.rig.table->service(io::monotonic_now() + 1700s);
    EXPECT_FALSE(m.only().end);
    m.rig.table->service(io::monotonic_now() + 1801s);
    EXPECT_EQ(m.only().end, EndReason::kTimeLimit);
  }
}

/// A snapshot of a session that had the same name may be left over. Its state is not used, nor is its time.
TEST(OwnedEnds, HaveTheirOwnTimeIfTheSnapshotIsNotUsed) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(10)), "");
  SessionSnapshot other = m.kept.last;
  other.checkpoint = m.checkpoint();
  other.checkpoint.scene[0] ^= std::byte{1};
  other.life_left_s = 60;
  m.rig.table->give_up("exam");
  m.service_until_over();
  OwnedSession again = m.owned(500);
  again.snapshot = other;
  again.ends_at = io::monotonic_now() + 1h;
  ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
  m.rig.table->service(io::monotonic_now() + 61s);
  EXPECT_FALSE(m.only().end);
  m.rig.table->service(io::monotonic_now() + 3601s);
  EXPECT_EQ(m.only().end, EndReason::kTimeLimit);
}

/// A server that is being stopped must not hand a finished session to the next one.
TEST(OwnedEnds, AreOverIfTheyEndByThemselvesWhileTheServerEnds) {
  for (const bool ends : {true, false}) {
    Member m;
    m.rig.start();
    ASSERT_EQ(m.rig.table->open_owned(m.owned(10)), "");
    if (ends) {
      m.rig.control->change([&](SessionRegistry& registry, const auto& done) {
        registry.end(m.only().id());  // stands for the end of its scene: the table has not ordered it
        done();
      });
      for (int i = 0; i < 1000 && !m.only().live_session().ends(); ++i) poll(nullptr, 0, 1);
      ASSERT_TRUE(m.only().live_session().ends());
    }
    m.rig.table->drain();
    m.rig.shards.stop();
    m.service_until_over();
    EXPECT_EQ(m.overs, std::vector<bool>{!ends}) << "whether another server goes on with it";
  }
}

}  // namespace
}  // namespace tandem::server
