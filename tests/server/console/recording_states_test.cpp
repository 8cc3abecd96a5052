// States of a recording: 60 periods per second, and none where the recording has no row.
#include "server/console/recording_states.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "proto/recording/lesson_reader.h"
#include "tests/support/recorded_bytes.h"

namespace tandem::console {
namespace {

using nlohmann::json;

TEST(RecordingPeriods, CoverEveryTickOnce) {
  for (const double hz : {1.0, 59.0, 60.0, 100.0, 500.0, 1000.0, 2000.0}) {
    for (const std::uint32_t first : {0u, 7u, 123'456u}) {
      SCOPED_TRACE(hz);
      const std::uint32_t last = first + static_cast<std::uint32_t>(25 * hz);
      const RecordingPeriods periods(hz, first, last);
      EXPECT_EQ(periods.tick(0), first);
      const std::uint64_t count = std::uint64_t{periods.pieces()} * periods.per_piece();
      EXPECT_GT(periods.tick(count), last) << "the last tick is in the last piece";
      EXPECT_LE(periods.piece_tick(periods.pieces() - 1), last);
      for (std::uint64_t k = 0; k < count; ++k) ASSERT_GT(periods.tick(k + 1), periods.tick(k)) << "each has a tick";
    }
  }
}

TEST(RecordingPeriods, OfOneTickAreOne) {
  const RecordingPeriods periods(1000, 5, 5);
  EXPECT_EQ(periods.pieces(), 1u);
  EXPECT_EQ(periods.per_piece(), 600u);
  EXPECT_EQ(periods.tick(3), 55u) << "3/60 s";
}

struct Recorded {
  Lesson lesson;
  LivePicture base;
  RecordingPeriods periods;
};

Recorded recorded(double seconds, const std::function<bool(std::uint32_t)>& missing = {},
                  const std::function<void(server::TickRecord&)>& change = {}) {
  auto lesson = read_lesson(test::recorded_bytes("contact", seconds, missing, change));
  EXPECT_TRUE(lesson) << lesson.error();
  LivePicture base = recording_base(*lesson, rpc::Id{std::byte{1}});
  const RecordingPeriods periods(lesson->scene.tick_hz, lesson->tick.front(), lesson->tick.back());
  return {std::move(*lesson), std::move(base), periods};
}

TEST(RecordingStates, HaveTheValuesOfTheFirstTickOfEachPeriod) {
  const Recorded r = recorded(12);
  ASSERT_EQ(r.periods.pieces(), 2u);
  const json first = json::parse(piece_json(r.periods, 0, r.lesson, r.base));
  const json second = json::parse(piece_json(r.periods, 1, r.lesson, r.base));
  ASSERT_EQ(first["states"].size(), 600u);
  ASSERT_EQ(second["states"].size(), 120u);
  for (const json* piece : {&first, &second}) {
    for (const json& state : (*piece)["states"]) {
      const std::uint64_t tick = r.periods.tick(state["n"].get<std::uint64_t>() - 1);
      ASSERT_EQ(state["tick"], tick);
      const server::TickRecord record = server::test::record_at(r.lesson.scene, static_cast<std::uint32_t>(tick));
      ASSERT_NEAR(state["seats"][1]["x"][0].get<double>(), record.seats[1].x[0], 1e-8);
      ASSERT_NEAR(state["tools"][0]["x"][1].get<double>(), record.tools[0].x[1], 1e-12);
    }
  }
  const json& state = first["states"][60];
  EXPECT_EQ(state["type"], "state");
  EXPECT_EQ(state["t"], 1.0);
  EXPECT_EQ(state["phase"], "RUNNING");
  EXPECT_EQ(state["seats"][0]["gate"], "ON");
  EXPECT_EQ(state["seats"][0]["heard"], true);
  EXPECT_EQ(state["seats"][0]["person"], "Ada");
  EXPECT_EQ(state["tools"][0]["applied"], json({1.0, 0.0}));
  EXPECT_TRUE(state["age_ms"].is_null());
  EXPECT_TRUE(state["stop"].is_null());
}

TEST(RecordingStates, AreMissingWhereTheRecordingIs) {
  const Recorded r = recorded(2, [](std::uint32_t tick) { return tick >= 500 && tick < 750; });
  const json piece = json::parse(piece_json(r.periods, 0, r.lesson, r.base));
  ASSERT_EQ(piece["states"].size(), 120u - 15u) << "15 periods of 1/60 s in 250 ms";
  EXPECT_EQ(piece["states"][29]["n"], 30);
  EXPECT_EQ(piece["states"][30]["n"], 46);
  EXPECT_EQ(piece["states"][30]["tick"], 750);
}

/// Whether the state shows a seat as live states show a free one.
bool is_free(const json& seat) {
  return seat["taken"] == false && seat["heard"] == false && seat["engaged"] == false && seat["person"].is_null() &&
         seat["gate"].is_null() && seat["x"].is_null() && seat["f"].is_null() && seat["margin_j"].is_null();
}

TEST(RecordingStates, ShowASeatThatIsNeverTakenAsFree) {
  const Recorded r = recorded(1, {}, [](server::TickRecord& record) { record.seats[1] = {}; });
  const json piece = json::parse(piece_json(r.periods, 0, r.lesson, r.base));
  ASSERT_EQ(piece["states"].size(), 60u);
  for (const json& state : piece["states"]) {
    EXPECT_TRUE(is_free(state["seats"][1])) << state;
    EXPECT_EQ(state["seats"][0]["taken"], true) << state["tick"];
    EXPECT_EQ(state["seats"][0]["person"], "Ada");
  }
}

TEST(RecordingStates, ShowASeatWithoutNewSamplesForAQuarterOfASecondAsFree) {
  server::SeatRecord last;
  const Recorded r = recorded(12, {}, [&last](server::TickRecord& record) {
    if (record.tick == 500) last = record.seats[1];
    if (record.tick > 500 && record.tick < 11'000) record.seats[1] = last;  // engaged, and with the same force
  });
  std::vector<std::uint32_t> taken;
  for (const std::uint32_t k : {0u, 1u}) {
    const json piece = json::parse(piece_json(r.periods, k, r.lesson, r.base));
    for (const json& state : piece["states"])
      if (!is_free(state["seats"][1])) taken.push_back(state["tick"].get<std::uint32_t>());
  }
  ASSERT_EQ(taken.size(), 46u + 60u);
  EXPECT_EQ(taken[45], 750u) << "the last sample is 250 ms old";
  EXPECT_EQ(taken[46], 11'000u) << "samples come again";
}

TEST(RecordingStates, ShowASeatFreeAtTheBeginOfAPieceThatIsReadAlone) {
  Recorded r = recorded(1, {}, [](server::TickRecord& record) {
    record.tick += 5000;
    record.seats[0].sample_tick = record.tick;
    record.seats[1].sample_tick = 4000;
  });
  const json piece = json::parse(piece_json(r.periods, 0, r.lesson, r.base));
  EXPECT_TRUE(is_free(piece["states"][0]["seats"][1])) << "its sample was old in the first row";
  EXPECT_EQ(piece["states"][0]["seats"][0]["taken"], true);
}

TEST(RecordingStates, OfAPieceBehindTheRowsAreNone) {
  const Recorded r = recorded(1);
  EXPECT_EQ(piece_json(r.periods, 7, r.lesson, r.base), "{\"piece\":7,\"states\":[]}");
}

}  // namespace
}  // namespace tandem::console
