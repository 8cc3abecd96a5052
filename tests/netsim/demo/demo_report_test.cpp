#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <limits>

#include "netsim/demo/animation.h"
#include "netsim/demo/app/network_series.h"
#include "netsim/demo/app/repeat_commands.h"
#include "netsim/demo/headline.h"
#include "netsim/demo/html_report.h"
#include "netsim/demo/overlay.h"

namespace tandem::netsim::demo {
namespace {

/// Returns 4 s at 1 kHz. The trainer is `trainer_mm` from the slave along x, with a peak of 500 mm in one row.
TraceData trace_of(double trainer_mm) {
  TraceData d;
  for (int k = 0; k <= 4000; ++k) {
    d.t.push_back(k * 1e-3);
    for (Column3* x : {&d.trainer.x, &d.trainee.x, &d.tool.x, &d.trainer.f_out, &d.trainee.f_out})
      for (Column& column : *x) column.push_back(0);
    d.tool.x[2].back() = 0.01;
    d.trainer.x[2].back() = 0.01;
    d.trainer.x[0].back() = 1e-3 * trainer_mm;
    d.trainee.x[0].back() = -0.005;
    d.trainer.f_out[1].back() = 0.25;
    d.trainer.alpha.push_back(k < 2000 ? 1 : 0);
  }
  d.trainer.x[0][1234] = 0.5;
  return d;
}

RunResult result(Task task, Setting setting, double tracking_m, double trainer_mm = 3) {
  RunResult r;
  r.plan = &run_plan(task, setting);
  PhaseNumbers phase;
  phase.name = "demonstration";
  phase.trainer.tracking_m = tracking_m;
  r.report.passed = true;
  r.report.phases = {phase};
  const TraceData trace = trace_of(trainer_mm);
  r.overlay = overlay_series(*r.plan, trace);
  r.motion = motion_frames(trace);
  return r;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + 1)) ++n;
  return n;
}

TEST(Headline, ReportsAllLimitsKeptAndTheTwoNumbers) {
  std::vector<RunResult> runs{result(Task::kFreeMotion, Setting::kDefaults, 0.0014),
                              result(Task::kFreeMotion, Setting::kBadNetwork, 0.0045),
                              result(Task::kContact, Setting::kDefaults, 0.001)};
  runs[2].trace.force_x_leader_n = 0.0096;
  Comparison comparison{
      {{"A", {{"row", "mm", "", "", {cell_of(1, 1, {0, 2}), cell_of(1, 1), cell_of(2, 1, {0, 2})}}}}}, {}, 0};
  const Headline headline = headline_of(runs, comparison);
  EXPECT_EQ(headline.sentence, "Two people held one tool, also over a bad network. All 2 limits were kept.");
  EXPECT_TRUE(headline.missed.empty());
  ASSERT_EQ(headline.numbers.size(), 2u);
  EXPECT_EQ(headline.numbers[0].value, "1.4 mm");
  EXPECT_EQ(headline.numbers[0].beside, "paper 8.2 mm; on the bad network 4.5 mm");
  EXPECT_EQ(headline.numbers[1].value, "0.0096 N");
  EXPECT_EQ(headline.numbers[1].beside, "paper 0.35 N");
}

TEST(Headline, OfDisturbedRunsIsNoSuccess) {
  std::vector<RunResult> runs{result(Task::kFreeMotion, Setting::kDefaults, 0.0014),
                              result(Task::kContact, Setting::kDefaults, 0.001)};
  const Comparison comparison{{{"A", {{"row", "mm", "", "", {cell_of(1, 1, {0, 2}), {}, {}}}}}}, {}, 0};
  for (RunResult& run : runs) {
    run.report.gate_trips = 0;
    run.report.late_ticks = 0;
    run.report.duration_s = 10;
  }
  runs[1].report.late_ticks = 1;  // of 2 * 3 * 10 s * 1000 Hz; 2e-5 of them are 1.2
  EXPECT_EQ(headline_of(runs, comparison).disturbed, "");
  EXPECT_EQ(headline_of(runs, comparison).sentence, "Two people held one tool. All 1 limits were kept.");

  runs[1].report.late_ticks = 2;
  const Headline late = headline_of(runs, comparison);
  EXPECT_EQ(late.sentence, "Two people held one tool. All 1 limits were kept.") << "errors get no smaller";
  EXPECT_TRUE(
      late.disturbed.starts_with("DISTURBED: 0 gate trips, 2 late ticks of 60000 (0.0033 %; undisturbed: at "
                                 "most 1). "))
      << late.disturbed;
  EXPECT_NE(late.disturbed.find("kept limits hold"), std::string::npos);
  EXPECT_NE(late.disturbed.find("--quick"), std::string::npos);
  EXPECT_NE(html_report(runs, comparison, {}).find("DISTURBED: 0 gate trips"), std::string::npos);

  runs[1].report.late_ticks = 60;  // one in a thousand
  EXPECT_FALSE(disturbance_of(runs).heavy());
  runs[1].report.late_ticks = 61;
  const Headline heavy = headline_of(runs, comparison);
  EXPECT_EQ(heavy.sentence,
            "Two people held one tool. All 1 limits were kept, but the runs were disturbed too much for "
            "that to prove anything.");
  EXPECT_NE(heavy.disturbed.find("judge the machine"), std::string::npos) << heavy.disturbed;

  runs[1].report.late_ticks = std::numeric_limits<double>::quiet_NaN();  // as in virtual time
  runs[0].report.gate_trips = 1;
  const Headline released = headline_of(runs, comparison);
  EXPECT_TRUE(released.disturbed.starts_with("DISTURBED: 1 gate trip, 0 late ticks of 60000 (0 %;"))
      << released.disturbed;
  EXPECT_TRUE(disturbance_of(runs).heavy()) << "one released hand is enough";
  EXPECT_TRUE(released.sentence.ends_with("too much for that to prove anything.")) << released.sentence;
}

