// Sessions of a service of several servers: opened as this server's own, given up, ended. Without clients.
#include <fstream>
#include <sstream>

#include "server/app/control/session_registry.h"
#include "tests/server/app/process/owned_rig.h"

namespace tandem::server {
namespace {

using namespace test;
using Names = std::vector<std::string>;

TEST(OwnedSessions, AreServedUnderTheirIdCodeAndRevision) {
  Member m;
  m.rig.start();
  EXPECT_TRUE(m.rig.table->all().empty()) << "a member opens only what it owns";
  ASSERT_EQ(m.rig.table->open_owned(m.owned(4711)), "");
  ASSERT_EQ(m.rig.names(), Names{"exam"});
  EXPECT_EQ(m.only().id(), m.owned(0).id);
  EXPECT_EQ(m.only().code(), "ABCDEFGHJK");
  EXPECT_EQ(m.only().epoch(), 4711U);
  EXPECT_EQ(m.kept.last.name, "exam");
  EXPECT_EQ(m.kept.last.code, "ABCDEFGHJK");
  EXPECT_EQ(m.checkpoint().epoch, 4711U);
  EXPECT_NE(m.rig.table->open_owned(m.owned(4712)).find("has a session exam"), std::string::npos);
}

/// A session that moves before its hands are there would leave an empty report at each server.
TEST(OwnedSessions, LeaveAReportOnlyOfATimeInWhichTheyRan) {
  const std::filesystem::path folder = testing::TempDir() + "owned_reports_" + std::to_string(::getpid());
  std::filesystem::create_directories(folder);
  const auto reports = [&](bool runs) {
    Member m;
    m.rig.start();
    SessionOptions options = lesson("exam");
    options.reports = folder.string();
    for (SeatSpec& seat : options.scene.seats) seat.required = seat.required && !runs;
    OwnedSession owned = m.owned(4711);
    owned.options = std::make_shared<const SessionOptions>(std::move(options));
    EXPECT_EQ(m.rig.table->open_owned(std::move(owned)), "");
    for (int i = 0; runs && i < 1000 && m.only().live_session().status().state == wire::SessionState::kWaiting; ++i)
      poll(nullptr, 0, 10);
    poll(nullptr, 0, 50);
    m.rig.table->give_up("exam");
    m.service_until_over();
    std::vector<std::filesystem::path> all;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) all.push_back(entry.path());
    return all;
  };
  EXPECT_EQ(reports(false).size(), 0U);
  const auto ran = reports(true);
  ASSERT_EQ(ran.size(), 1U);
  std::stringstream text;
  text << std::ifstream(ran.front()).rdbuf();
  EXPECT_NE(text.str().find("\"ended_by\": \"given_up\""), std::string::npos) << text.str();
  std::filesystem::remove_all(folder);
}

TEST(OwnedSessions, MayHaveATickRateThatNoConfiguredSessionHas) {
  Member m;
  m.rig.start();
  const auto with_rate = [&](const std::string& name, double tick_hz) {
    SessionOptions options = lesson(name);
    options.scene.tick_hz = tick_hz;
    OwnedSession owned = m.owned(3);
    owned.id[1] = static_cast<std::byte>(m.rig.table->all().size() + 1);
    owned.options = std::make_shared<const SessionOptions>(std::move(options));
    return owned;
  };
  ASSERT_EQ(m.rig.table->open_owned(with_rate("exam", 1000)), "");
  const std::size_t before = m.rig.shards.all().size();
  ASSERT_EQ(m.rig.table->open_owned(with_rate("slow", 500)), "");
  ASSERT_EQ(m.rig.table->open_owned(with_rate("slow-too", 500)), "");
  ASSERT_EQ(m.rig.table->open_owned(with_rate("fast", 2000)), "");
  EXPECT_EQ(m.rig.shards.all().size(), before + 2) << "one thread per further rate";
  for (const auto& session : m.rig.table->all()) {
    const auto period = from_seconds(1 / session->options().scene.tick_hz);
    EXPECT_EQ(m.rig.shards.of_slot(session->live_session().slot()).period(), period) << session->options().name;
  }
  const rpc::Body reply = m.rig.order(rpc::EndSession{.session_id = m.rig.table->all().back()->id()});
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(reply)) << "the added thread carries out orders";
  for (double tick_hz = 100; m.rig.shards.all().size() < io::Steering::kSocketsMax; ++tick_hz)
    ASSERT_TRUE(m.rig.shards.add(tick_hz));
  EXPECT_NE(m.rig.table->open_owned(with_rate("more", 777)).find("the most"), std::string::npos);
}

