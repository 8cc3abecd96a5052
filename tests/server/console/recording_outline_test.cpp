// Outline of a recording: gaps, marks, and curves with a bounded number of points.
#include "server/console/recording_outline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>
#include <numeric>

#include "server/console/recording_json.h"
#include "tests/support/recorded_bytes.h"

namespace tandem::console {
namespace {

using nlohmann::json;

/// A lesson without rows: two masters, one tool.
Lesson head() {
  Lesson lesson;
  lesson.scene = server::test::scene_named("contact");
  lesson.seats.resize(lesson.scene.seats.size());
  lesson.tools.resize(lesson.scene.tools.size());
  return lesson;
}

/// A lesson with these ticks, in which the first hand feels 3 N and 4 N, and the tool is at x = tick mm.
Lesson rows(const std::vector<std::uint32_t>& ticks) {
  Lesson lesson = head();
  lesson.tick = ticks;
  for (LessonSeat& seat : lesson.seats) {
    seat.f.assign(ticks.size(), {3, 4, 0});
    seat.gate.assign(ticks.size(), static_cast<std::uint8_t>(wire::GateState::kActive));
    seat.sample_tick = ticks;
  }
  for (LessonTool& tool : lesson.tools) {
    tool.f_env.assign(ticks.size(), {0, 0, 2});
    tool.alpha.assign(ticks.size(), {0.25, 0.75});
    for (const std::uint32_t tick : ticks) tool.x.push_back({1e-3 * tick, 0, 0});
  }
  return lesson;
}

TEST(RecordingOutlines, StateEveryMissingTick) {
  RecordingOutline outline(head());
  EXPECT_TRUE(outline.empty());
  EXPECT_TRUE(outline.add(rows({10, 11, 15})));
  EXPECT_TRUE(outline.add(rows({16, 20})));
  outline.finish(true);
  EXPECT_EQ(outline.gaps(), (std::vector<RecordingGap>{{12, 15}, {17, 20}}));
  EXPECT_EQ(outline.missing_ticks(), 6u);
  EXPECT_EQ(outline.rows(), 5u);
  EXPECT_EQ(outline.first(), 10u);
  EXPECT_EQ(outline.last(), 20u);
}

TEST(RecordingOutlines, LeaveOutRowsThatGoBack) {
  RecordingOutline outline(head());
  EXPECT_TRUE(outline.add(rows({10, 11})));
  EXPECT_FALSE(outline.add(rows({11, 5, 12})));
  EXPECT_EQ(outline.rows(), 3u);
  EXPECT_EQ(outline.last(), 12u);
}

TEST(RecordingOutlines, KeepTheLongestGapsInOrder) {
  RecordingOutline outline(head());
  std::vector<std::uint32_t> ticks{0};
  for (std::uint32_t i = 0; i < 5000; ++i) ticks.push_back(ticks.back() + (i % 5 == 0 ? 10 : 2));
  EXPECT_TRUE(outline.add(rows(ticks)));
  outline.finish(true);
  EXPECT_EQ(outline.gap_count(), 5000u);
  EXPECT_EQ(outline.missing_ticks(), 1000u * 9 + 4000u);
  ASSERT_EQ(outline.gaps().size(), RecordingOutline::kGapsMax);
  EXPECT_TRUE(std::ranges::is_sorted(outline.gaps(), {}, &RecordingGap::from));
  EXPECT_TRUE(std::ranges::all_of(outline.gaps(), [](const RecordingGap& gap) { return gap.ticks() == 9; }));
}

TEST(RecordingOutlines, BoundMarksAndEvents) {
  RecordingOutline outline(head());
  Lesson part = rows({0});
  part.marks.assign(3000, {1, "eva", "x"});
  EXPECT_TRUE(outline.add(part));
  outline.finish(true);
  EXPECT_EQ(outline.marks().size(), RecordingOutline::kNotesMax);
  EXPECT_EQ(outline.notes_left_out(), 1000u);
}

TEST(RecordingCurves, HaveTheLargestForceOfEachTenthOfASecond) {
  RecordingOutline outline(head());
  Lesson part = rows({0, 1, 99, 100, 101});
  part.seats[0].f[2] = {30, 40, 0};
  part.seats[0].f[1] = {std::nan(""), 0, 0};
  EXPECT_TRUE(outline.add(part));
  const RecordingCurves& curves = outline.curves();
  ASSERT_EQ(curves.size(), 2u);
  EXPECT_EQ(curves.step_ticks(), 100u);
  EXPECT_FLOAT_EQ(curves.seat_force(0, 0), 50);
  EXPECT_FLOAT_EQ(curves.seat_force(1, 0), 5);
  EXPECT_FLOAT_EQ(curves.tool_force(0, 0), 2);
  EXPECT_FLOAT_EQ(curves.tool_x(1, 0, 0), 0.1f);
  EXPECT_FLOAT_EQ(curves.alpha(1, 0, 1), 0.75f);
}

TEST(RecordingCurves, HaveNoPointInAGap) {
  RecordingOutline outline(head());
  EXPECT_TRUE(outline.add(rows({0, 350, 400})));
  const RecordingCurves& curves = outline.curves();
  ASSERT_EQ(curves.size(), 5u);
  EXPECT_TRUE(std::isnan(curves.tool_x(1, 0, 0)));
  EXPECT_TRUE(std::isnan(curves.seat_force(2, 0)));
  EXPECT_TRUE(std::isnan(curves.tool_x(3, 0, 0))) << "row 350 is in the middle of its step: its time is another one";
  EXPECT_FLOAT_EQ(curves.seat_force(3, 0), 5);
  EXPECT_FLOAT_EQ(curves.tool_x(4, 0, 0), 0.4f);
}

TEST(RecordingCurves, HaveNoValueWhereASeatIsFree) {
  std::vector<std::uint32_t> ticks(2000);
  std::iota(ticks.begin(), ticks.end(), 0u);
  Lesson part = rows(ticks);
  part.seats[0].gate.assign(ticks.size(), 0);
  part.seats[0].sample_tick.assign(ticks.size(), 0);
  for (std::uint32_t& sample : part.seats[1].sample_tick) sample = std::min(sample, 900u);  // left then
  RecordingOutline outline(head());
  EXPECT_TRUE(outline.add(part));
  EXPECT_EQ(outline.seats_without_samples(), LessonSeatSet{0b01}) << "seat 0 only";
  EXPECT_EQ(outline.lesson_bytes(), 2000u * 410 * 2) << "seat 1 and the tool";
  const RecordingCurves& curves = outline.curves();
  ASSERT_EQ(curves.size(), 20u);
  for (std::size_t p = 0; p < curves.size(); ++p) {
    EXPECT_TRUE(std::isnan(curves.seat_force(p, 0))) << p;
    EXPECT_TRUE(std::isnan(curves.alpha(p, 0, 0))) << p;
    EXPECT_EQ(std::isnan(curves.seat_force(p, 1)), p > 11) << p << ": the last sample is old from tick 1151 on";
    EXPECT_EQ(std::isnan(curves.alpha(p, 0, 1)), p > 11) << p;
    EXPECT_FLOAT_EQ(curves.tool_force(p, 0), 2) << p;
  }
}

TEST(RecordingCurves, EndWithTheLastWholeStep) {
  std::vector<std::uint32_t> ticks;
  for (std::uint32_t tick = 0; tick <= 200; ++tick) ticks.push_back(tick);
  const auto points = [&ticks](std::size_t kept) {
    Lesson part = rows({ticks.begin(), ticks.begin() + static_cast<std::ptrdiff_t>(kept)});
    part.tools[0].alpha.back() = {};  // the tick with which a session ends
    RecordingOutline outline(head());
    EXPECT_TRUE(outline.add(part));
    outline.finish(true);
    EXPECT_FLOAT_EQ(outline.curves().alpha(outline.curves().size() - 1, 0, 1), kept == 1 ? 0.0f : 0.75f) << kept;
    return outline.curves().size();
  };
  EXPECT_EQ(points(201), 2u) << "one tick of the third step gives no point";
  EXPECT_EQ(points(109), 1u);
  EXPECT_EQ(points(110), 2u) << "a tenth of the step gives one";
  EXPECT_EQ(points(1), 1u) << "the only point stays";
}

TEST(RecordingCurves, DoubleTheirStepInsteadOfGrowing) {
  RecordingOutline outline(head());
  std::vector<std::uint32_t> ticks;
  for (std::uint32_t i = 0; i < 20'000; ++i) ticks.push_back(100 * i);  // 2000 s
  EXPECT_TRUE(outline.add(rows(ticks)));
  const RecordingCurves& curves = outline.curves();
  EXPECT_EQ(curves.step_ticks(), 400u);
  EXPECT_EQ(curves.size(), 5000u);
  for (std::size_t p = 0; p < curves.size(); ++p)
    ASSERT_FLOAT_EQ(curves.tool_x(p, 0, 0), 0.4f * static_cast<float>(p)) << p;
  EXPECT_TRUE(outline.add(rows({4'000'000'000u})));
  EXPECT_LE(outline.curves().size(), RecordingCurves::kPointsMax) << "a tick of a damaged file";
}

TEST(RecordingJson, HasNoNumberForWhatIsNotKnown) {
  Lesson start = head();
  start.session = "lab \xff";
  start.seats[0].person = "ina";
  RecordingOutline outline(start);
  Lesson part = rows({0, 350});
  part.events = {{350, 0, "stop", "trainer", "stop \x01 of trainer"},
                 {350, 0, "authority", "", "timeline tick 350"},
                 {350, 0, "pause", "", "console tick 350", "ola"}};
  part.marks = {{0.2, "eva", "now"}};
  EXPECT_TRUE(outline.add(part));
  outline.finish(false);
  const json message = json::parse(outline_json(outline, rpc::Id{std::byte{0xab}}, {"a.mcap", 3, "part 2 is missing"}));
  EXPECT_EQ(message["file"], "a.mcap");
  EXPECT_EQ(message["files"], 3);
  EXPECT_EQ(message["parts_problem"], "part 2 is missing");
  EXPECT_EQ(message["id"], "ab" + std::string(30, '0'));
  EXPECT_EQ(message["scene"]["type"], "scene");
  EXPECT_EQ(message["scene"]["session"], message["id"]);
  EXPECT_EQ(message["to_s"], 0.351);
  EXPECT_EQ(message["gaps"], json({{0.001, 0.35}}));
  EXPECT_EQ(message["complete"], false);
  EXPECT_TRUE(message["start_s"].is_null());
  EXPECT_EQ(message["events"][0]["t"], 0.35);
  EXPECT_EQ(message["events"][0]["seat"], "trainer");
  EXPECT_EQ(message["events"][0]["person"], "ina");
  EXPECT_EQ(message["events"][1]["seat"], "") << "no seat gave this event";
  EXPECT_EQ(message["events"][1]["person"], "");
  EXPECT_EQ(message["events"][2]["person"], "ola") << "the order of a console";
  EXPECT_EQ(message["marks"][0]["person"], "eva");
  const json& curve = message["curves"]["seats"][0]["force"];
  EXPECT_EQ(curve[0], 5);
  EXPECT_TRUE(curve[1].is_null());
}

TEST(RecordingJson, ListsDamagedFilesWithTheirProblemOnly) {
  RecordingList list;
  list.recordings = {{.id = "1", .file = "a.mcap", .problem = "is cut \xff"},
                     {.id = "2", .file = "b.mcap", .files = 2, .parts_problem = "part 1 is missing"}};
  list.recordings[1].persons = {"Ada"};
  const json message = json::parse(list_json(list));
  EXPECT_TRUE(message["recordings"][0]["problem"].is_string());
  EXPECT_FALSE(message["recordings"][0].contains("session"));
  EXPECT_TRUE(message["recordings"][1]["problem"].is_null());
  EXPECT_TRUE(message["recordings"][0]["parts_problem"].is_null());
  EXPECT_EQ(message["recordings"][1]["files"], 2);
  EXPECT_EQ(message["recordings"][1]["parts_problem"], "part 1 is missing");
  EXPECT_TRUE(message["recordings"][1]["start_s"].is_null()) << "not known";
}

}  // namespace
}  // namespace tandem::console
