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
  /// Posts a request that changes nothing.
  void ask(std::function<void(ShardRequest&)> done) {
    requests.post(shard, {.what = ShardRequest::What::kQueryPeers, .session = &session, .done = std::move(done)});
  }
  /// Asks until the shard has no place for another question. @return number of questions that it has
  int fill() {
    int posted = 0;
    for (bool full = false; !full && posted < 10000; ++posted)
      ask([&full, this](ShardRequest& r) {
        if (r.result == JoinResult::kBusy) full = true;
        ++answered;
      });
    EXPECT_EQ(answered, 1) << "the one that was too much";
    return posted - 1;
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
  int answered = 0;  ///< questions of `fill`
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
  rig.fill();
  std::vector<int> done;
  for (int i = 0; i < 2; ++i)
    rig.requests.post(
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
  const int asked = rig.fill();
  int over = 0;
  for (int i = 0; i < 3; ++i)
    rig.post([&over](ShardRequest& r) {
      EXPECT_EQ(r.result, JoinResult::kSessionOver);
      ++over;
    });
  EXPECT_EQ(over, 0);
  rig.requests.stop_watching();
  EXPECT_EQ(over, 3);
  rig.requests.watch(rig.shard);
  rig.run_shard();
  EXPECT_EQ(rig.answered, asked + 1);
}

/// All revoked workstations of a server lose their seats in one call.
TEST(ShardRequests, AreAllCompletedHoweverManyOneCallPosts) {
  Rig rig;
  LiveSession served{rig.scene, *make_local_slaves(rig.scene, Time{}), 1, rig.records};
  ASSERT_TRUE(rig.shard.add_session(served));
  std::thread ticking([&rig] { rig.shard.run(); });
  constexpr int kMany = 5000;
  int done = 0;
  for (int i = 0; i < kMany; ++i) {
    rig.requests.post(
        rig.shard,
        {.what = ShardRequest::What::kRevokeSeat, .session = &served, .done = [&done](ShardRequest&) { ++done; }});
    // The shard executes what it has, though no completion is read.
    if (i % 500 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  }
  EXPECT_EQ(done, 0);
  bool idle = false;
  rig.requests.when_idle(served, [&idle] { idle = true; });
  for (int i = 0; i < 3000 && !idle; ++i) rig.context.run_one_for(std::chrono::milliseconds(10));
  EXPECT_TRUE(idle);
  EXPECT_EQ(done, kMany);
  rig.shard.stop();
  ticking.join();
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
  rig.post(note("second"));
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
  std::size_t over = 0, busy = 0;
  const auto count = [&](ShardRequest& r) { ++(r.result == JoinResult::kBusy ? busy : over); };
  rig.requests.move(rig.shard, {.what = ShardRequest::What::kMoveSession, .session = &rig.session, .done = count});
  for (std::size_t i = 0; i < ShardRequests::kHeldMax; ++i) rig.ask(count);
  EXPECT_EQ(busy, 0U);
  rig.ask(count);
  EXPECT_EQ(busy, 1U) << "questions are bounded";
  rig.post(count);
  EXPECT_EQ(over, 0U) << "all others wait";
  rig.requests.stop_watching();
  EXPECT_EQ(over, ShardRequests::kHeldMax + 1);
}

TEST(ShardRequests, MoveNoSessionWhileOthersWaitForAPlace) {
  Rig rig;
  rig.fill();
  rig.post([](ShardRequest&) {});
  bool refused = false;
  rig.requests.move(rig.shard,
                    {.what = ShardRequest::What::kMoveSession,
                     .session = &rig.session,
                     .done = [&refused](ShardRequest& r) { refused = r.result == JoinResult::kSessionOver; }});
  EXPECT_TRUE(refused) << "the waiting request would go to a shard that no longer serves its session";
  rig.requests.stop_watching();
  rig.run_shard();
}

TEST(ShardRequests, SayAtOnceThatTheShardHasNoPlaceForAQuestion) {
  Rig rig;
  const int asked = rig.fill();
  EXPECT_LT(asked, 1000);
  rig.run_shard();
  EXPECT_EQ(rig.answered, asked + 1);
  bool answered = false;
  rig.ask([&answered](ShardRequest&) { answered = true; });
  EXPECT_FALSE(answered) << "there is a place again";
  rig.run_shard();
  EXPECT_TRUE(answered);
}

}  // namespace
}  // namespace tandem::server
