// Messages of the gateway as JSON: scene, state, hello. A value that is not known is null, never 0.
#include "server/console/state_json.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "server/console/live_json.h"

namespace tandem::console {
namespace {

using nlohmann::json;

constexpr rpc::Id kId{std::byte{0xab}};

/// Two masters and one tool with a wall.
LivePicture picture() {
  LivePicture out;
  out.number = 1;
  out.connected = true;
  out.status.session_id = kId;
  out.status.name = "contact";
  out.status.time_s = std::numeric_limits<double>::quiet_NaN();
  out.status.seats = {{"trainer", AccessRole::kInstructor, true, true, true},
                      {"trainee", AccessRole::kTrainee, false, false, true}};
  out.status.tools = {{"tool0", {std::numeric_limits<double>::infinity(), 0}}};
  out.status.held = "\xff broken";
  return out;
}

LivePicture live_picture() {
  LivePicture out = picture();
  SceneSpec scene;
  scene.tick_hz = 1000;
  scene.seats.resize(2);
  scene.seats[0].name = "trainer";
  scene.seats[0].role = Role::kInstructor;
  scene.seats[1].name = "trainee";
  scene.seats[1].required = false;
  ToolSpec tool;
  tool.name = "tool0";
  tool.m_s = 0.25;
  tool.environment.wall = WallSpec{.axis = 1, .at = 0.01, .k = 800};
  scene.tools = {tool};
  out.scene = std::make_shared<const SceneSpec>(scene);
  LiveValues live;
  live.telemetry.session_tick = 12345;
  live.telemetry.state = wire::SessionState::kRunning;
  live.telemetry.authority_version = 7;
  live.telemetry.seats[0] = {.taken = true,
                             .heard = true,
                             .engaged = true,
                             .gate = wire::GateState::kActive,
                             .x = {0.1, 0.2, 0.3},
                             .f = {1, 2, 3}};
  live.telemetry.tools[0] = {.touching = true, .x = {0.5, 0, 0}, .f = {-1, 0, 0}, .depth = 0.002};
  live.links[0] = {.rtt_p50_ms = 0.7,
                   .loss_up_percent = 1,
                   .gap_up_ms = 3,
                   .loss_down_percent = 2,
                   .gap_down_ms = 1,
                   .age_p99_ms = 4,
                   .margin_min_j = 0.05,
                   .gate_trips = 6,
                   .late_ticks = 8};
  live.authorities[0] = {.transfer_ticks = 37, .transfer_by = 1, .wanted = {0.25, 0.75}, .applied = {1, 0}};
  out.live = std::make_shared<const LiveValues>(live);
  return out;
}

json state_of(const LivePicture& from, const std::optional<rpc::StatusStop>& stop = {},
              std::optional<double> age_ms = {}) {
  return json::parse(
      state_json({.n = 4, .dropped = 2, .wall_us = 9, .age_ms = age_ms, .stop = &stop}, state_members(from)));
}

TEST(StateJson, HasTheValuesOfTheDatagram) {
  const json state = state_of(live_picture(), {}, 1.25);
  EXPECT_EQ(state["type"], "state");
  EXPECT_EQ(state["n"], 4);
  EXPECT_EQ(state["dropped"], 2);
  EXPECT_EQ(state["wall_us"], 9);
  EXPECT_EQ(state["age_ms"], 1.25);
  EXPECT_EQ(state["tick"], 12345);
  EXPECT_EQ(state["t"], 12.345);
  EXPECT_EQ(state["phase"], "RUNNING");
  EXPECT_EQ(state["version"], 7);
  ASSERT_EQ(state["seats"].size(), 2U);
  const json& seat = state["seats"][0];
  EXPECT_EQ(seat["gate"], "ON");
  EXPECT_EQ(seat["x"], json({0.1, 0.2, 0.3}));
  EXPECT_EQ(seat["f"], json({1, 2, 3}));
  EXPECT_EQ(seat["alpha"], json::array({1.0})) << "in force, per tool";
  EXPECT_EQ(seat["loss_percent"], 2) << "the worse direction";
  EXPECT_EQ(seat["gap_ms"], 3);
  EXPECT_EQ(seat["trips"], 6);
  EXPECT_EQ(seat["late"], 8);
  const json& tool = state["tools"][0];
  EXPECT_EQ(tool["wanted"], json({0.25, 0.75}));
  EXPECT_EQ(tool["applied"], json({1.0, 0.0}));
  EXPECT_EQ(tool["transfer"], json({{"by", "trainer"}, {"to", "trainee"}, {"alpha", 0.75}, {"ticks", 37}}));
  EXPECT_EQ(tool["depth_m"], 0.002);
}

TEST(StateJson, HasThePhaseOfASessionWithoutTheDirectoryFromItsStatus) {
  LivePicture held = live_picture();
  const auto live_of = [&](wire::SessionState state) {
    LiveValues live = *held.live;
    live.telemetry.state = state;
    held.live = std::make_shared<const LiveValues>(live);
    return state_of(held)["phase"];
  };
  EXPECT_EQ(live_of(wire::SessionState::kHeld), "RUNNING") << "braked: no seat with authority is engaged";
  held.status.phase = rpc::SessionPhase::kHeld;
  EXPECT_EQ(live_of(wire::SessionState::kHeld), "HELD");
  EXPECT_EQ(live_of(wire::SessionState::kWaiting), "HELD");
  EXPECT_EQ(live_of(wire::SessionState::kRunning), "RUNNING") << "the datagram is newer";
  EXPECT_EQ(live_of(wire::SessionState::kStopped), "STOPPED");
  LivePicture slow = picture();
  slow.status.phase = rpc::SessionPhase::kHeld;
  EXPECT_EQ(state_of(slow)["phase"], "HELD") << "without datagrams";
}

TEST(StateJson, NamesThePersonsOfTheTicketsAtTakenSeats) {
  LivePicture named = live_picture();
  named.status.seats[0].person = "ann";
  named.status.seats[1].person = "ted";  // the status is older than the datagram: the seat is free
  const json state = state_of(named);
  EXPECT_EQ(state["seats"][0]["person"], "ann");
  EXPECT_TRUE(state["seats"][1]["person"].is_null());
  LivePicture slow = picture();
  slow.status.seats[0].person = "ann";
  EXPECT_EQ(state_of(slow)["seats"][0]["person"], "ann");
  EXPECT_TRUE(state_of(slow)["seats"][1]["person"].is_null());
  rpc::StatusStop stop;
  stop.number = 1;
  stop.seat = "trainer";
  stop.ends = "x";
  EXPECT_TRUE(state_of(slow, stop)["stop"]["person"].is_null());
  stop.person = "ann";
  EXPECT_EQ(state_of(slow, stop)["stop"]["person"], "ann");
  EXPECT_EQ(state_of(slow, stop)["stop"]["by"], "trainer");
}

TEST(StateJson, HasTheVelocitiesOfTools) {
  LivePicture moving = live_picture();
  LiveValues live = *moving.live;
  live.velocities[0] = {0.1, -0.2, 0};
  moving.live = std::make_shared<const LiveValues>(live);
  EXPECT_EQ(state_of(moving)["tools"][0]["v"], json({0.1, -0.2, 0.0}));
}

TEST(StateJson, HasNullForUnknownValues) {
  const json state = state_of(live_picture());
  EXPECT_TRUE(state["age_ms"].is_null());
  EXPECT_TRUE(state["stop"].is_null());
  const json& free = state["seats"][1];
  EXPECT_EQ(free["taken"], false);
  for (const char* key :
       {"person", "gate", "x", "f", "rtt_ms", "loss_percent", "gap_ms", "age_ms", "margin_j", "trips", "late"})
    EXPECT_TRUE(free.at(key).is_null()) << key;
  EXPECT_TRUE(state["tools"][0]["v"].is_null());
  const json slow = state_of(picture());
  for (const char* key : {"tick", "t", "age_ms"}) EXPECT_TRUE(slow.at(key).is_null()) << key;
  EXPECT_TRUE(slow["tools"][0]["wanted"][0].is_null());
  EXPECT_TRUE(slow["tools"][0]["applied"].is_null());
  EXPECT_TRUE(slow["seats"][0]["rtt_ms"].is_null());
  EXPECT_NE(slow["held"].get<std::string>().find("broken"), std::string::npos) << "valid UTF-8";
}

// A datagram is authentic but its numbers are the client's: NaN and infinity anywhere give valid JSON with null.
TEST(StateJson, IsValidForAnyNumber) {
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity(),
                           -std::numeric_limits<double>::infinity()})
    for (std::size_t axis = 0; axis < 3; ++axis) {
      LivePicture from = live_picture();
      LiveValues live = *from.live;
      live.telemetry.seats[0].x[axis] = live.telemetry.seats[0].f[axis] = live.telemetry.tools[0].x[axis] = bad;
      live.authorities[0].wanted[0] = live.authorities[0].applied[1] = bad;
      live.links[0].rtt_p50_ms = live.links[0].gap_up_ms = bad;
      from.live = std::make_shared<const LiveValues>(live);
      const json state = state_of(from, {}, bad);
      EXPECT_TRUE(state["seats"][0]["x"].is_null());
      EXPECT_TRUE(state["tools"][0]["x"].is_null());
      EXPECT_TRUE(state["tools"][0]["wanted"][0].is_null());
      EXPECT_TRUE(state["seats"][0]["rtt_ms"].is_null());
      EXPECT_TRUE(state["age_ms"].is_null());
    }
}

