// The hand-over of a session from one shard to another: both shards serve it at every tick once, whatever happens to
// them meanwhile. Without clients.
#include <gtest/gtest.h>
#include <unistd.h>

#include <list>
#include <memory>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/process/local_slaves.h"
#include "tests/io/shard_pair.h"

namespace tandem::test {
namespace {

using namespace std::chrono_literals;
using server::LiveSession;
using server::ShardRequest;

struct Rig {
  /// @param on  shard of the session; nullopt: none serves it
  LiveSession& add(std::optional<std::size_t> on = 0) {
    LiveSession& session = sessions.emplace_back(scene, *server::make_local_slaves(scene, Time{}),
                                                 static_cast<std::uint8_t>(sessions.size()), records);
    if (on) {
      EXPECT_TRUE(shards.shard(*on).add_session(session));
    }
    return session;
  }
  /// Waits until the condition holds; the test fails after 30 s.
  template <class Condition>
  void wait_until(Condition condition) {
    for (int i = 0; i < 30'000; ++i) {
      if (condition()) return;
      ::usleep(1000);
    }
    ADD_FAILURE() << "not within 30 s";
  }

  SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  server::TickQueue records{16};
  std::list<LiveSession> sessions;
  ShardPair shards{scene.tick_hz};
};

TEST(LiveSessionTicks, CountWhatWasMissedAndHaveEachNumberOnce) {
  Rig rig;
  LiveSession& session = rig.add(std::nullopt);
  session.set_last_tick(100);
  EXPECT_EQ(session.begin_tick(101), 0U);
  EXPECT_EQ(session.begin_tick(101), std::nullopt) << "its former shard has stepped it in this period";
  EXPECT_EQ(session.begin_tick(100), std::nullopt) << "a shard that is late";
  EXPECT_EQ(session.begin_tick(105), 3U);
  EXPECT_EQ(session.begin_tick(106), 0U);
}

TEST(ShardMoves, CarrySessionsFromOneThreadToTheOtherAndBack) {
  Rig rig;
  std::vector<LiveSession*> all;
  for (int i = 0; i < 10; ++i) all.push_back(&rig.add());
  rig.shards.run();
  for (int round = 0; round < 4; ++round)
    for (std::size_t i = 0; i < all.size(); ++i) ASSERT_TRUE(rig.shards.move(*all[i])) << round << " " << i;
  EXPECT_EQ(rig.shards.shard(0).sessions(), 10U);
  for (std::size_t i = 0; i < 5; ++i) ASSERT_TRUE(rig.shards.move(*all[i]));
  EXPECT_EQ(rig.shards.shard(0).sessions(), 5U);
  EXPECT_EQ(rig.shards.shard(1).sessions(), 5U);
  rig.shards.stop();
  for (LiveSession* session : all) EXPECT_TRUE(session->over()) << "the shard that serves it ended it";
}

TEST(ShardMoves, LeaveOutAtMostOneTickEachToAnIdleThread) {
  Rig rig;
  LiveSession &moved = rig.add(), &twin = rig.add();
  rig.shards.run();
  for (int i = 0; i < 40; ++i) {
    ASSERT_TRUE(rig.shards.move(moved));
    ::usleep(3000);
  }
  rig.shards.stop();
  const auto missed = [](LiveSession& s) { return s.final_status().machine.missed_ticks; };
  std::printf("[  moves   ] missed ticks %llu, twin %llu\n", static_cast<unsigned long long>(missed(moved)),
              static_cast<unsigned long long>(missed(twin)));
  EXPECT_LE(missed(moved), missed(twin) + 40) << "at most one per move, if the other thread wakes too late";
}

TEST(ShardMoves, AreRejectedByAThreadThatHasEnded) {
  Rig rig;
  LiveSession& session = rig.add();
  rig.shards.run();
  rig.shards.end(1);
  EXPECT_FALSE(rig.shards.move(session));
  EXPECT_EQ(rig.shards.shard(0).sessions(), 1U) << "its own thread goes on to serve it";
  rig.shards.stop();
  EXPECT_TRUE(session.over());
}

TEST(ShardMoves, EndWithTheThreadsInAnyOrder) {
  for (int round = 0; round < 30; ++round) {
    SCOPED_TRACE(round);
    Rig rig;
    LiveSession& session = rig.add();
    rig.shards.run();
    rig.shards.begin_move(session);
    for (int spin = 0; spin < 1000 * round; ++spin) static_cast<void>(rig.shards.shard(0).sessions());
    rig.shards.shard(round % 2 == 0 ? 0 : 1).stop();
    rig.shards.stop();
    bool moved = false;
    EXPECT_TRUE(rig.shards.complete(moved)) << "every request is answered";
    EXPECT_TRUE(session.over()) << "no session is left between two threads";
  }
}

TEST(ShardMoves, AreRejectedForASessionThatTheThreadDoesNotServe) {
  Rig rig;
  LiveSession& elsewhere = rig.add(std::nullopt);
  rig.add();
  rig.shards.run();
  EXPECT_FALSE(rig.shards.move(elsewhere));
}

TEST(ShardMoves, AreRejectedIfTheKernelRejectsTheProgram) {
  Rig rig;
  LiveSession& session = rig.add();
  rig.shards.run();
  io::Steering longer;  // no reader of a datagram's byte 2^32 - 1 exists, so the kernel rejects the program
  longer.byte = 0xffffffff;
  longer.socket_of[0] = 1;
  const io::SteeringProgram wrong{longer};
  EXPECT_FALSE(rig.shards.move(session, &wrong));
  EXPECT_EQ(rig.shards.shard(0).sessions(), 1U);
  EXPECT_TRUE(rig.shards.move(session)) << "the next attempt";
}

}  // namespace
}  // namespace tandem::test
