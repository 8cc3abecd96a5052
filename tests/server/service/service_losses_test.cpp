// Servers whose directory loses its data while they run, in virtual time.
#include "common/base/rng.h"
#include "tests/common/base/counts.h"
#include "tests/server/service/service_fixture.h"

namespace tandem::server::test {
namespace {

using Kind = ServiceEvent::Kind;

class ServiceLosses : public ServiceTest {
 protected:
  Server& begin(const std::string& name, std::map<std::string, ServiceSession> configured = {}) {
    Server& server = start(name, std::move(configured));
    server.member.registry().set_local({});
    pass(200ms);
    return server;
  }
  /// No server reaches the directory for this time. Then each server reaches the next one at a moment of its own.
  void lose(RandomStream& draws, Duration outage, Duration apart, directory::ModelStore next) {
    for (const auto& server : servers_) server->directory.cut = true;
    pass(outage);
    store_ = std::move(next);
    std::map<Server*, Time> back;
    for (const auto& server : servers_)
      back[server.get()] =
          now_ + Duration{static_cast<std::int64_t>(draws.below(static_cast<std::uint64_t>(apart.count()) + 1))};
    for (const Time end = now_ + apart + 20ms; now_ < end; pass(20ms))
      for (const auto& server : servers_) server->directory.cut = now_ < back[server.get()];
    for (const auto& server : servers_) server->directory.cut = false;
  }
  /// A store with nothing in it, and this number of revisions.
  static directory::ModelStore empty(directory::LeaseId leases, std::uint64_t revisions = 0) {
    directory::ModelStore store(leases);
    for (; revisions > 0; --revisions)
      static_cast<void>(store.execute(1, directory::Transaction{{}, {directory::Put{"/other", "x"}}, {}}));
    return store;
  }
  static void describe_as_draining(Server& server) {
    directory::ServerRecord record;
    record.address = "a:7000";
    record.key = "k";
    record.version = "1";
    record.capacity = 4;
    record.drains = true;
    server.member.describe(record);
  }
  Server* owner(const std::string& session) {
    Server* found = nullptr;
    for (const auto& server : servers_)
      if (server->open.contains(session)) found = server.get();
    return found;
  }
};

// An operator's `end` must not be undone by servers that put back the sessions that they had.
TEST_F(ServiceLosses, SessionsThatWereOverDoNotComeBack) {
  Server& a = begin("a", {{"lab", session_spec(1)}});
  ASSERT_TRUE(a.member.create(now_, "made", session_spec(3), 7));
  pass(1s);
  ASSERT_TRUE(a.open.contains("made"));
  a.directory.cut = true;
  a.open.clear();
  a.member.sessions().end("made");
  a.member.sessions().replace("lab", session_spec(2));
  pass(100ms);
  store_ = empty(1000);
  a.directory.cut = false;
  pass(20s);
  EXPECT_FALSE(has("live/sessions/made/owner"));
  EXPECT_FALSE(a.open.contains("made"));
  ASSERT_TRUE(a.open.contains("lab"));
  EXPECT_EQ(a.open["lab"].spec.id[0], std::byte{2}) << "its next run";
}

// The same, if the server learns of the loss before it has reported the end.
TEST_F(ServiceLosses, SessionsThatAreOverWhileTheyAreGivenUpDoNotComeBack) {
  Server& a = begin("a");
  ASSERT_TRUE(a.member.create(now_, "made", session_spec(3), 7));
  pass(1s);
  a.runs = false;
  a.directory.cut = true;
  store_ = empty(1000);
  a.directory.cut = false;
  for (int n = 0; n < 100 && !a.member.sessions().has_event(); ++n) {
    pass(20ms);
    a.member.step(now_);
  }
  ASSERT_TRUE(a.member.sessions().has_event());
  EXPECT_TRUE(a.member.ends("made")) << "no reply yet that it has ended";
  a.member.end("made");
  a.open.erase("made");
  a.runs = true;
  pass(20s);
  EXPECT_FALSE(a.open.contains("made"));
  EXPECT_FALSE(a.member.ends("made"));
}

/// No other server has their state, and the server must not end before they are served again.
TEST_F(ServiceLosses, SessionsOfAServerThatDrainsGoOnToo) {
  Server& a = begin("a", {{"lab", session_spec(1)}});
  ASSERT_TRUE(a.member.create(now_, "made", session_spec(3), 7));
  pass(1s);
  for (const char* name : {"lab", "made"}) a.member.sessions().set_snapshot(name, "state");
  pass(500ms);
  describe_as_draining(a);
  RandomStream draws{RandomKey{1}};
  lose(draws, 1s, 20ms, empty(1000));
  pass(500ms);
  EXPECT_TRUE(a.open.empty()) << "given up, with the lease of the lost directory";
  for (int n = 0; n < 600 && a.open.size() < 2; ++n) {
    EXPECT_FALSE(a.member.empty()) << "its process would end";
    pass(20ms);
  }
  for (const char* name : {"lab", "made"}) {
    ASSERT_TRUE(a.open.contains(name)) << name;
    EXPECT_EQ(a.open[name].snapshot, "state") << name;
    a.member.moves().set_loads({{name, 0.1, 0.1, true}});
  }
  Server& b = begin("b");
  pass(10s);
  EXPECT_EQ(b.open.size(), 2u) << "they move, as at any drain";
  EXPECT_TRUE(a.member.empty());
}

TEST_F(ServiceLosses, ServerThatDrainsBeginsNoSessionOfItsConfiguration) {
  Server& a = begin("a", {{"lab", session_spec(1)}});
  Server& b = begin("b");
  order_move("lab", "b");
  pass(2s);
  ASSERT_TRUE(b.open.contains("lab"));
  describe_as_draining(a);
  b.runs = false;
  b.open.clear();
  RandomStream draws{RandomKey{1}};
  lose(draws, 5s, 20ms, empty(1000));
  pass(20s);
  EXPECT_TRUE(a.open.empty());
}

// Sessions of the configuration, and one that an operator created: all go on from their state, with a higher epoch.
TEST_F(ServiceLosses, AllSessionsGoOnFromTheirStateWhenTheDirectoryIsBegunFromNothing) {
  const std::uint64_t count = tandem::test::seeds(60);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream draws{RandomKey{seed}};
    servers_.clear();
    store_ = empty(0, draws.below(100));
    know_each_other();
    const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}, {"two", session_spec(2)}};
    Server& a = begin("a", configured);
    begin("b", configured);
    ASSERT_TRUE(a.member.create(now_, "made", session_spec(3), 7));
    pass(1s);
    std::map<std::string, std::int64_t> epochs;
    for (int loss = 1; loss <= 3; ++loss) {
      for (const char* name : {"lab", "two", "made"}) {
        ASSERT_NE(owner(name), nullptr) << name;
        owner(name)->member.sessions().set_snapshot(name, "state " + std::to_string(loss));
        epochs[name] = owner(name)->open.at(name).revision;
      }
      pass(500ms);
      const Duration outage = std::chrono::milliseconds(100 + draws.below(8000));
      const Duration apart = std::chrono::milliseconds(draws.below(2) == 0 ? 300 : 3000);
      lose(draws, outage, apart, empty(loss * 1000, draws.below(2) == 0 ? 0 : draws.below(40)));
      pass(12s);
      for (const char* name : {"lab", "two", "made"}) {
        ASSERT_NE(owner(name), nullptr) << name;
        const ServiceEvent& open = owner(name)->open.at(name);
        EXPECT_EQ(open.snapshot, "state " + std::to_string(loss)) << name;
        EXPECT_GT(open.revision, epochs[name]) << name;
        EXPECT_EQ(value(std::string("snapshots/") + name), "state " + std::to_string(loss));
        for (const auto& server : servers_) {
          const SessionPlace place = server->member.locate(named(name));
          if (server->open.contains(name))
            EXPECT_EQ(place.kind, SessionPlace::Kind::kHere);
          else
            EXPECT_EQ(place.revision, open.revision) << name;
        }
      }
    }
  }
}