TEST(StateJson, NamesTheReceiverOfATransferOnlyIfItIsOne) {
  LivePicture from = live_picture();
  LiveValues live = *from.live;
  live.authorities[0] = {.transfer_ticks = 1, .transfer_by = 31, .wanted = {0.5, 0.5}, .applied = {0, 0}};
  from.live = std::make_shared<const LiveValues>(live);
  const json transfer = state_of(from)["tools"][0]["transfer"];
  EXPECT_TRUE(transfer["to"].is_null()) << "both gain as much";
  EXPECT_EQ(transfer["by"], "a console");
  live.authorities[0].transfer_ticks = 0;
  from.live = std::make_shared<const LiveValues>(live);
  EXPECT_TRUE(state_of(from)["tools"][0]["transfer"].is_null());
}

TEST(StateJson, ShowsAStopUntilItHasEnded) {
  rpc::StatusStop stop;
  stop.number = 3;
  stop.seat = "trainer";
  stop.why = "a \"hand\"";
  stop.ends = "instructor";
  stop.yours = true;
  EXPECT_EQ(state_of(live_picture(), stop)["stop"], json({{"number", 3},
                                                          {"kind", "STOP"},
                                                          {"by", "trainer"},
                                                          {"person", nullptr},
                                                          {"why", "a \"hand\""},
                                                          {"yours", true}}));
  stop.ends.clear();
  EXPECT_TRUE(state_of(live_picture(), stop)["stop"].is_null());
}