TEST(OwnedSessions, GoOnFromTheSnapshotOfTheirFormerOwner) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(10)), "");
  SessionSnapshot snapshot = m.kept.last;
  snapshot.checkpoint = m.checkpoint();
  snapshot.checkpoint.session_tick = 1234;
  snapshot.checkpoint.begun = true;
  snapshot.written_s = 1;  // by a machine whose clock is wrong by decades
  m.rig.table->give_up("exam");
  m.service_until_over();
  OwnedSession again = m.owned(500);
  again.snapshot = snapshot;
  ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
  EXPECT_EQ(m.only().epoch(), 500U);
  ASSERT_NE(m.only().snapshot(), nullptr);
  const auto tick = m.checkpoint().session_tick;  // of the newest of those that it has published by now
  EXPECT_GE(tick, 1234U);
  EXPECT_LT(tick, 1234U + 60'000U);
  m.rig.table->service(io::monotonic_now() + 599s);
  EXPECT_FALSE(m.only().end) << "participants have the whole time to come back";
  m.rig.table->service(io::monotonic_now() + 601s);
  EXPECT_EQ(m.only().end, EndReason::kStartTimeout);
  m.service_until_over();

  // A snapshot of another scene is not used, and the epoch is the revision nevertheless.
  snapshot.checkpoint.scene = {};
  again = m.owned(600);
  again.snapshot = snapshot;
  ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
  EXPECT_EQ(m.only().snapshot(), nullptr);
  EXPECT_EQ(m.only().epoch(), 600U);
}

/// A move, an upgrade or a restart must not end what was prepared for later: its tickets and its code are in use.
TEST(OwnedSessions, WaitForTheirFirstParticipantForAsLongAsBeforeTheMove) {
  for (const bool begun : {false, true}) {
    Member m;
    m.rig.start();
    SessionOptions options = lesson("exam");
    for (SeatSpec& seat : options.scene.seats) seat.required = seat.required && !begun;
    const auto shared = std::make_shared<const SessionOptions>(std::move(options));
    OwnedSession owned = m.owned(10);
    owned.options = shared;
    ASSERT_EQ(m.rig.table->open_owned(std::move(owned)), "");
    SessionSnapshot snapshot = m.kept.last;
    snapshot.checkpoint = m.checkpoint();
    snapshot.checkpoint.begun = begun;            // true: in a scene without required seats
    snapshot.checkpoint.seats[0].taken = !begun;  // a participant who has waited
    snapshot.checkpoint.seats[0].resume = {std::byte{1}};
    m.rig.table->give_up("exam");
    m.service_until_over();
    OwnedSession again = m.owned(500);
    again.options = shared;
    again.snapshot = snapshot;
    ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
    ASSERT_NE(m.only().snapshot(), nullptr);
    m.rig.table->service(io::monotonic_now() + 24h);
    EXPECT_FALSE(m.only().end) << begun;
  }
}

/// Its own clock has written the time of a snapshot; another machine's clock may be wrong.
TEST(OwnedSessions, SayTheAgeOfTheirSnapshotWhereItIsKnown) {
  for (const auto& [age_s, said] : {std::pair{std::int64_t{22}, "from its checkpoint, 22 s old: at"},
                                    std::pair{std::int64_t{-60}, "from its checkpoint: at"},
                                    std::pair{std::int64_t{400} * 86'400, "from its checkpoint: at"}}) {
    Member m(true);
    m.rig.start();
    ASSERT_EQ(m.rig.table->open_owned(m.owned(10)), "");
    SessionSnapshot snapshot = m.kept.last;
    snapshot.checkpoint = m.checkpoint();
    m.rig.table->give_up("exam");
    m.service_until_over();
    snapshot.written_s = auth::wall_seconds() - age_s;
    OwnedSession again = m.owned(500);
    again.snapshot = snapshot;
    testing::internal::CaptureStdout();
    ASSERT_EQ(m.rig.table->open_owned(std::move(again)), "");
    const std::string text = testing::internal::GetCapturedStdout();
    const bool exact = text.find(said) != std::string::npos;
    // The second may change in between.
    EXPECT_TRUE(exact || (age_s == 22 && text.find("checkpoint, 23 s old: at") != std::string::npos)) << text;
  }
}

TEST(OwnedSessions, LetTheConsolesOfTheirFormerOwnerReturnHereAndAtTheNextOwner) {
  const auth::Id16 ticket{std::byte{5}};
  Member m;
  m.rig.start();
  OwnedSession owned = m.owned(10);
  owned.consoles = {ticket};
  ASSERT_EQ(m.rig.table->open_owned(std::move(owned)), "");
  EXPECT_EQ(m.kept.last.checkpoint.epoch, 10U) << "of the consoles that are published";
  EXPECT_EQ(m.kept.consoles["exam"], std::vector{ticket});
  bool returns = false, late = true, joined = true;
  m.rig.control->change([&](const SessionRegistry& registry, const auto& done) {
    const SessionEntry* const entry = registry.find(m.only().id());
    returns = entry->consoles.returns(ticket, io::monotonic_now());
    late = entry->consoles.returns(ticket, io::monotonic_now() + kResumeLife);
    joined = !entry->consoles.empty();
    done();
  });
  EXPECT_TRUE(returns);
  EXPECT_FALSE(late);
  EXPECT_FALSE(joined);
}

TEST(OwnedSessions, KeepTheirSnapshotWhenTheyAreGivenUp) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(3)), "");
  m.rig.table->give_up("another");
  EXPECT_FALSE(m.only().end);
  m.rig.table->give_up("exam");
  m.rig.table->give_up("exam");
  EXPECT_EQ(m.only().end, EndReason::kGivenUp);
  m.service_until_over();
  EXPECT_TRUE(m.rig.table->all().empty());
  EXPECT_EQ(m.overs, std::vector{true});
  EXPECT_TRUE(m.kept.removed.empty());
  EXPECT_EQ(m.rig.table->exit_code(), 0);
}