// The owner cannot reach the new directory, and acts by a lease of the lost one. check_single_actor() looks at it.
TEST_F(ServiceLosses, NoOtherServerActsBeforeTheLeaseOfTheLostDirectoryIsOver) {
  const std::uint64_t count = tandem::test::seeds(60);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream draws{RandomKey{seed}};
    servers_.clear();
    store_ = empty(0);
    know_each_other();
    const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}};
    Server& a = begin("a", configured);
    Server& b = begin("b", configured);
    pass(Duration{static_cast<std::int64_t>(draws.below(1'000'000'000))});
    ASSERT_TRUE(a.open.contains("lab"));
    a.directory.cut = true;
    store_ = empty(1000, draws.below(60));
    b.directory.cut = true;
    pass(20ms);
    b.directory.cut = false;
    for (int n = 0; n < 600; ++n) {
      static_cast<void>(b.member.locate(named("lab")));
      b.member.want("lab");
      pass(20ms);
    }
    EXPECT_TRUE(b.open.contains("lab"));
    a.directory.cut = false;
    pass(3s);
    EXPECT_FALSE(a.open.contains("lab"));
    EXPECT_EQ(a.member.locate(named("lab")).server, "b");
  }
}

// A server that was started again knows by its agreement that the directory is another one.
TEST_F(ServiceLosses, ServerThatStartsAgainWaitsForTheLeasesOfTheLostDirectory) {
  const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}};
  Server& a = begin("a", configured);
  pass(1s);
  const RegistryAgreement agreed = a.member.registry().agreed();
  ASSERT_FALSE(agreed.mark.empty());
  a.directory.cut = true;
  store_ = empty(1000);
  servers_.push_back(std::make_unique<Server>(
      store_, ServiceMemberOptions{.server = "b", .key = RandomKey{2}, .configured = configured, .agreed = agreed}));
  servers_.back()->member.describe({.address = "b:7000", .key = "k", .version = "1", .zone = {}, .capacity = 4});
  servers_.back()->member.registry().set_local({});
  pass(2s);
  EXPECT_TRUE(servers_.back()->member.status(now_).recovers);
  pass(9s);
  EXPECT_TRUE(servers_.back()->open.contains("lab"));
  EXPECT_EQ(servers_.back()->member.status(now_).losses, 1u);
}

