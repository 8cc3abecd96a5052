// Sessions on several tick threads: where they are placed, and what holds while they move. Without clients.
#include <algorithm>
#include <variant>

#include "common/io/exit_code.h"
#include "tests/server/app/process/table_rig.h"

namespace tandem::server {
namespace {

using namespace test;

ServerOptions two_threads(std::vector<SessionOptions> sessions) {
  ServerOptions options = options_with(std::move(sessions));
  options.threads = 2;
  return options;
}

/// Shard of each session, in the order of the table.
std::vector<std::size_t> shards_of(TableRig& rig) {
  std::vector<std::size_t> all;
  for (const auto& session : rig.table->all()) all.push_back(rig.shards.shard_of_slot(session->live_session().slot()));
  return all;
}

/// Number of sessions that each shard serves, once the sum is as expected; the test fails after 30 s.
std::vector<std::size_t> served(TableRig& rig, std::size_t sum) {
  std::vector<std::size_t> counts;
  for (int i = 0; i < 3000; ++i) {
    counts.clear();
    for (const auto& shard : rig.shards.all()) counts.push_back(shard->sessions());
    std::size_t all = 0;
    for (const std::size_t n : counts) all += n;
    if (all == sum) return counts;
    poll(nullptr, 0, 10);
  }
  ADD_FAILURE() << "the shards do not serve " << sum << " sessions";
  return counts;
}

using Shards = std::vector<std::size_t>;

TEST(SessionPlacement, SharesSessionsOfOneRateOutToThreads) {
  TableRig rig(two_threads({lesson("a"), lesson("b"), lesson("c")}));
  rig.start();
  EXPECT_EQ(shards_of(rig), (Shards{0, 1, 0}));
  EXPECT_EQ(served(rig, 3), (Shards{2, 1}));
  rig.create("d");
  rig.create("e");
  rig.create("f");
  const Shards all = shards_of(rig);
  EXPECT_EQ(all[3], 1U) << "the thread with fewer sessions, as none has been measured with clients";
  EXPECT_EQ(std::ranges::count(all, 0U), 3);
  EXPECT_EQ(served(rig, 6), (Shards{3, 3}));
}

TEST(SessionPlacement, TakesOneThreadIfOneSessionIsAllThatCanBeOpen) {
  ServerOptions options = two_threads({lesson("a")});
  options.created_max = 0;
  TableRig rig(std::move(options));
  EXPECT_EQ(rig.shards.rates(), std::vector<double>{1000});
}

TEST(SessionPlacement, HasRoomFor256SessionsAndNamesTheLimit) {
#ifdef __SANITIZE_THREAD__
  GTEST_SKIP()
      << "under the thread sanitizer 256 sessions at 1 kHz take more than two cores, and the load limits joins";
#endif
  ServerOptions options = two_threads({lesson("first")});
  options.created_max = 256;
  TableRig rig(std::move(options));
  rig.start();
  for (std::size_t i = 1; i < rpc::kSessionsMax; ++i) rig.create("s" + std::to_string(i));
  ASSERT_EQ(rig.table->all().size(), 256U);
  const Shards counts = served(rig, 256);
  EXPECT_GE(std::ranges::min(counts), 100U) << "both threads serve about half";
  const rpc::Body full = rig.order(rpc::CreateSession{.name = "more", .scene = "lesson"});
  ASSERT_TRUE(std::holds_alternative<rpc::ErrorReply>(full));
  EXPECT_EQ(std::get<rpc::ErrorReply>(full).code, rpc::ErrorCode::kFull);
  EXPECT_NE(std::get<rpc::ErrorReply>(full).text.find("256 sessions are open, and a server has at most 256"),
            std::string::npos)
      << std::get<rpc::ErrorReply>(full).text;
  // The slot of any ended session is free again.
  const rpc::Id id = rig.table->all()[100]->id();
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(rig.order(rpc::EndSession{id, ""})));
  rig.create("more");
  EXPECT_EQ(rig.table->all().back()->live_session().slot(), 100U);
}

TEST(SessionMoves, LeaveTheSessionServedListedAndOpenForOrders) {
  TableRig rig(two_threads({lesson("a"), lesson("b")}));
  rig.start();
  SessionInstance& a = *rig.table->all()[0];
  for (int i = 0; i < 20; ++i) {
    const std::size_t to = 1 - shards_of(rig)[0];
    ASSERT_TRUE(rig.table->move(a, to)) << i;
    ASSERT_EQ(shards_of(rig)[0], to);
  }
  EXPECT_EQ(shards_of(rig), (Shards{0, 1}));
  ASSERT_TRUE(rig.table->move(a, 1));
  EXPECT_EQ(served(rig, 2), (Shards{0, 2}));
  Shard* serves = nullptr;
  std::uint64_t moves = 0;
  rpc::SessionList list;
  rig.control->change([&](SessionRegistry& registry, const auto& done) {
    serves = registry.find(a.id())->registration.shard;
    moves = registry.moves();
    list = registry.list();
    done();
  });
  EXPECT_EQ(serves, rig.shards.all()[1].get());
  EXPECT_EQ(moves, 21U);
  EXPECT_EQ(list.sessions.size(), 2U);
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(rig.order(rpc::EndSession{a.id(), ""})));
  EXPECT_EQ(rig.names(), std::vector<std::string>{"b"});
  EXPECT_EQ(served(rig, 1), (Shards{0, 1}));
}