TEST(Headline, NamesEachMissedLimit) {
  const std::vector<RunResult> runs{result(Task::kFreeMotion, Setting::kDefaults, 0.0034)};
  const Comparison comparison{
      {{"A", {{"distance", "mm", "", "", {cell_of(1, 1, {0, 2}), cell_of(3.4, 1, {0, 2}), cell_of(1, 1)}}}}}, {}, 1};
  const Headline headline = headline_of(runs, comparison);
  EXPECT_EQ(headline.sentence, "Two people held one tool. 1 of 2 limits was missed.");
  ASSERT_EQ(headline.missed.size(), 1u);
  EXPECT_NE(headline.missed[0].find("distance, defaults: 3.4 mm, asked "), std::string::npos) << headline.missed[0];
}

TEST(Headline, OmitsSettingsThatWereNotRun) {
  const std::vector<RunResult> runs{result(Task::kContact, Setting::kSeed, 0.001)};
  EXPECT_TRUE(headline_of(runs, {}).numbers.empty());
  EXPECT_EQ(headline_of(runs, {}).sentence, "Two people held one tool. Nothing was asked of these runs.");
}

TEST(Overlay, HasACurveForEachSettingAndKeepsPeaks) {
  const std::vector<RunResult> runs{result(Task::kFreeMotion, Setting::kSeed, 0.008, 8),
                                    result(Task::kFreeMotion, Setting::kDefaults, 0.001, 1)};
  const auto figures = overlay_figures(runs);
  ASSERT_EQ(figures.size(), 1u) << "no contact run, no contact figure";
  const plot::Panel& distance = figures[0].figure.panels[0];
  ASSERT_EQ(distance.curves.size(), 2u);
  EXPECT_DOUBLE_EQ(distance.curves[0].points.front().y, 8);
  EXPECT_DOUBLE_EQ(distance.curves[1].points.front().y, 1);
  double peak = 0;
  for (const plot::Point2& p : distance.curves[1].points) peak = std::max(peak, p.y);
  EXPECT_DOUBLE_EQ(peak, 500) << "one sample of 4001 stays";
  ASSERT_EQ(distance.horizontals.size(), 1u);
  EXPECT_DOUBLE_EQ(distance.horizontals[0].at, 8.2);
  for (const plot::Panel& p : figures[0].figure.panels) EXPECT_EQ(p.title.find("bad network"), std::string::npos);
}

TEST(Overlay, DrawsDelayAndLossOfTheBadNetwork) {
  std::vector<RunResult> runs{result(Task::kContact, Setting::kBadNetwork, 0.001)};
  runs[0].network.delay = {{{{0, 20}, {1, 24}}, {{0, 21}, {1, 22}}}};
  runs[0].network.lost = {{{{0.5, 0.501, ""}}, {}}};
  const auto figures = overlay_figures(runs);
  ASSERT_EQ(figures.size(), 1u);
  const plot::Panel* up = nullptr;
  for (const plot::Panel& p : figures[0].figure.panels)
    if (p.title.find("to the server") != std::string::npos) up = &p;
  ASSERT_NE(up, nullptr);
  EXPECT_EQ(up->curves[0].points, runs[0].network.delay[0]);
  EXPECT_EQ(up->rug.size(), 1u);
  EXPECT_EQ(up->y->lo, 0) << "a delay is seen against nothing";
}

TEST(NetworkSeries, TakesTheFirstFlowWithinTheSession) {
  const auto at = [](double ms) { return Time{} + Duration{std::llround(ms * 1e6)}; };
  std::vector<Decision> decisions;
  decisions.push_back({.in = at(900), .out = at(920)});                                   // before the session
  decisions.push_back({.in = at(1100), .out = at(1123)});                                 // 23 ms
  decisions.push_back({.in = at(1200), .out = at(1200), .outcome = Outcome::kLost});      // lost
  decisions.push_back({.in = at(1300), .out = at(1330), .flow = 1});                      // of another client
  decisions.push_back({.in = at(1400), .out = at(1440), .direction = Direction::kDown});  // 40 ms down
  decisions.push_back({.in = at(1500), .out = at(1500), .outcome = Outcome::kWaiting});   // undecided
  decisions.push_back({.in = at(1600), .out = at(1900), .copy = true});                   // copies have no delay
  decisions.push_back({.in = at(3100), .out = at(3120)});                                 // after the session
  const NetworkSeries series = network_series(decisions, at(1000), 2);
  ASSERT_EQ(series.delay[0].size(), 1u);
  EXPECT_NEAR(series.delay[0][0].x, 0.1, 1e-12);
  EXPECT_NEAR(series.delay[0][0].y, 23, 1e-9);
  ASSERT_EQ(series.delay[1].size(), 1u);
  EXPECT_NEAR(series.delay[1][0].y, 40, 1e-9);
  ASSERT_EQ(series.lost[0].size(), 1u);
  EXPECT_NEAR(series.lost[0][0].from, 0.2, 1e-12);
  EXPECT_TRUE(series.lost[1].empty());
  EXPECT_EQ(begin_of_session(decisions, 2), at(1100)) << "the last datagram to the server ends it";
}

