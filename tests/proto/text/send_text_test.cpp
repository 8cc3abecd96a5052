// The message send of a scene: accepted values, refusals with their words, and its way to a client.
#include <array>
#include <limits>

#include "proto/text/seat_setup.h"
#include "tests/proto/text/bad_scene.h"

namespace tandem {
namespace {

using namespace bad_scene;

/// The good scene with `keys` in line 3.
std::string scene_with(const std::string& keys) { return with("device_coupling", keys + " device_coupling"); }

TEST(SceneSend, IsOffByDefaultAndThenNotListed) {
  const auto scene = parse_scene(good(), "s");
  ASSERT_TRUE(scene);
  EXPECT_FALSE(scene->send.is_on());
  EXPECT_EQ(effective_scene_text(*scene).find("send"), std::string::npos);
  EXPECT_FALSE(seat_setup(*scene, 0).send.is_on());
}

TEST(SceneSend, ReadsEveryKeyAndListsIt) {
  const auto scene = parse_scene(scene_with("send { rate_hz: 500 heartbeat_ms: 10 prediction_order: 0 dead_band { "
                                            "weber: 0.2 velocity_floor_m_s: 0.05 force_floor_n: 0.3 } }"),
                                 "s");
  ASSERT_TRUE(scene) << to_text(scene.error());
  EXPECT_EQ(scene->send.rate, 500);
  EXPECT_EQ(scene->send.heartbeat, 0.01);
  EXPECT_EQ(scene->send.prediction_order, 0u);
  ASSERT_TRUE(scene->send.dead_band);
  EXPECT_EQ(scene->send.dead_band->weber, 0.2);
  EXPECT_EQ(scene->send.dead_band->velocity_floor, 0.05);
  EXPECT_EQ(scene->send.dead_band->force_floor, 0.3);
  for (const char* key : {"send.rate_hz", "send.heartbeat_ms", "send.dead_band.weber"})
    EXPECT_NE(effective_scene_text(*scene).find(key), std::string::npos) << key;
}

TEST(SceneSend, NamesValuesOutOfRange) {
  expect_one(scene_with("send { dead_band { weber: @0 } }"), "send.dead_band.weber", "0.5");
  expect_one(scene_with("send { dead_band { weber: @0.6 } }"), "send.dead_band.weber", "0.5");
  expect_one(scene_with("send { dead_band { weber: @nan } }"), "send.dead_band.weber", "finite");
  expect_one(scene_with("send { dead_band { velocity_floor_m_s: @-1 } }"), "send.dead_band.velocity_floor_m_s", "0");
  expect_one(scene_with("send { dead_band { force_floor_n: @11 } }"), "send.dead_band.force_floor_n", "10");
  expect_one(scene_with("send { dead_band { } prediction_order: @2 }"), "send.prediction_order", "1");
  expect_one(scene_with("send { dead_band { } heartbeat_ms: @0 }"), "send.heartbeat_ms", "100");
}

TEST(SceneSend, RefusesAHeartbeatNearTheToleratedSilence) {
  EXPECT_EQ(to_text(errors_of(scene_with("send { dead_band { } heartbeat_ms: 16.6 }"))), "");
  expect_one(scene_with("send { dead_band { } heartbeat_ms: @17 }"), "send.heartbeat_ms", "at most 16.6666 ms");
  expect_one(scene_with("send { dead_band { } heartbeat_ms: @0.5 }"), "send.heartbeat_ms", "1 ms");
  // SET_POSITION: a sixth of 20 ms, and of 60 ms.
  expect_one(scene_with("channel { law: SET_POSITION } send { dead_band { } heartbeat_ms: @4 }"), "send.heartbeat_ms",
             "at most 3.3333 ms");
  EXPECT_EQ(to_text(errors_of(scene_with("channel { law: SET_POSITION } gate { silence_limit_ms: 60 } send { dead_band "
                                         "{ } heartbeat_ms: 10 }"))),
            "");
}

TEST(SceneSend, RefusesARateAboveTheTickOrBelowTheHeartbeat) {
  EXPECT_EQ(to_text(errors_of(scene_with("send { rate_hz: 62.5 }"))), "") << "every 16th of 1000 ticks";
  expect_one(scene_with("send { rate_hz: @62 }"), "send.rate_hz", "at least 62.5 Hz");
  EXPECT_NE(
      to_text(errors_of(scene_with("tick_hz: 100 send { rate_hz: 60 }"))).find("rate_hz = 60: must be at least 100 Hz"),
      std::string::npos);
  expect_one(scene_with("channel { law: SET_POSITION } send { rate_hz: @100 }"), "send.rate_hz",
             "at least 333.3334 Hz");
  EXPECT_EQ(to_text(errors_of(scene_with("channel { law: SET_POSITION } send { rate_hz: 333.3334 }"))), "");
  EXPECT_NE(to_text(errors_of(scene_with("send { rate_hz: 50 }"))).find("must be in [60, 10000] Hz"),
            std::string::npos);
  expect_one(scene_with("tick_hz: 2000 send { rate_hz: @3000 }"), "send.rate_hz", "2000");
}

TEST(SceneSend, RefusesLawsThatActOnEachDatagram) {
  for (const char* law : {"TDPA", "WAVE", "PD", "RAW"})
    expect_one(scene_with("channel { law: " + std::string(law) + " } @send { dead_band { } }"), "send", "SET_POSITION");
  for (const char* mfs : {"SEED", "SEED_SIGNED"})
    expect_one(scene_with("channel { law: SET_POSITION mfs: " + std::string(mfs) + " } @send { rate_hz: 500 }"), "send",
               "OPEN or TANK");
  expect_one(scene_with("port: JOINT channel { law: SET_POSITION } @send { rate_hz: 500 }"), "send", "port: TIP");
  auto scene = parse_scene(scene_with("send { dead_band { } }"), "s");
  ASSERT_TRUE(scene);
  EXPECT_FALSE(law_problem(*scene));
  choose_law(*scene, LawKind::kWave);
  ASSERT_TRUE(law_problem(*scene)) << "--channel meets the same rule";
  EXPECT_EQ(law_problem(*scene)->key, "send");
}

TEST(SceneSend, RefusesABlockThatChangesNothing) {
  expect_one(scene_with("@send { heartbeat_ms: 10 }"), "send", "rate_hz or dead_band");
  expect_one(scene_with("@send { prediction_order: 0 }"), "send", "rate_hz or dead_band");
}

TEST(SceneSend, ReachesMastersWithItsHeartbeatAndNoSlaveSeat) {
  const std::string text =
      "version: 1 send { dead_band { weber: 0.05 } prediction_order: 0 } "
      "seat { name: \"a\" kind: MASTER role: TRAINEE } seat { name: \"s\" kind: SLAVE tool: \"t\" } "
      "tool { name: \"t\" } authority { tool: \"t\" seat: \"a\" alpha: 1 }";
  const auto scene = parse_scene(text, "s");
  ASSERT_TRUE(scene) << to_text(scene.error());
  std::array<char, wire::kSetupMax> bytes{};
  const SeatSetup master = seat_setup(*scene, 0);
  const auto read = decode_seat_setup(std::span{bytes}.first(encode_seat_setup(master, bytes)));
  ASSERT_TRUE(read) << to_text(read.error());
  ASSERT_TRUE(read->send.dead_band);
  EXPECT_EQ(read->send.dead_band->weber, 0.05);
  EXPECT_EQ(read->send.prediction_order, 0u);
  EXPECT_NEAR(read->send.heartbeat, 0.1 / 6, 1e-12);
  EXPECT_FALSE(seat_setup(*scene, 1).send.is_on());
}

TEST(SceneSend, IsCheckedInASetupFromTheNetwork) {
  const auto scene = parse_scene(scene_with("send { dead_band { } }"), "s");
  ASSERT_TRUE(scene);
  std::array<char, wire::kSetupMax> bytes{};
  const auto refused = [&](SeatSetup setup) {
    const auto read = decode_seat_setup(std::span{bytes}.first(encode_seat_setup(setup, bytes)));
    return read ? std::string("accepted") : to_text(read.error());
  };
  SeatSetup setup = seat_setup(*scene, 0);
  EXPECT_EQ(refused(setup), "accepted");
  setup.send.heartbeat = 0.05;
  EXPECT_NE(refused(setup).find("send.heartbeat_ms"), std::string::npos);
  setup.send.heartbeat = 0;
  EXPECT_NE(refused(setup).find("send.heartbeat_ms"), std::string::npos) << "a client needs it";
  setup = seat_setup(*scene, 0);
  setup.send.dead_band->weber = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refused(setup).find("weber"), std::string::npos);
  setup = seat_setup(*scene, 0);
  setup.seat.kind = SeatKind::kSlave;
  EXPECT_NE(refused(setup).find("send: is given to a SLAVE seat"), std::string::npos) << refused(setup);
}

}  // namespace
}  // namespace tandem
