// Sessions that an operator creates and ends at run time, with their shards and a control server but without clients.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include "common/io/exit_code.h"
#include "proto/text/scenes_embedded.h"
#include "server/app/process/session_creation.h"
#include "tests/server/app/process/table_rig.h"

namespace tandem::server {
namespace {

using namespace test;
using Names = std::vector<std::string>;
using rpc::ErrorCode;

/// The error of a reply; kInternal without a text for any other reply.
rpc::ErrorReply error_of(const rpc::Body& reply) {
  const auto* const error = std::get_if<rpc::ErrorReply>(&reply);
  return error == nullptr ? rpc::ErrorReply{} : *error;
}
bool done(const rpc::Body& reply) { return std::holds_alternative<rpc::Ok>(reply); }

TEST(CreatedSessions, AreServedAndListed) {
  TableRig rig(options_with({lesson("first")}));
  rig.start();
  const rpc::Body reply = rig.order(rpc::CreateSession{.name = "exam", .scene = "free_motion"});
  const auto* const created = std::get_if<rpc::SessionCreated>(&reply);
  ASSERT_NE(created, nullptr) << error_of(reply).text;
  EXPECT_EQ(created->session.name, "exam");
  ASSERT_EQ(created->session.seats.size(), 2U);
  EXPECT_EQ(created->session.seats[1].name, "trainee");
  EXPECT_EQ(created->code, "") << "clients of this user need no code with ephemeral keys";
  EXPECT_EQ(rig.names(), (Names{"first", "exam"}));
  SessionInstance& session = *rig.table->all()[1];
  EXPECT_TRUE(session.created());
  EXPECT_EQ(session.live_session().slot(), 1U);
  rpc::SessionList list;
  rig.control->change([&](SessionRegistry& registry, const auto& ready) {
    list = registry.list();
    ready();
  });
  ASSERT_EQ(list.sessions.size(), 2U);
  EXPECT_EQ(list.sessions[1].id, created->session.id);
  EXPECT_NE(list.sessions[1].id, list.sessions[0].id);
}

TEST(SceneList, HasTheSeatsOfWholeScenesAsLongAsTheyFit) {
  const std::filesystem::path folder = std::filesystem::path(testing::TempDir()) / "scene-list";
  std::filesystem::create_directories(folder);
  const auto write = [&](const std::string& name, const std::string& text) {
    std::ofstream(folder / (name + ".textproto")) << text;
  };
  write("A-broken", "version: 1 seat {");
  const std::string_view eight = find_shipped_scene("eight_seats")->text;
  for (int i = 10; i < 80; ++i) write("B" + std::to_string(i), std::string(eight));
  const rpc::SceneList list = list_scenes(folder.string());
  ASSERT_EQ(list.scenes.front(), "A-broken");
  ASSERT_EQ(list.seats.size(), rpc::kSceneSeatsMax) << "64 scenes of eight seats";
  EXPECT_EQ(list.seats.front().scene, 1U) << "a file with mistakes has no seats";
  EXPECT_EQ(list.seats.front().role, AccessRole::kTrainee);
  EXPECT_EQ(list.seats.back().scene, 64U);
  EXPECT_EQ(list.scenes.size(), 71U + shipped_scenes().size());
  ASSERT_EQ(list.durations_s.size(), list.scenes.size());
  EXPECT_EQ(list.durations_s.front(), 0) << "a file with mistakes has no duration";
  const auto duration_of = [&](std::string_view name) {
    return list.durations_s[static_cast<std::size_t>(std::ranges::find(list.scenes, name) - list.scenes.begin())];
  };
  EXPECT_EQ(duration_of("contact"), 20) << "also beyond the seats that fit";
  EXPECT_EQ(duration_of("lesson"), 0) << "no scheduled end";
  std::filesystem::remove_all(folder);
}

TEST(CreatedSessions, AreRejectedWithWords) {
  ServerOptions options = options_with({lesson("first")});
  options.created_max = 1;
  TableRig rig(std::move(options));
  rig.start();
  const std::string slow =
      "version: 1 dof: 1 tick_hz: 500 device_coupling { k_c_n_m: 100 } gate { loop_age_max_ms: 2500 latch: false } "
      "seat { name: \"a\" kind: MASTER role: INSTRUCTOR device { model: LINEAR } hand { model: LEADER } } "
      "tool { name: \"t\" k_s_n_m: 100 slave { model: LINEAR } } authority { tool: \"t\" seat: \"a\" alpha: 1 }";
  const std::vector<std::tuple<rpc::CreateSession, ErrorCode, std::string>> rows{
      {{.name = "first", .scene = "lesson"}, ErrorCode::kNotAllowed, "a session first exists already"},
      {{.name = "exam", .scene = "lessn"}, ErrorCode::kBadFrame, "did you mean lesson?"},
      {{.name = "exam", .scene_text = "version: 1\nsaet {}\n"}, ErrorCode::kBadFrame, "exam.textproto:2:1"},
      {{.name = "exam", .scene_text = std::string(rpc::kSceneTextMax, '{')}, ErrorCode::kBadFrame, "exam.textproto"},
      {{.name = "exam", .scene_text = std::string("\0\x1b[2J\xff", 7)}, ErrorCode::kBadFrame, "exam.textproto"},
      {{.name = "abcdefghjk", .scene = "lesson"}, ErrorCode::kBadFrame, "form of a session code"},
      {{.name = "exam", .scene = "lesson", .holders = {{"absent", "desk"}}}, ErrorCode::kNoSeat, "seats: instructor"},
      {{.name = "exam", .scene_text = slow},
       ErrorCode::kNotAllowed,
       "tick_hz 500, and the threads of this server tick at 1000 Hz"}};
  for (const auto& [wanted, code, words] : rows) {
    const rpc::ErrorReply error = error_of(rig.order(wanted));
    EXPECT_EQ(error.code, code) << error.text;
    EXPECT_NE(error.text.find(words), std::string::npos) << error.text;
    EXPECT_LE(error.text.size(), rpc::kTextMax);
    EXPECT_EQ(error.text.find_first_of("\n\x1b"), std::string::npos) << "it is shown on terminals";
  }
  EXPECT_EQ(rig.names(), Names{"first"});
  rig.create("exam");
  const rpc::ErrorReply full = error_of(rig.order(rpc::CreateSession{.name = "more", .scene = "lesson"}));
  EXPECT_EQ(full.code, ErrorCode::kFull);
  EXPECT_NE(full.text.find("1 created sessions are open, and this server allows 1"), std::string::npos) << full.text;
}

TEST(CreatedSessions, ReportEveryMistakeThatFitsIntoAReply) {
  InputErrors errors(30, {"exam.textproto", 2, 1, "seat", "", "is unknown"});
  const std::string text = reply_text(errors);
  EXPECT_LE(text.size(), rpc::kTextMax);
  EXPECT_EQ(text.find("exam.textproto:2:1"), 0U) << text;
  EXPECT_NE(text.find("; and "), std::string::npos) << text;
  EXPECT_TRUE(text.ends_with(" more")) << text;
  EXPECT_LE(reply_text({{std::string(1000, 'x'), 0, 0, "", "", ""}}).size(), rpc::kTextMax);
  EXPECT_EQ(reply_text({}), "");
}

TEST(CreatedSessions, EndByAnOrderAndFreeTheirSlot) {
  TableRig rig(options_with({lesson("first")}));
  rig.start();
  const rpc::Id id = rig.create("exam");
  EXPECT_EQ(error_of(rig.order(rpc::EndSession{rpc::Id{}, ""})).code, ErrorCode::kNoSession);
  EXPECT_TRUE(done(rig.order(rpc::EndSession{id, "done"})));
  EXPECT_EQ(rig.names(), Names{"first"}) << "the reply follows when the session is over";
  EXPECT_EQ(error_of(rig.order(rpc::EndSession{id, ""})).code, ErrorCode::kNoSession);
  EXPECT_NE(rig.create("exam"), id);
  EXPECT_EQ(rig.table->all()[1]->live_session().slot(), 1U);
  EXPECT_EQ(rig.table->exit_code(), 0) << "created sessions do not count";
}

TEST(CreatedSessions, LeaveAConfiguredSessionToRestart) {
  SessionOptions restarts = lesson("first");
  restarts.restart = true;
  TableRig rig(options_with({restarts}));
  rig.start();
  const auth::Id16 id = rig.table->all()[0]->id();
  EXPECT_TRUE(done(rig.order(rpc::EndSession{id, ""})));
  EXPECT_EQ(rig.names(), Names{"first"});
  EXPECT_NE(rig.table->all()[0]->id(), id);
  EXPECT_EQ(error_of(rig.order(rpc::EndSession{id, ""})).code, ErrorCode::kNoSession);
}

TEST(CreatedSessions, EndWhenTheirTimeIsOver) {
  TableRig rig(options_with({lesson("first")}));
  rig.start();
  ASSERT_TRUE(std::holds_alternative<rpc::SessionCreated>(
      rig.order(rpc::CreateSession{.name = "exam", .scene = "lesson", .life_s = 60})));
  rig.table->service(io::monotonic_now() + 50s);
  EXPECT_FALSE(rig.table->all()[1]->end);
  rig.table->service(io::monotonic_now() + 61s);
  SessionInstance& session = *rig.table->all()[1];
  EXPECT_EQ(session.end, EndReason::kTimeLimit);
  rig.wait_until_over(session);
  rig.table->service(io::monotonic_now());
  EXPECT_EQ(rig.names(), Names{"first"});
}

TEST(CreatedSessions, EndWithADrain) {
  TableRig rig(options_with({lesson("first")}));
  rig.start();
  rig.create("exam");
  rig.table->drain();
  EXPECT_EQ(error_of(rig.order(rpc::CreateSession{.name = "late", .scene = "lesson"})).code, ErrorCode::kDraining);
  rig.shards.stop();
  rig.shards.join();
  rig.table->service(io::monotonic_now());
  EXPECT_TRUE(rig.table->all().empty());
  EXPECT_EQ(rig.table->exit_code(), io::kExitDone);
}

}  // namespace
}  // namespace tandem::server