TEST(MotionFrames, AreFiftyPerSecondInTheirUnits) {
  const MotionFrames motion = motion_frames(trace_of(3));
  ASSERT_EQ(motion.frames.size(), 201u);  // 0 to 4 s
  EXPECT_EQ(motion.frames[10][0], 30) << "3 mm in tenths";
  EXPECT_EQ(motion.frames[10][3], -50);
  EXPECT_EQ(motion.frames[10][8], 100);
  EXPECT_EQ(motion.frames[10][9], 25) << "0.25 N in hundredths";
  EXPECT_EQ(motion.frames[99][11], 100);
  EXPECT_EQ(motion.frames[100][11], 0);
}

TEST(MotionFrames, RepeatUnknownValuesAndKeepTimeOverAGap) {
  TraceData d = trace_of(3);
  for (std::size_t k = 0; k < d.rows(); ++k)
    if (d.t[k] > 1) d.trainer.x[0][k] = k % 2 == 0 ? std::nan("") : INFINITY;
  const MotionFrames motion = motion_frames(d);
  EXPECT_EQ(motion.frames.back()[0], 30);
  TraceData gap;
  for (const double t : {0.0, 0.02, 1.0}) {
    gap.t.push_back(t);
    for (Column3* x : {&gap.trainer.x, &gap.trainee.x, &gap.tool.x, &gap.trainer.f_out, &gap.trainee.f_out})
      for (Column& column : *x) column.push_back(t);
    gap.trainer.alpha.push_back(1);
  }
  EXPECT_EQ(motion_frames(gap).frames.size(), 51u);
}

TEST(ProgramPrefix, IsTheCommandAsTyped) {
  namespace fs = std::filesystem;
  EXPECT_EQ(program_prefix("/home/a/tandem/build/release/bin", "/home/a/tandem", "/usr/bin:/bin"),
            "build/release/bin/");
  EXPECT_EQ(program_prefix("/home/a/tandem/bin", "/home/a/tandem/bin", "/usr/bin"), "./");
  EXPECT_EQ(program_prefix("/opt/t/bin", "/home/a", "/usr/bin"), "/opt/t/bin/");
  EXPECT_EQ(program_prefix(fs::temp_directory_path(), "/", fs::temp_directory_path().string() + ":/usr/bin"), "")
      << "the shell finds it";
}

TEST(RealCommands, NameFixedPortsThatFitTogether) {
  const auto commands = real_commands(run_plan(Task::kFreeMotion, Setting::kBadNetwork), "bin/");
  ASSERT_EQ(commands.size(), 4u);
  EXPECT_NE(commands[0].find("bin/tandem-server run free_motion --listen 127.0.0.1:47000 "), std::string::npos);
  EXPECT_NE(commands[1].find("--to 127.0.0.1:47000 --delay 20 --jitter 5 --loss 5 --seed 1"), std::string::npos);
  for (const std::size_t k : {2u, 3u}) EXPECT_NE(commands[k].find("--server 127.0.0.1:47001"), std::string::npos);
  for (const std::string& c : commands) EXPECT_EQ(c.find(":0 "), std::string::npos) << c;
}

TEST(HtmlReport, BeginsWithWordsNumbersAndThePicture) {
  std::vector<RunResult> runs{result(Task::kFreeMotion, Setting::kDefaults, 0.0014)};
  const std::string html = html_report(runs, compare(runs), {true, "2026-01-01 00:00 UTC", "2 cores", "1.0", "./demo"});
  std::size_t before = 0;
  for (const char* part : {"class=\"headline\"", "1.4 mm", "class=\"figure setup\"", "id=\"player-time\"",
                           "id=\"settings-free\"", "class=\"comparison\"", "id=\"free_motion\""}) {
    const std::size_t at = html.find(part);
    ASSERT_NE(at, std::string::npos) << part;
    EXPECT_GT(at, before) << part << " stands too early";
    before = at;
  }
  EXPECT_EQ(count(html, "<div class=\"wide\">"), count(html, "<div class=\"narrow\">"));
  EXPECT_NE(html.find("viewBox=\"0 0 372 "), std::string::npos) << "drawn for a screen of 400 px too";
}

}  // namespace
}  // namespace tandem::netsim::demo
