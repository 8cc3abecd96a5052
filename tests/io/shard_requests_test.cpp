// Requests of the control plane to a shard, from posting to completion.
#include "server/app/control/shard_requests.h"

#include <gtest/gtest.h>

#include <chrono>
#include <string>
#include <thread>
#include <vector>

#include "common/io/udp_socket.h"
#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"

namespace tandem::server {
namespace {

/// A shard without a thread: its requests wait until `run_shard`.
struct Rig {
  Rig() { requests.watch(shard); }
  void post(std::function<void(ShardRequest&)> done) {
    requests.post(shard, {.what = ShardRequest::What::kEndSession, .session = &session, .done = std::move(done)});
  }
  /// Ends the shard, which replies to all requests that the session is over, and completes them.
  void run_shard() {
    shard.stop();
    shard.run();
    context.poll();
  }

  SceneSpec scene = *parse_scene(find_shipped_scene("free_motion")->text, "free_motion.textproto");
  TickQueue records{16};
  LiveSession session{scene, *make_local_slaves(scene, Time{}), 0, records};
  Shard shard{std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), 1000};
  asio::io_context context;
  ShardRequests requests{context};
};

TEST(ShardRequests, CompleteInOrderWithTheResultOfTheShard) {
  Rig rig;
  std::vector<int> done;
  for (int i = 0; i < 3; ++i)
    rig.post([&done, i](ShardRequest& r) {
      EXPECT_EQ(r.result, JoinResult::kSessionOver) << "the shard does not serve the session";
      done.push_back(i);
    });
  EXPECT_TRUE(done.empty());
  rig.run_shard();
  EXPECT_EQ(done, (std::vector<int>{0, 1, 2}));
}

TEST(ShardRequests, AreIdleAfterTheLastRequestOfASession) {
  Rig rig;
  bool idle = false;
  rig.requests.when_idle(rig.session, [&] { idle = true; });
  EXPECT_TRUE(idle) << "no request is in progress";
  idle = false;
  int done = 0;
  for (int i = 0; i < 2; ++i)
    rig.post([&](ShardRequest&) {
      EXPECT_FALSE(idle);
      ++done;
    });
  rig.requests.when_idle(rig.session, [&] { idle = true; });
  EXPECT_FALSE(idle);
  rig.run_shard();
  EXPECT_EQ(done, 2);
  EXPECT_TRUE(idle);
}

TEST(ShardRequests, WaitForAPlaceIfTheyMustNotBeLost) {
  Rig rig;
  LiveSession served{rig.scene, *make_local_slaves(rig.scene, Time{}), 1, rig.records};
  ASSERT_TRUE(rig.shard.add_session(served));
  int lost = 0;
  for (int posted = 0; lost == 0 && posted < 10000; ++posted) rig.post([&lost](ShardRequest&) { ++lost; });
  ASSERT_EQ(lost, 1) << "the queue is full";
  std::vector<int> done;
  for (int i = 0; i < 2; ++i)
    rig.requests.post_when_possible(
        rig.shard, {.what = ShardRequest::What::kEndSession, .session = &served, .done = [&done, i](ShardRequest& r) {
                      EXPECT_EQ(r.result, JoinResult::kAccepted);
                      done.push_back(i);
                    }});
  EXPECT_TRUE(done.empty());
  std::thread ticking([&rig] { rig.shard.run(); });
  for (int i = 0; i < 3000 && done.size() < 2; ++i) rig.context.run_one_for(std::chrono::milliseconds(10));
  EXPECT_EQ(done, (std::vector<int>{0, 1}));
  rig.shard.stop();
  ticking.join();
}

TEST(ShardRequests, CompleteAllThatWaitForAPlaceAtTheEnd) {
  Rig rig;
  int lost = 0;
  for (int posted = 0; lost == 0 && posted < 10000; ++posted) rig.post([&lost](ShardRequest&) { ++lost; });
  std::size_t over = 0;
  const auto post = [&rig, &over] {
    rig.requests.post_when_possible(
        rig.shard, {.what = ShardRequest::What::kEndSession, .session = &rig.session, .done = [&over](ShardRequest& r) {
                      EXPECT_EQ(r.result, JoinResult::kSessionOver);
                      ++over;
                    }});
  };
  for (std::size_t i = 0; i < ShardRequests::kRetriedMax; ++i) post();
  EXPECT_EQ(over, 0U);
  post();
  EXPECT_EQ(over, 1U) << "their number is bounded";
  rig.requests.stop_watching();
  EXPECT_EQ(over, ShardRequests::kRetriedMax + 1);
  lost = 0;
  rig.run_shard();
}

TEST(ShardRequests, WaitWhileTheirSessionMoves) {
  Rig rig;
  Shard target{std::move(*io::bind_udp(*io::parse_address("127.0.0.1:0", 0))), 1000};
  LiveSession other{rig.scene, *make_local_slaves(rig.scene, Time{}), 1, rig.records};
  std::vector<std::string> done;
  const auto note = [&done](const char* name) { return [&done, name](ShardRequest&) { done.push_back(name); }; };
  const auto move = [&](LiveSession& session, const char* name) {
    rig.requests.move(
        rig.shard,
        {.what = ShardRequest::What::kMoveSession, .session = &session, .target = &target, .done = note(name)});
  };
  rig.post(note("before"));
  move(rig.session, "move");
  move(other, "second move");
  EXPECT_EQ(done, std::vector<std::string>{"second move"}) << "one session moves at a time";
  rig.post(note("first"));
  rig.requests.post_when_possible(
      rig.shard, {.what = ShardRequest::What::kEndSession, .session = &rig.session, .done = note("second")});
  rig.requests.post(rig.shard, {.what = ShardRequest::What::kEndSession, .session = &other, .done = note("other")});
  rig.run_shard();  // it serves no session, so it rejects the move
  EXPECT_EQ(done, (std::vector<std::string>{"second move", "before", "move", "other"}));
  bool idle = false;
  rig.requests.when_idle(rig.session, [&idle] { idle = true; });
  EXPECT_FALSE(idle);
  rig.run_shard();
  EXPECT_EQ(done, (std::vector<std::string>{"second move", "before", "move", "other", "first", "second"}));
  EXPECT_TRUE(idle);
}

TEST(ShardRequests, AreBoundedAndCompletedAtTheEndWhileTheirSessionMoves) {
  Rig rig;
  std::size_t over = 0;
  const auto count = [&over](ShardRequest& r) {
    EXPECT_EQ(r.result, JoinResult::kSessionOver);
    ++over;
  };
  rig.requests.move(rig.shard, {.what = ShardRequest::What::kMoveSession, .session = &rig.session, .done = count});
  for (std::size_t i = 0; i < ShardRequests::kHeldMax; ++i) rig.post(count);
  EXPECT_EQ(over, 0U);
  rig.post(count);
  EXPECT_EQ(over, 1U);
  rig.requests.stop_watching();
  EXPECT_EQ(over, 1 + ShardRequests::kHeldMax);
}

TEST(ShardRequests, MoveNoSessionWhileOthersWaitForAPlace) {
  Rig rig;
  int lost = 0;
  for (int posted = 0; lost == 0 && posted < 10000; ++posted) rig.post([&lost](ShardRequest&) { ++lost; });
  rig.requests.post_when_possible(rig.shard, {.what = ShardRequest::What::kEndSession, .session = &rig.session});
  bool refused = false;
  rig.requests.move(rig.shard,
                    {.what = ShardRequest::What::kMoveSession,
                     .session = &rig.session,
                     .done = [&refused](ShardRequest& r) { refused = r.result == JoinResult::kSessionOver; }});
  EXPECT_TRUE(refused) << "the waiting request would go to a shard that no longer serves its session";
  rig.requests.stop_watching();
  rig.run_shard();
}

TEST(ShardRequests, CompleteAtOnceWhenTheQueueIsFull) {
  Rig rig;
  int done = 0, posted = 0;
  while (done == 0 && ++posted < 10000)
    rig.post([&done](ShardRequest& r) {
      EXPECT_EQ(r.result, JoinResult::kSessionOver);
      ++done;
    });
  EXPECT_EQ(done, 1) << "after " << posted;
  rig.run_shard();
  EXPECT_EQ(done, posted);
}

}  // namespace
}  // namespace tandem::server