TEST(SceneJson, HasSeatsToolsAndSurfaces) {
  const json scene = json::parse(scene_json(live_picture()));
  EXPECT_EQ(scene["session"], "ab000000000000000000000000000000");
  EXPECT_EQ(scene["tick_hz"], 1000);
  EXPECT_EQ(scene["law"], "REPLICA");
  EXPECT_TRUE(scene["duration_s"].is_null()) << "no scheduled end";
  LivePicture ends = live_picture();
  auto spec = *ends.scene;
  spec.duration = 20;
  ends.scene = std::make_shared<const SceneSpec>(spec);
  EXPECT_EQ(json::parse(scene_json(ends))["duration_s"], 20);
  EXPECT_EQ(scene["seats"][0]["role"], "INSTRUCTOR");
  EXPECT_EQ(scene["seats"][1]["required"], false);
  EXPECT_EQ(scene["tools"][0]["mass_kg"], 0.25);
  EXPECT_EQ(scene["tools"][0]["walls"][0]["at_m"], 0.01);
  EXPECT_EQ(scene["tools"][0]["walls"][0]["stiffness_n_m"], 800);
  EXPECT_EQ(scene["tools"][0]["tissues"], json::array());
  const json names = json::parse(scene_json(picture()));
  EXPECT_TRUE(names["tick_hz"].is_null());
  EXPECT_EQ(names["seats"][0]["name"], "trainer");
}

