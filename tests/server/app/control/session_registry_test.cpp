// The registry of sessions without clients: choice of a session, lists, removal, drain.
#include "server/app/control/session_registry.h"

#include <poll.h>

#include <optional>
#include <utility>

#include "common/auth/enrolment.h"
#include "common/io/clock.h"
#include "tests/server/app/control/joining.h"

namespace tandem::server {
namespace {

using namespace test;
using rpc::ErrorCode;

/// The session publishes its seats some ticks later only.
TEST(SessionEntry, IsInUseFromTheRequestForASeatOn) {
  Joining j;
  EXPECT_FALSE(j.lesson.in_use(io::monotonic_now()));
  const JoinRequest request = Joining::request("trainee", rpc::CodeCredential{kCode});
  std::optional<JoinReply> reply;
  j.joins.admit(request, [&](JoinReply decided) { reply = std::move(decided); });
  EXPECT_TRUE(j.lesson.in_use(io::monotonic_now()));
  j.serve();
  j.wait_until([&] { return reply.has_value(); });
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(*reply));
  const Time joined = io::monotonic_now();
  j.joins.on_joined(request, std::get<rpc::Welcome>(*reply), {});
  j.wait_until([&] { return !j.lesson.seats[1].joining(); });
  EXPECT_TRUE(j.lesson.in_use(joined));
  const auto published = [&] { return j.lesson.session().status().seats[1].taken; };
  for (int i = 0; i < 1000 && !published(); ++i) poll(nullptr, 0, 10);
  EXPECT_TRUE(j.lesson.in_use(joined + 1h));
}

TEST(SessionEntry, IsInUseWhileAConsoleIsJoined) {
  Joining j;
  const JoinReply reply = j.join([&] {
    JoinRequest request = Joining::request("");
    request.hello.credential = j.operators_ticket({std::byte{1}});
    return request;
  }());
  ASSERT_TRUE(std::holds_alternative<rpc::Welcome>(reply));
  EXPECT_TRUE(j.lesson.in_use(io::monotonic_now()));
}

TEST(SessionRegistry, ChoosesTheOnlySessionOrTheOneNamedByIdOrCode) {
  RegistryFixture f;
  EXPECT_EQ(error_of(f.registry.choose({})),
            (rpc::ErrorReply{ErrorCode::kNoSession, "no session is open on this server", 0}));
  SessionEntry* const lesson = &f.add("lesson", 1, "ABCDE12345");
  EXPECT_EQ(std::get<SessionEntry*>(f.registry.choose({})), lesson);
  SessionEntry* const exam = &f.add("exam", 2);
  EXPECT_EQ(error_of(f.registry.choose({})),
            (rpc::ErrorReply{ErrorCode::kNoSession,
                             "this server has several sessions: lesson, exam; choose one with --session", 0}));
  EXPECT_EQ(std::get<SessionEntry*>(f.registry.choose(id_of(2))), exam);
  EXPECT_EQ(std::get<SessionEntry*>(f.registry.choose(std::string("ABCDE12345"))), lesson);
  EXPECT_EQ(error_of(f.registry.choose(id_of(9))),
            (rpc::ErrorReply{ErrorCode::kNoSession, "this server has no such session; open: lesson, exam", 0}));
  EXPECT_EQ(error_of(f.registry.choose(std::string("ZZZZZ00000"))).code, ErrorCode::kCode);
  EXPECT_EQ(error_of(f.registry.choose(std::string())).code, ErrorCode::kCode) << "exam has no code";
}

TEST(SessionRegistry, ListsASeatAsTakenFromTheBeginOfAJoin) {
  RegistryFixture f;
  SessionEntry& lesson = f.add("lesson", 1, "ABCDE12345");
  lesson.seats[1].begin_join();
  const rpc::SessionList list = f.registry.list();
  ASSERT_EQ(list.sessions.size(), 1U);
  EXPECT_EQ(list.sessions[0], (rpc::ListedSession{id_of(1),
                                                  "lesson",
                                                  rpc::SessionPhase::kWaiting,
                                                  {{"trainer", AccessRole::kInstructor, false, true},
                                                   {"trainee", AccessRole::kTrainee, true, true}}}));
  const ServingSpec serving = f.registry.serving();
  ASSERT_EQ(serving.sessions.size(), 1U);
  EXPECT_EQ(
      serving.sessions[0],
      (OpenSession{id_of(1),
                   "ABCDE12345",
                   "lesson",
                   3,
                   {{"trainer", AccessRole::kInstructor, false, true}, {"trainee", AccessRole::kTrainee, false, true}},
                   "waiting"}))
      << "commands on this computer see clients only";
}

TEST(SessionRegistry, ListsManySessionsInPages) {
  RegistryFixture f;
  const unsigned sessions = 2 * rpc::kListedSessionsMax + 5;
  for (unsigned i = 0; i < sessions; ++i) f.add("s" + std::to_string(i), i);
  std::vector<std::string> names;
  rpc::SessionList page = f.registry.list();
  for (const rpc::ListedSession& s : page.sessions) names.push_back(s.name);
  EXPECT_EQ(names.size(), rpc::kListedSessionsMax);
  f.registry.entries().front().closing = true;  // earlier ones do not matter any more
  while (page.more) {
    page = f.registry.list(page.last);
    for (const rpc::ListedSession& s : page.sessions) names.push_back(s.name);
  }
  ASSERT_EQ(names.size(), sessions);
  for (unsigned i = 0; i < sessions; ++i) EXPECT_EQ(names[i], "s" + std::to_string(i));
}

TEST(SessionRegistry, NamesAFewOfManySessionsInARejection) {
  RegistryFixture f;
  for (unsigned i = 0; i < 60; ++i) f.add("session_of_a_long_name_number_" + std::to_string(i), i);
  const rpc::ErrorReply reply = error_of(f.registry.choose({}));
  EXPECT_EQ(reply.code, ErrorCode::kNoSession);
  EXPECT_LE(reply.text.size(), rpc::kTextMax) << "a longer text could not be sent";
  EXPECT_NE(reply.text.find("number_7 and 52 more; choose one with --session"), std::string::npos) << reply.text;
}

/// Fills the queue of the shard; `begun` requests of the session wait in it then.
void fill_queue(RegistryFixture& f, const SessionEntry& entry) {
  const auto full = std::make_shared<bool>(false);  // requests that wait are answered after this function
  for (int i = 0; !*full && i < 10000; ++i)
    f.registry.post(entry, {.what = ShardRequest::What::kQueryPeers,
                            .done = [full](ShardRequest& r) { *full = *full || r.result == JoinResult::kBusy; }});
  ASSERT_TRUE(*full);
}

TEST(SessionRegistry, EndsASessionAlthoughTheQueueOfItsShardIsFull) {
  RegistryFixture f;
  const SessionEntry& lesson = f.add("lesson", 1);
  fill_queue(f, lesson);
  f.registry.end(id_of(1));
  f.serve();
  f.wait_until([&] { return lesson.session().over(); });
}

TEST(SessionRegistry, AddsARunningSessionAlthoughTheQueueOfItsShardIsFull) {
  RegistryFixture f;
  const SessionEntry& lesson = f.add("lesson", 1);
  fill_queue(f, lesson);
  LiveSession session{f.scene, *make_local_slaves(f.scene, Time{}), 5, f.records()};
  std::optional<bool> served;
  f.registry.add_running({"exam", id_of(2), {}, 1, &session, &f.shard}, [&](bool accepted) { served = accepted; });
  EXPECT_FALSE(served) << "neither lost nor accepted yet";
  f.serve();
  f.wait_until([&] { return served.has_value(); });
  EXPECT_TRUE(*served);
  f.finish();
}

TEST(SessionRegistry, RemovesASessionAfterItsLastRequest) {
  RegistryFixture f;
  f.add("lesson", 1);
  f.registry.end(id_of(1));
  bool gone = false;
  f.registry.remove(id_of(1), [&] { gone = true; });
  EXPECT_FALSE(gone) << "its shard has not executed `end`";
  EXPECT_EQ(f.registry.find(id_of(1)), nullptr);
  EXPECT_TRUE(f.registry.list().sessions.empty());
  EXPECT_TRUE(f.registry.serving().sessions.empty());
  EXPECT_EQ(f.registry.entries().size(), 1U);
  f.serve();
  f.wait_until([&] { return gone; });
  EXPECT_TRUE(f.registry.entries().empty());
}

TEST(SessionRegistry, ReportsTheRemovalOfAnUnknownSessionAtOnce) {
  RegistryFixture f;
  f.add("lesson", 1);
  bool gone = false;
  f.registry.remove(id_of(2), [&] { gone = true; });
  EXPECT_TRUE(gone);
  EXPECT_EQ(f.registry.entries().size(), 1U);
}

TEST(SessionRegistry, AddsASessionToARunningShard) {
  RegistryFixture f;
  f.serve();
  TickQueue records{16};
  LiveSession session{f.scene, *make_local_slaves(f.scene, Time{}), 5, records};
  f.registry.add_running({"later", id_of(4), "", 1, &session, &f.shard});
  f.registry.end(id_of(4));  // the shard executes requests in order, so it serves the session by then
  f.wait_until([&] { return session.over(); });
  EXPECT_EQ(error_of(f.registry.choose(id_of(4))),
            (rpc::ErrorReply{ErrorCode::kSessionOver, "this session is over", 0}));
  EXPECT_EQ(error_of(f.registry.choose({})).code, ErrorCode::kNoSession);
}

TEST(SessionRegistry, ReportsTheProgressOfADrain) {
  RegistryFixture f;
  f.add("lesson", 1);
  f.add("exam", 2).closing = true;
  EXPECT_EQ(f.registry.drain_progress(), (rpc::StatusDrain{0, 1, 0}));
  f.registry.drain().schedule(io::monotonic_now() + 1h);
  EXPECT_LE(f.registry.drain_progress().left_s, 3600U);
  EXPECT_GE(f.registry.drain_progress().left_s, 3540U);
}

TEST(SessionRegistry, ShowsABrakedSessionAsRunningAndOneWithoutTheDirectoryAsHeld) {
  using State = wire::SessionState;
  using Phase = rpc::SessionPhase;
  const std::pair<State, Phase> phases[] = {{State::kWaiting, Phase::kWaiting},      {State::kRunning, Phase::kRunning},
                                            {State::kHeld, Phase::kRunning},         {State::kPaused, Phase::kPaused},
                                            {State::kStopped, Phase::kStopped},      {State::kEnding, Phase::kEnding},
                                            {State::kOverloaded, Phase::kOverloaded}};
  for (const auto& [state, phase] : phases) {
    EXPECT_EQ(phase_of(state, true), phase) << static_cast<int>(state);
    const bool held = phase == Phase::kWaiting || phase == Phase::kRunning;
    EXPECT_EQ(phase_of(state, false), held ? Phase::kHeld : phase) << static_cast<int>(state);
  }
}

TEST(SessionCodes, AreReadableInGroupsAndAsTyped) {
  EXPECT_EQ(code_text("ABCDE12345"), "ABCDE-12345");
  const std::string code = make_session_code();
  EXPECT_EQ(code.size(), rpc::kSessionCodeSize);
  EXPECT_EQ(auth::canonical_session_code(code_text(code)), code);
  EXPECT_NE(make_session_code(), code);
}

}  // namespace
}  // namespace tandem::server