TEST(OwnedSessions, AreNotHandedOverOnceTheyEnd) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(3)), "");
  EXPECT_FALSE(m.rig.table->hand_over("another", "MOVES"));
  m.rig.table->service(io::monotonic_now());
  m.only().end = EndReason::kTimeLimit;  // its clients are being closed
  EXPECT_FALSE(m.rig.table->hand_over("exam", "MOVES"));
  EXPECT_EQ(m.only().end, EndReason::kTimeLimit);
  m.only().end.reset();
  EXPECT_TRUE(m.rig.table->hand_over("exam", "MOVES"));
  EXPECT_EQ(m.only().end, EndReason::kGivenUp);
}

TEST(OwnedSessions, AreNotHandedOverOnceTheirSceneIsOver) {
  Member m;
  m.rig.start();
  SessionOptions options = lesson("exam");
  options.scene.duration = 0.2;
  for (SeatSpec& seat : options.scene.seats) seat.required = false;
  OwnedSession owned = m.owned(3);
  owned.options = std::make_shared<const SessionOptions>(std::move(options));
  ASSERT_EQ(m.rig.table->open_owned(std::move(owned)), "");
  for (int i = 0; i < 3000 && !m.only().live_session().ends(); ++i) poll(nullptr, 0, 10);
  ASSERT_FALSE(m.only().end);
  EXPECT_FALSE(m.rig.table->hand_over("exam", "MOVES"));
  m.service_until_over();
  EXPECT_EQ(m.overs, std::vector{false});
}

/// Otherwise the operator would believe the lesson closed that goes on at the next server.
TEST(OwnedSessions, RefuseTheOrderToEndThemWhileTheyMove) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(3)), "");
  const auth::Id16 id = m.only().id();
  ASSERT_TRUE(m.rig.table->hand_over("exam", "MOVES"));
  const rpc::Body reply = m.rig.order(rpc::EndSession{.session_id = id});
  const auto* const refused = std::get_if<rpc::ErrorReply>(&reply);
  ASSERT_NE(refused, nullptr);
  EXPECT_EQ(*refused, (rpc::ErrorReply{rpc::ErrorCode::kNotNow,
                                       "session exam is leaving this server and goes on at another one of the service; "
                                       "join it there and end it again",
                                       2}));
}

TEST(OwnedSessions, TakeTheirSnapshotAlongWhenTheyEnd) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(3)), "");
  const rpc::Body reply = m.rig.order(rpc::EndSession{.session_id = m.only().id()});
  EXPECT_TRUE(std::holds_alternative<rpc::Ok>(reply));
  EXPECT_EQ(m.overs, std::vector{false});
  EXPECT_EQ(m.kept.removed, Names{"exam"});
}

TEST(OwnedSessions, AreGivenUpByADrain) {
  Member m;
  m.rig.start();
  ASSERT_EQ(m.rig.table->open_owned(m.owned(3)), "");
  m.rig.table->drain();
  EXPECT_EQ(m.only().end, EndReason::kGivenUp);
  EXPECT_NE(m.rig.table->open_owned(m.owned(4)).find("draining"), std::string::npos);
  m.service_until_over();
  EXPECT_EQ(m.overs, std::vector{true});
  EXPECT_TRUE(m.kept.removed.empty());
}

/// The tick itself reads the clock: nothing else runs here.
TEST(OwnedSessions, HoldFromTheTimeThatWasSet) {
  Member m;
  m.rig.start();
  const auto limit = std::make_shared<ActLimit>();
  OwnedSession owned = m.owned(3);
  owned.act_limit = limit;
  ASSERT_EQ(m.rig.table->open_owned(std::move(owned)), "");
  LiveSession& live = m.only().live_session();
  const auto acts = [&](bool wanted) {
    for (int i = 0; i < 1000 && live.status().may_act != wanted; ++i) poll(nullptr, 0, 10);
    return live.status().may_act;
  };
  EXPECT_FALSE(acts(false)) << "a limit that was never set is over";
  limit->set(io::boottime_now() + 1h);
  EXPECT_TRUE(acts(true));
  limit->set(io::boottime_now() + 50ms);
  EXPECT_FALSE(acts(false));
  limit->set(io::boottime_now() + 1h);
  EXPECT_TRUE(acts(true));
  m.rig.table->give_up("exam");
  EXPECT_FALSE(acts(false)) << "another server may own it";
}

}  // namespace
}  // namespace tandem::server