TEST(LiveJson, HelloHasTheRightsOfTheRole) {
  const rpc::ListedSession listed[] = {{kId, "contact", rpc::SessionPhase::kRunning, {}}};
  const json hello = json::parse(hello_json("ann", AccessRole::kEvaluator, "1", listed));
  EXPECT_EQ(hello["person"], "ann");
  EXPECT_EQ(hello["proved"], false);
  EXPECT_EQ(hello["scenes"], json::array());
  EXPECT_EQ(hello["scene_seats"], json::object());
  EXPECT_EQ(hello["scene_durations_s"], json::object());
  EXPECT_TRUE(hello["workstation"].is_null());
  const rpc::SceneList scenes{.scenes = {"contact", "lesson"},
                              .seats = {{0, "trainer", AccessRole::kInstructor}, {0, "trainee", AccessRole::kTrainee}},
                              .durations_s = {60, 0}};
  const json desk = json::parse(hello_json("ann", AccessRole::kOperator, "1", listed,
                                           {.proved = true, .scenes = &scenes, .workstation = "local"}));
  EXPECT_EQ(
      desk["scene_seats"],
      json({{"contact", {{{"name", "trainer"}, {"role", "INSTRUCTOR"}}, {{"name", "trainee"}, {"role", "TRAINEE"}}}}}));
  EXPECT_EQ(desk["scene_durations_s"], json({{"contact", 60}})) << "lesson has no scheduled end";
  EXPECT_EQ(desk["workstation"], "local");
  EXPECT_EQ(desk["proved"], true);
  EXPECT_EQ(desk["scenes"], json({"contact", "lesson"}));
  for (const AccessRole watcher : {AccessRole::kTrainee, AccessRole::kObserver, AccessRole::kRecorder})
    EXPECT_EQ(json::parse(hello_json("ann", watcher, "1", listed))["may"], json::array()) << to_text(watcher);
  for (const char* right : {"pause", "resume"})
    EXPECT_NE(std::ranges::find(hello["may"], right), hello["may"].end()) << right;
  for (const char* right : {"stop", "authority", "remove", "drain"})
    EXPECT_EQ(std::ranges::find(hello["may"], right), hello["may"].end()) << right;
  EXPECT_EQ(hello["role"], "EVALUATOR");
  EXPECT_EQ(hello["sessions"],
            json::array({{{"id", "ab000000000000000000000000000000"}, {"name", "contact"}, {"state", "RUNNING"}}}));
  EXPECT_TRUE(json::parse(reply_json({}, false, "x"))["id"].is_null());
}

TEST(LiveJson, TicketsNamePersonWorkstationRoleAndSeat) {
  const rpc::SessionCreated created{.session = {kId, "exam", rpc::SessionPhase::kWaiting, {}},
                                    .code = "",
                                    .tickets = {{"trainee", "desk-1", {std::byte{1}}, "ted", AccessRole::kTrainee},
                                                {"", "desk-2", {std::byte{2}}, "", AccessRole::kEvaluator}}};
  const json message = json::parse(tickets_json(created, "127.0.0.1:7000", {}));
  EXPECT_EQ(message["server"], "127.0.0.1:7000");
  const json& tickets = message["tickets"];
  EXPECT_EQ(tickets[0]["here"], false) << "no ticket of this gateway's workstation";
  ASSERT_EQ(tickets.size(), 2U);
  EXPECT_EQ(tickets[0]["person"], "ted");
  EXPECT_EQ(tickets[0]["workstation"], "desk-1");
  EXPECT_EQ(tickets[0]["role"], "TRAINEE");
  EXPECT_EQ(tickets[1]["person"], "desk-2") << "no name in the ticket: the workstation";
  EXPECT_EQ(tickets[1]["role"], "EVALUATOR");
  EXPECT_EQ(tickets[1]["seat"], "");
}

TEST(StateJson, ShowsTheRecordingOfTheSession) {
  LivePicture out = picture();
  const auto state_of = [](const LivePicture& p) {
    return nlohmann::json::parse("{" + state_members(p) + "}", nullptr, false);
  };
  EXPECT_TRUE(state_of(out)["recording"].is_null());
  EXPECT_EQ(state_of(out)["no_recording"], "");
  out.status.no_recording = "restart it with --record";
  EXPECT_EQ(state_of(out)["no_recording"], "restart it with --record");
  out.status.recording =
      rpc::StatusRecording{.by_server = true, .by_recorders = 1, .dropped = 4, .trouble = "\xff full"};
  const auto recording = state_of(out)["recording"];
  EXPECT_EQ(recording["by_server"], true);
  EXPECT_EQ(recording["by_recorders"], 1);
  EXPECT_EQ(recording["pseudonyms"], false);
  EXPECT_EQ(recording["dropped"], 4);
  EXPECT_NE(recording["trouble"].get<std::string>().find("full"), std::string::npos) << "valid UTF-8";
}

}  // namespace
}  // namespace tandem::console