TEST(SessionMoves, ExecuteTheRequestsThatArriveMeanwhileOnTheNewThread) {
  TableRig rig(two_threads({lesson("a"), lesson("b")}));
  rig.start();
  SessionInstance& a = *rig.table->all()[0];
  for (int round = 0; round < 50; ++round) {
    SCOPED_TRACE(round);
    const std::size_t to = 1 - shards_of(rig)[0];
    const io::Steering changed = rig.shards.steering_with(0, to);
    const io::SteeringProgram there{changed}, before{rig.shards.steering()};
    std::vector<std::string> order;
    rig.control->change([&](SessionRegistry& registry, const auto& done) {
      const SessionEntry& entry = *registry.find(a.id());
      const auto ask = [&, done](const char* name, bool last) {
        registry.post(entry, {.what = ShardRequest::What::kQueryPeers, .done = [&, done, name, last](ShardRequest& r) {
                                EXPECT_EQ(r.result, JoinResult::kAccepted) << name;
                                order.push_back(name);
                                if (last) done();
                              }});
      };
      ask("before", false);
      registry.move(a.id(), *rig.shards.all()[to], there, before, [&](bool moved) {
        EXPECT_TRUE(moved);
        order.push_back("move");
      });
      ask("first", false);
      ask("second", true);
    });
    rig.shards.set_steering(changed);
    EXPECT_EQ(order, (std::vector<std::string>{"before", "move", "first", "second"}));
  }
}

TEST(SessionMoves, AreRefusedWhileAnotherSessionMoves) {
  TableRig rig(two_threads({lesson("a"), lesson("b"), lesson("c")}));
  rig.start();
  SessionInstance &a = *rig.table->all()[0], &c = *rig.table->all()[2];
  const io::SteeringProgram there{rig.shards.steering_with(0, 1)}, before{rig.shards.steering()};
  bool second = true, first = false;
  rig.control->change([&](SessionRegistry& registry, const auto& done) {
    registry.move(a.id(), *rig.shards.all()[1], there, before, [&, done](bool moved) {
      first = moved;
      done();
    });
    registry.move(c.id(), *rig.shards.all()[1], there, before, [&](bool moved) { second = moved; });
  });
  EXPECT_TRUE(first);
  EXPECT_FALSE(second);
}

TEST(SessionMoves, AreRefusedForTheSameThreadAndForASessionThatIsOver) {
  TableRig rig(two_threads({lesson("a"), lesson("b")}));
  rig.start();
  SessionInstance& a = *rig.table->all()[0];
  EXPECT_FALSE(rig.table->move(a, 0));
  EXPECT_EQ(served(rig, 2), (Shards{1, 1}));
  rig.control->change([&](SessionRegistry& registry, const auto& done) {
    registry.end(a.id());
    done();
  });
  rig.wait_until_over(a);
  EXPECT_FALSE(rig.table->move(a, 1));
  EXPECT_EQ(shards_of(rig), (Shards{0, 1})) << "its datagrams still go there";
  EXPECT_EQ(served(rig, 1), (Shards{0, 1}));
}

TEST(SessionMoves, LeaveARestartingSessionOnItsNewThread) {
  SessionOptions restarts = lesson("a");
  restarts.restart = true;
  TableRig rig(two_threads({restarts, lesson("b")}));
  rig.start();
  ASSERT_TRUE(rig.table->move(*rig.table->all()[0], 1));
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(rig.order(rpc::EndSession{rig.table->all()[0]->id(), ""})));
  EXPECT_EQ(rig.names(), (std::vector<std::string>{"a", "b"}));
  EXPECT_EQ(shards_of(rig), (Shards{1, 1}));
  EXPECT_EQ(served(rig, 2), (Shards{0, 2}));
}

TEST(SessionMoves, RelieveAStrainedThread) {
  // Without clients a session costs 1 to 3 us per tick: 60 of them at 10 kHz are more than 0.4 of any processor.
  std::vector<SessionOptions> sessions;
  for (int i = 0; i < 60; ++i) {
    sessions.push_back(lesson("s" + std::to_string(i)));
    sessions.back().scene.tick_hz = 10'000;
  }
  TableRig rig(two_threads(std::move(sessions)));
  rig.start();
  for (const auto& session : rig.table->all())
    if (rig.shards.shard_of_slot(session->live_session().slot()) == 1)
      while (!rig.table->move(*session, 0)) {  // refused only while the queue of a strained thread is full
      }
  ASSERT_EQ(served(rig, 60), (Shards{60, 0}));
  for (int i = 0; i < 3000 && rig.shards.all()[1]->sessions() == 0; ++i) {
    poll(nullptr, 0, 10);
    rig.table->balance(io::monotonic_now());
  }
  EXPECT_EQ(served(rig, 60), (Shards{59, 1})) << "one session moved, and the next one waits for three seconds";
  EXPECT_EQ(std::ranges::count(shards_of(rig), 1U), 1);
}

TEST(SessionMoves, EndWithADrain) {
  TableRig rig(two_threads({lesson("a"), lesson("b")}));
  rig.start();
  ASSERT_TRUE(rig.table->move(*rig.table->all()[0], 1));
  rig.table->drain();
  rig.shards.stop();
  rig.shards.join();
  rig.table->service(io::monotonic_now());
  EXPECT_TRUE(rig.table->all().empty());
  EXPECT_EQ(rig.table->exit_code(), io::kExitDone);
}

}  // namespace
}  // namespace tandem::server
