// The time range that a report covers, and when its verdict is that nothing was judged.
#include "server/report/report.h"

#include <gtest/gtest.h>

#include <cmath>
#include <nlohmann/json.hpp>

#include "proto/text/scene_text.h"
#include "proto/text/scenes_embedded.h"
#include "server/report/report_summary.h"

namespace tandem::server {
namespace {

SceneSpec scene(const std::string& name) { return *parse_scene(find_shipped_scene(name)->text, name + ".textproto"); }

/// A run in which the seats follow the tool's slave at a given, time-dependent offset.
struct LivedThrough {
  explicit LivedThrough(SceneSpec of, std::size_t slots = ReportBuilder::kSlotsMax)
      : spec(std::move(of)), builder(spec, slots) {}

  /// @param offset  of the hands from the slave [m]  @param amplitude  of the motion [m]
  void live(double seconds, double offset, double amplitude = 0.05, bool engaged = true) {
    for (int n = static_cast<int>(std::lround(seconds * spec.tick_hz)); n > 0; --n) {
      TickRecord r;
      r.tick = ++tick;
      if (tick % every != 0) continue;
      r.running = true;
      r.stopped_ticks = stood;
      const std::uint32_t sampled = tick - (every > 1 && tick / every % 2 == 0 ? 1 : 0);
      const double x = amplitude * std::sin(2 * 3.14159265358979 * 0.5 * sampled / spec.tick_hz);
      for (std::size_t i = 0; i < spec.seats.size(); ++i) {
        r.seats[i].x = {x + offset, 0, 0};
        r.seats[i].f_out = {offset * 100, 0, 0};
        r.seats[i].engaged = engaged;
        r.seats[i].sample_tick = sampled;
      }
      for (std::size_t j = 0; j < spec.tools.size(); ++j) {
        r.tools[j].x = {x, 0, 0};
        r.tools[j].held = false;
        r.tools[j].sample_tick = sampled;
      }
      builder.add(r);
    }
  }
  [[nodiscard]] RunReport report() const {
    RunReport r = builder.build(std::vector<LinkReport>(spec.seats.size()));
    return r;
  }