// It cannot know whether the directory was another one a moment ago.
TEST_F(ServiceLosses, ServerInItsFirstStartWaitsForTheTimeOfALease) {
  const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}};
  Server& a = begin("a", configured);
  ASSERT_TRUE(a.open.contains("lab"));
  a.directory.cut = true;
  store_ = empty(1000);
  agreed_ = {};
  Server& b = start("b", configured);
  b.member.registry().set_local({});
  const Time began = now_;
  while (!b.open.contains("lab") && now_ < began + 10s) pass(20ms);
  EXPECT_GE(now_, began + 2s);
  EXPECT_LE(now_, began + 3s);
}

// Servers stop, the directory is put back to an older copy, servers start: revisions are lower than those in the file.
TEST_F(ServiceLosses, ServerThatStartsNoticesThatTheDirectoryWasPutBackMeanwhile) {
  const std::map<std::string, ServiceSession> configured{{"lab", session_spec(1)}};
  Server& a = begin("a", configured);
  pass(1s);
  const directory::ModelStore copy = store_;
  a.member.sessions().set_snapshot("lab", "newer");
  pass(1s);
  agreed_ = a.member.agreement(now_);
  EXPECT_GT(agreed_.revision, copy.revision());
  const std::int64_t epoch = a.open.at("lab").revision;
  servers_.clear();
  pass(5s);
  store_ = copy;
  store_.resume(now_, 1000);
  Server& b = begin("b", configured);
  EXPECT_EQ(b.member.status(now_).losses, 1u);
  const auto waiting = b.member.agreement(now_);
  pass(9s);
  ASSERT_TRUE(b.open.contains("lab"));
  EXPECT_GT(b.open.at("lab").revision, epoch);
  EXPECT_FALSE(agreed_.waits);
  EXPECT_TRUE(waiting.waits);
  // A server that starts later learns from the new mark and from the others' records.
  Server& c = begin("c", configured);
  EXPECT_EQ(c.member.locate(named("lab")).revision, b.open.at("lab").revision);
}

TEST_F(ServiceLosses, SessionsAreComingAndCreationsAreRefusedMeanwhile) {
  RandomStream draws{RandomKey{1}};
  Server& a = begin("a", {{"lab", session_spec(1)}});
  pass(1s);
  lose(draws, 1s, 0ms, empty(1000));
  pass(500ms);
  EXPECT_TRUE(a.member.status(now_).recovers);
  EXPECT_EQ(a.member.locate(named("lab")).kind, SessionPlace::Kind::kComing);
  EXPECT_EQ(a.member.locate(named("other")).kind, SessionPlace::Kind::kUnknown);
  EXPECT_TRUE(a.member.create(now_, "other", session_spec(2), 5));
  act(a);
  EXPECT_EQ(a.events.back().kind, Kind::kRefused);
  EXPECT_NE(a.events.back().text.find("has lost its data"), std::string::npos);
  pass(9s);
  EXPECT_FALSE(a.member.status(now_).recovers);
  EXPECT_EQ(a.member.locate(named("lab")).kind, SessionPlace::Kind::kHere);
  EXPECT_EQ(a.member.locate(named("other")).kind, SessionPlace::Kind::kNone);
}

// The next owner has the newest state: the former one must not bring its own back.
TEST_F(ServiceLosses, LostLeaseAloneBringsNoSessionBack) {
  Server& a = begin("a", {{"lab", session_spec(1)}});
  Server& b = begin("b");
  pass(3s);
  a.member.sessions().set_snapshot("lab", "old");
  pass(1s);
  a.directory.cut = true;
  pass(6s);
  ASSERT_TRUE(b.open.contains("lab"));
  b.member.sessions().end("lab");
  pass(1s);
  a.directory.cut = false;
  pass(10s);
  EXPECT_FALSE(a.open.contains("lab"));
  EXPECT_FALSE(has("catalogue/lab/spec"));
  EXPECT_EQ(a.member.status(now_).losses, 0u);
}

}  // namespace
}  // namespace tandem::server::test
