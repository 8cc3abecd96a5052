// A trace read back equals the records that it was written from, and every mistake is named.
#include "netsim/score/trace_lesson.h"

#include <gtest/gtest.h>

#include <cmath>

#include "netsim/score/lesson_scores.h"
#include "server/report/trace_csv.h"
#include "tests/support/simulation_run.h"

namespace tandem::netsim::score {
namespace {

struct Recorded {
  SceneSpec scene;
  std::string csv;
  std::vector<server::TickRecord> records;
};

Recorded recorded(const std::string& scene, double duration_s) {
  Recorded out;
  out.scene = test::shipped(scene);
  out.scene.duration = duration_s;
  const server::TraceCsv csv{out.scene};
  out.csv = csv.header();
  (void)test::run(out.scene, {}, 1, [&](Simulation& simulation) {
    const server::TickRecord& record = simulation.record();
    if (!record.running) return;
    csv.append(record, out.csv);
    out.records.push_back(record);
  });
  return out;
}

std::expected<Lesson, std::string> read(const SceneSpec& scene, std::string_view csv, std::size_t piece = 1 << 20) {
  TraceReader reader(scene, "out.csv");
  for (; !csv.empty(); csv.remove_prefix(std::min(piece, csv.size())))
    if (auto taken = reader.append(csv.substr(0, piece)); !taken) return std::unexpected(taken.error());
  return reader.finish();
}

TEST(TraceLesson, EqualsTheRecordsThatItWasWrittenFrom) {
  const Recorded trace = recorded("contact", 4);
  const auto lesson = read(trace.scene, trace.csv);
  ASSERT_TRUE(lesson) << lesson.error();
  ASSERT_EQ(lesson->rows(), trace.records.size());
  ASSERT_GT(lesson->rows(), 3900u);
  for (std::size_t r = 0; r < lesson->rows(); r += 97) {
    const server::TickRecord& record = trace.records[r];
    ASSERT_EQ(lesson->tick[r], record.tick);
    for (std::size_t i = 0; i < 2; ++i) {
      const LessonSeat& seat = lesson->seats[i];
      EXPECT_NEAR(seat.alpha[r], record.seats[i].alpha, 1e-9);
      EXPECT_EQ(seat.e_in[r][0], record.seats[i].e_in[0]);
      EXPECT_EQ(seat.leader[r], record.seats[i].leader);
      for (std::size_t c = 0; c < 3; ++c) {
        EXPECT_NEAR(seat.x[r][c], record.seats[i].x[c], 1e-9);
        EXPECT_NEAR(seat.f[r][c], record.seats[i].f_out[c], 1e-9);
        EXPECT_NEAR(seat.f_cmd[r][c], record.seats[i].f_cmd[c], 1e-9);
        EXPECT_NEAR(seat.q[r][c], record.seats[i].q[c], 1e-9);
      }
    }
    EXPECT_NEAR(lesson->tools[0].penetration[r], record.tools[0].penetration, 1e-9);
    EXPECT_NEAR(lesson->tools[0].f_env[r][0], record.tools[0].f_env[0], 1e-9);
    EXPECT_EQ(lesson->tools[0].held[r] != 0, record.tools[0].held);
  }
}

TEST(TraceLesson, HasTheScoresOfTheRecordsThemselves) {
  const Recorded trace = recorded("contact", 6);
  const auto lesson = read(trace.scene, trace.csv);
  ASSERT_TRUE(lesson) << lesson.error();
  Lesson direct;
  direct.scene = trace.scene;
  direct.seats.resize(2);
  direct.tools.resize(1);
  for (const server::TickRecord& record : trace.records) {
    direct.tick.push_back(record.tick);
    for (std::size_t i = 0; i < 2; ++i) {
      direct.seats[i].x.push_back(record.seats[i].x);
      direct.seats[i].f.push_back(record.seats[i].f_out);
      direct.seats[i].alpha.push_back(record.seats[i].alpha);
    }
    direct.tools[0].x.push_back(record.tools[0].x);
    direct.tools[0].f_env.push_back(record.tools[0].f_env);
    direct.tools[0].penetration.push_back(record.tools[0].penetration);
  }
  const auto from_file = score_lesson(*lesson), from_records = score_lesson(direct);
  ASSERT_TRUE(from_file && from_records);
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t p = 0; p < from_file->seats[i].parts.size(); ++p)
      for (const MetricRow& row : metric_rows()) {
        // Jerk and passivity: nine decimals of a position are 1 nm, which 1 kHz cubed makes 1 m/s^3.
        const double a = of(from_file->seats[i].parts[p].values, row.metric);
        const double b = of(from_records->seats[i].parts[p].values, row.metric);
        ASSERT_EQ(std::isnan(a), std::isnan(b)) << row.key;
        if (std::isnan(a)) continue;
        EXPECT_NEAR(a, b, 1e-5 * std::abs(b) + 1e-7) << row.key;
      }
}

TEST(TraceLesson, DoesNotDependOnThePiecesThatArrive) {
  const Recorded trace = recorded("one_axis", 1);
  const auto whole = read(trace.scene, trace.csv);
  ASSERT_TRUE(whole) << whole.error();
  for (const std::size_t piece : {1, 7, 4096}) {
    const auto lesson = read(trace.scene, trace.csv, piece);
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_EQ(lesson->tick, whole->tick);
    EXPECT_EQ(lesson->seats[0].x, whole->seats[0].x);
  }
}

TEST(TraceLesson, ReadsEveryShippedSceneOfEveryPort) {
  for (const char* name : {"two_by_two", "lesson", "one_axis", "seed_contact", "contact_remote", "evaluation"}) {
    const Recorded trace = recorded(name, 1);
    const auto lesson = read(trace.scene, trace.csv);
    ASSERT_TRUE(lesson) << lesson.error();
    EXPECT_TRUE(score_lesson(*lesson)) << name;
  }
}

SceneSpec small_scene() {
  SceneSpec scene = test::shipped("contact");
  scene.name = "small";
  return scene;
}

TEST(TraceLesson, NamesEveryMistake) {
  const std::string header = "tick[1],trainer.x[m],trainer.y[m],trainer.z[m]\n";
  const struct {
    std::string csv, error;
  } kMistakes[] = {
      {"", "out.csv:0: the file is empty"},
      {header, "out.csv:1: the trace has no row"},
      {"tick[1],stranger.x[m]\n", "out.csv:1: column stranger.x[m]: scene small has no such seat"},
      {"tick[1],trainer.x[mm]\n", "out.csv:1: column trainer.x[mm]: scene small has no such"},
      {"tick[1],trainer.x\n", "out.csv:1: column 2: \"trainer.x\" is not NAME[UNIT]"},
      {"tick[1],tick[1]\n", "out.csv:1: column tick[1]: occurs twice"},
      {"trainer.x[m],trainer.y[m],trainer.z[m]\n", "out.csv:1: the column tick[1] is missing"},
      {"tick[1],trainer.x[m]\n", "out.csv:1: no MASTER seat of scene small has its columns"},
      {header + "0,1,2\n", "out.csv:2: has 3 cells; the first line has 4"},
      {header + "0,1,2,3,4\n", "out.csv:2: has more cells than the first line, 4"},
      {header + "0,1,,3\n", "out.csv:2: column trainer.y[m]: \"\" is not a number"},
      {header + "0,1,2,3\n1,1,x7,3\n", "out.csv:3: column trainer.y[m]: \"x7\" is not a number"},
      {header + "0,1,2,\n", "out.csv:2: column trainer.z[m]"},
      {header + "-1,1,2,3\n", "out.csv:2: column tick[1]: must be an integer in [0, 4294967295]"},
      {header + "0.5,1,2,3\n", "out.csv:2: column tick[1]: must be an integer"},
      {header + "5,1,2,3\n4,1,2,3\n", "out.csv:3: column tick[1]: 4 is below the tick before, 5"},
      {std::string(100'000, 'x'), "out.csv:1: the line is longer than 65536 bytes"},
  };
  for (const auto& mistake : kMistakes) {
    const auto lesson = read(small_scene(), mistake.csv);
    ASSERT_FALSE(lesson) << mistake.csv.substr(0, 60);
    EXPECT_NE(lesson.error().find(mistake.error), std::string::npos) << lesson.error() << "\nwanted: " << mistake.error;
  }
}

TEST(TraceLesson, TakesUnknownValuesRepeatedTicksAndACutLine) {
  const auto lesson =
      read(small_scene(),
           "tick[1],trainer.x[m],trainer.y[m],trainer.z[m]\r\n0,1,2,3\r\n1,nan,2,3\r\n1,7,7,7\r\n2,1,2,3\n3,1");
  ASSERT_TRUE(lesson) << lesson.error();
  EXPECT_EQ(lesson->rows(), 3u);
  EXPECT_TRUE(std::isnan(lesson->seats[0].x[1][0]));
  EXPECT_TRUE(lesson->seats[1].x.empty());
  EXPECT_FALSE(lesson->complete);
}

TEST(TraceLesson, ReadsNumbersAsTheLibraryDoes) {
  std::vector<std::string> numbers{"0",
                                   "-0",
                                   "1.",
                                   ".5",
                                   "-.25",
                                   "1e-3",
                                   "-2.5E+2",
                                   "1e-320",
                                   "007.50",
                                   "inf",
                                   "-nan",
                                   "12345678901234567890",
                                   "0.1234567890123456789"};
  std::uint64_t state = 7;
  for (int i = 0; i < 2000; ++i) {
    state = state * 6364136223846793005u + 1442695040888963407u;
    const std::uint64_t digits = state >> (14 + i % 40);
    std::string text = std::to_string(digits);
    text.insert(text.size() > 1 ? 1 + (state >> 5) % (text.size() - 1) : 1, ".");
    numbers.push_back((i % 2 == 0 ? "-" : "") + text + (text.back() == '.' ? "0" : ""));
  }
  std::string csv = "tick[1],trainer.x[m],trainer.y[m],trainer.z[m]\n";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    csv += std::to_string(i) + "," + numbers[i] + ",0," + numbers[i] + "\n";
  const auto lesson = read(small_scene(), csv);
  ASSERT_TRUE(lesson) << lesson.error();
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double wanted = std::strtod(numbers[i].c_str(), nullptr);
    for (const std::size_t c : {0, 2}) {
      const double got = lesson->seats[0].x[i][c];
      EXPECT_TRUE(got == wanted || (std::isnan(got) && std::isnan(wanted))) << numbers[i] << " " << got;
      EXPECT_EQ(std::signbit(got), std::signbit(wanted)) << numbers[i];
    }
  }
}

TEST(TraceLesson, SurvivesEveryCutAndEveryFlippedByte) {
  const Recorded trace = recorded("one_axis", 0.01);
  for (std::size_t n = 0; n < trace.csv.size(); n += 5)
    (void)read(trace.scene, std::string_view(trace.csv).substr(0, n));
  for (std::size_t n = 0; n < trace.csv.size(); n += 3) {
    std::string bytes = trace.csv;
    bytes[n] = static_cast<char>(bytes[n] ^ (1 << (n % 8)));
    if (const auto lesson = read(trace.scene, bytes)) (void)score_lesson(*lesson);
  }
}

}  // namespace
}  // namespace tandem::netsim::score