  SceneSpec spec;
  ReportBuilder builder;
  std::uint32_t tick = 0;
  std::uint32_t every =
      1;  ///< interval of records [ticks]; above 1: every second sample is a tick older than its record
  std::uint64_t stood = 0;  ///< ticks for which the clock was stopped so far
};

TEST(Report, CoversTheWholeSessionWhereASceneHasNoPhases) {
  LivedThrough run{scene("lesson")};
  run.live(30, 0.004);
  const RunReport r = run.report();
  EXPECT_NEAR(r.duration_s, 30, 1e-9);
  EXPECT_NEAR(r.judged_s, 29, 0.01) << "all but the first second";
  EXPECT_NEAR(r.seats[0].metrics.judged_s, 29, 0.01);
  EXPECT_NEAR(r.seats[0].metrics.tracking_rms_m, 0.004, 1e-6);
  EXPECT_TRUE(r.phases.empty());
  EXPECT_FALSE(r.outside.has_value()) << "nothing lies outside of no phases";
  EXPECT_STREQ(r.verdict(), "pass");
  const std::string words = report_summary(r, run.spec);
  EXPECT_NE(words.find("whole session"), std::string::npos) << words;
  EXPECT_NE(words.find("; lag free: the same without a constant lag; "), std::string::npos) << words;
  EXPECT_NE(words.find("judged: 29.0 of 30.0 s"), std::string::npos) << words;
}

// A session without --json, --trace, reports and recording.
TEST(Report, GivesTheSpeedOfSparseSamplesAndSaysThatTheyAreSparse) {
  LivedThrough whole{scene("lesson")}, sparse{scene("lesson")};
  sparse.every = 17;
  for (LivedThrough* run : {&whole, &sparse}) run->live(30, 0.004, 0.05);
  const RunReport r = sparse.report(), all = whole.report();
  const double peak = 2 * 3.14159265358979 * 0.5 * 0.05;  // 0.157 m/s
  EXPECT_NEAR(all.seats[0].metrics.speed_peak_m_s, peak, 0.001);
  EXPECT_NEAR(r.seats[0].metrics.speed_peak_m_s, peak, 0.001);
  EXPECT_NEAR(r.seats[0].metrics.tracking_rms_m, 0.004, 1e-4);
  EXPECT_NEAR(r.sparse_s, 30, 0.05);
  const std::string words = report_summary(r, sparse.spec);
  EXPECT_NE(words.find("sampled every 17 ms for 30.0 of 30.0 s: "), std::string::npos) << words;
  EXPECT_NE(words.find("`--json`, `--trace` or `reports` sample every tick"), std::string::npos) << words;
  RunReport shed = r;
  shed.shed_rows = 28000;
  const std::string why = report_summary(shed, sparse.spec);
  EXPECT_NE(why.find("the server was too busy and left rows out (load shedding)"), std::string::npos) << why;
  EXPECT_EQ(why.find("--json"), std::string::npos) << "it was given";
  EXPECT_EQ(report_summary(all, whole.spec).find("sampled every"), std::string::npos);
}

TEST(Report, GivesNoSpeedOfSamplesThatAreTooFarApart) {
  LivedThrough run{scene("lesson")};
  run.every = 200;
  run.live(30, 0.004);
  const RunReport r = run.report();
  EXPECT_TRUE(std::isnan(r.seats[0].metrics.speed_peak_m_s)) << r.seats[0].metrics.speed_peak_m_s;
}

// A hand that creeps is not one that rests.
TEST(Report, ShowsSpeedsBelowOneCentimetrePerSecond) {
  LivedThrough run{scene("lesson")};
  run.live(30, 0.004, 0.0011);  // 3.5 mm/s
  const std::string words = report_summary(run.report(), run.spec);
  EXPECT_NE(words.find(" 0.003\n"), std::string::npos) << words;
}

TEST(Report, NamesSeatsThatWereNotTakenInOneLine) {
  const SceneSpec scene = *parse_scene(find_shipped_scene("lesson")->text, "lesson");
  RunReport r;
  r.duration_s = 5;
  for (const SeatSpec& s : scene.seats) {
    SeatReport& seat = r.seats.emplace_back();
    seat.name = s.name;
    seat.taken = !s.name.starts_with("evaluator");
  }
  const std::string words = report_summary(r, scene);
  EXPECT_NE(words.find("\n  not taken: evaluator1, evaluator2, evaluator3\n"), std::string::npos) << words;
  EXPECT_EQ(words.find("evaluator1:"), std::string::npos) << words;
  EXPECT_EQ(words.find("whole session  evaluator1"), std::string::npos) << words;
  EXPECT_NE(words.find("whole session  trainee"), std::string::npos) << words;
}

TEST(Report, ShowsTheTimeOutsideThePhasesInASeparateRow) {
  SceneSpec spec = scene("free_motion");
  for (SeatSpec& s : spec.seats) s.hand.deviations.clear();
  LivedThrough run{std::move(spec)};  // phases 1 to 11.5 s and 12 to 18 s
  run.live(18, 0.001);
  run.live(12, 0.010);  // the session continued after its phases, with larger errors
  const RunReport r = run.report();
  EXPECT_NEAR(r.seats[0].metrics.tracking_rms_m, 0.001, 1e-4) << "of the phases";
  ASSERT_TRUE(r.outside.has_value());
  EXPECT_NEAR(r.outside->seats[0].judged_s, 12.5, 0.01) << "18 to 30 s and 11.5 to 12 s";
  EXPECT_NEAR(r.outside->seats[0].tracking_rms_m, std::sqrt((0.5 * 1e-6 + 12 * 1e-4) / 12.5), 1e-5);
  EXPECT_NEAR(r.outside->seats[0].effort_peak_n, 1.0, 1e-6);
  EXPECT_NEAR(r.phases[1].seats[0].effort_peak_n, 0.1, 1e-6) << "peaks are those of the part";
  EXPECT_NEAR(r.judged_s, 29, 0.01);
  EXPECT_NE(report_summary(r, run.spec).find("outside phases"), std::string::npos);
  const auto j = nlohmann::json::parse(to_json(r));
  EXPECT_EQ(j["outside_phases"]["seats"][0]["name"], "trainer");
  EXPECT_NEAR(j["outside_phases"]["seats"][0]["judged_s"].get<double>(), 12.5, 0.01);
  EXPECT_EQ(j["phases"].size(), 2u);
}

TEST(Report, SaysNotJudgedWhenNoHandMovedOrWasEngaged) {
  const auto expect_not_judged = [](const LivedThrough& run, const char* words) {
    const RunReport r = run.report();
    EXPECT_STREQ(r.verdict(), "not_judged");
    EXPECT_STREQ(r.verdict_text(), "not judged");
    EXPECT_TRUE(r.passed) << "no invariant was broken";
    EXPECT_NE(report_summary(r, run.spec).find(std::string("not judged: ") + words), std::string::npos)
        << report_summary(r, run.spec);
    EXPECT_EQ(nlohmann::json::parse(to_json(r))["verdict"], "not_judged");
  };
  LivedThrough still{scene("lesson")};
  still.live(20, 0.001, 0.0005);
  expect_not_judged(still, "no hand moved by more than 2 mm");
  EXPECT_NEAR(still.report().judged_s, 19, 0.01);
  LivedThrough loose{scene("lesson")};
  loose.live(20, 0.001, 0.05, false);
  expect_not_judged(loose, "no seat was engaged");
  EXPECT_EQ(loose.report().judged_s, 0);
  LivedThrough brief{scene("lesson")};
  brief.live(0.8, 0.001);
  expect_not_judged(brief, "no seat was engaged");
  LivedThrough none{scene("lesson")};
  expect_not_judged(none, "the session never ran");
}

TEST(Report, DoesNotJudgeTheFirstSecondAfterAStop) {
  LivedThrough run{scene("lesson")};
  run.live(5, 0.001);
  run.stood += 3000;  // no record shows it: the recorder omitted those in which hands were released
  run.live(5, 0.001);
  const RunReport r = run.report();
  EXPECT_NEAR(r.judged_s, 8, 0.01);
  EXPECT_NEAR(r.stopped_s, 3, 1e-9);
  EXPECT_NEAR(r.duration_s, 10, 1e-9);
}

TEST(Report, ComparesNoJointsWithAToolThatHasNone) {
  for (const char* name : {"contact", "seed_contact", "contact_remote"}) {
    LivedThrough run{scene(name)};
    run.live(8, 0.004);
    const auto joints = run.report().seats[0].metrics.joint_rms_rad;
    ASSERT_EQ(joints.size(), 3u) << name;
    for (const double q : joints) EXPECT_EQ(std::isnan(q), std::string(name) == "contact") << name;
  }
}

TEST(Report, FailsForABrokenInvariantEvenWhenNothingWasJudged) {
  RunReport r;
  r.passed = false;
  EXPECT_STREQ(r.verdict(), "fail");
  EXPECT_STREQ(r.verdict_text(), "FAIL");
}

TEST(Report, CoversALongSessionWithFewerSamples) {
  LivedThrough run{scene("lesson"), 10'000};  // as if 10 s were the capacity
  run.live(20, 0.001);
  run.live(20, 0.003);
  const RunReport r = run.report();
  EXPECT_NEAR(r.duration_s, 40, 1e-9);
  EXPECT_NEAR(r.judged_s, 39, 0.02);
  EXPECT_NEAR(r.seats[0].metrics.tracking_rms_m, std::sqrt((19 * 1e-6 + 20 * 9e-6) / 39), 1e-5);
  EXPECT_NEAR(r.seats[0].metrics.speed_peak_m_s, 0.157 + 0.002 / 0.008, 0.01)
      << "of the step of 2 mm, over every 8th sample";
  EXPECT_NEAR(r.seats[0].metrics.effort_peak_n, 0.3, 1e-6);
}

/// Half a second without an answer of the directory of a service; in it, all hands are free, so the tool is braked.
TEST(Report, DoesNotBlameSeatsForTheTimeWithoutTheDirectory) {
  const SceneSpec spec = scene("free_motion");
  ReportBuilder builder(spec);
  for (std::uint32_t tick = 1; tick <= 2000; ++tick) {
    TickRecord r;
    r.tick = tick;
    r.running = true;
    r.unleased = tick > 1000 && tick <= 1500;
    r.tools[0].held = tick > 1000 && tick <= 1600;
    builder.add(r);
  }
  const RunReport r = builder.build(std::vector<LinkReport>(2));
  EXPECT_DOUBLE_EQ(r.unleased_s, 0.5);
  EXPECT_DOUBLE_EQ(r.tools[0].held_s, 0.1) << "the seats were back 0.1 s later";
  const std::string text = report_summary(r, spec);
  EXPECT_NE(text.find("HELD for 0.5 s: the directory of the service (etcd) did not answer"), std::string::npos) << text;
  EXPECT_NE(text.find("braked (HELD) for 0.1 s: no seat with authority"), std::string::npos) << text;
  EXPECT_EQ(nlohmann::json::parse(to_json(r))["unleased_s"], 0.5);
  EXPECT_FALSE(nlohmann::json::parse(to_json(RunReport{})).contains("unleased_s"));
}

/// Distances are taken at the same session tick, independent of the slave. Hand 1 is 3 mm and 4 mm from hand 0, which
/// leads it for 10 s.
TEST(Report, ReportsTheDistanceBetweenAHandAndItsLeader) {
  const SceneSpec spec = scene("free_motion");
  ReportBuilder builder(spec);
  for (std::uint32_t tick = 1; tick <= 17'000; ++tick) {
    TickRecord r;
    r.tick = tick;
    r.running = true;
    for (std::size_t i = 0; i < 2; ++i) {
      const double x = 0.02 * std::sin(0.003 * tick);
      r.seats[i].x = {x + (i == 1 ? 0.003 : 0), 0, i == 1 ? 0.004 : 0};
      r.seats[i].engaged = true;
      r.seats[i].sample_tick = tick;
    }
    r.seats[1].leader = tick <= 10'000 ? 1 : 0;
    r.tools[0].held = false;
    r.tools[0].sample_tick = tick;
    builder.add(r);
  }
  const RunReport r = builder.build(std::vector<LinkReport>(2));
  EXPECT_NEAR(r.seats[1].metrics.leader_offset_rms_m, 0.005, 1e-6);
  EXPECT_TRUE(std::isnan(r.seats[0].metrics.leader_offset_rms_m)) << "no hand led it";
  const auto json = nlohmann::json::parse(to_json(r));
  EXPECT_NEAR(json["seats"][1]["leader_offset_rms_m"].get<double>(), 0.005, 1e-6);
  EXPECT_TRUE(json["seats"][0]["leader_offset_rms_m"].is_null());
}

}  // namespace
}  // namespace tandem::server
