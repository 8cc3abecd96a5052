#include <gtest/gtest.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <sstream>

#include "common/base/wrap_words.h"
#include "netsim/demo/app/child_process.h"
#include "netsim/demo/app/live_run.h"
#include "netsim/demo/app/read_report.h"
#include "netsim/demo/comparison.h"
#include "netsim/demo/html_report.h"
#include "netsim/demo/text_table.h"

namespace tandem::netsim::demo {
namespace {

using Json = nlohmann::json;

Json seat(const char* name, double tracking) {
  return {{"name", name},
          {"tracking_rms_m", tracking},
          {"transport_lag_rms_m", 0.003},
          {"joint_rms_rad", {0.017, 0.055, nullptr}},
          {"force_error_rms_n", nullptr},
          {"effort_peak_n", 3.0},
          {"speed_peak_m_s", 0.2},
          {"gate_trips", 1},
          {"link", {{"rtt_p50_ms", 1.0}, {"up", {{"loss_percent", 4.0}}}, {"down", {{"loss_percent", 6.0}}}}}};
}

std::string report(double leader, double follower) {
  const Json seats = {seat("trainer", leader), seat("trainee", follower)};
  return Json{{"verdict", "pass"},
              {"duration_s", 18.0},
              {"violations", {{{"invariant", "ledger"}, {"seat", "trainer"}, {"at_s", 2.0}, {"expected", true}}}},
              {"machine", {{"late_ticks", 5}}},
              {"seats", seats},
              {"tools", Json::array()},
              {"phases", {{{"name", "demonstration"}, {"from_s", 1.0}, {"to_s", 11.5}, {"seats", seats}}}}}
      .dump();
}

RunResult run(Setting setting, double leader, double follower) {
  RunResult r;
  r.plan = &run_plan(Task::kFreeMotion, setting);
  r.report = read_report(report(leader, follower)).value();
  return r;
}

const Row& find_row(const Comparison& c, const std::string& section, const std::string& label) {
  for (const Section& s : c.sections)
    if (s.title.find(section) != std::string::npos)
      for (const Row& r : s.rows)
        if (r.label == label) return r;
  throw std::runtime_error("no row " + label);
}

TEST(ReadReport, ReadsNumbersAndKeepsUnknownValues) {
  const auto r = read_report(report(0.008, 0.006));
  ASSERT_TRUE(r) << r.error();
  EXPECT_TRUE(r->passed);
  EXPECT_DOUBLE_EQ(r->trainer.tracking_m, 0.008);
  EXPECT_TRUE(std::isnan(r->trainer.force_error_n)) << "null is not zero";
  EXPECT_TRUE(std::isnan(r->trainer.joint_rad[2]));
  EXPECT_DOUBLE_EQ(r->gate_trips, 2);
  EXPECT_DOUBLE_EQ(r->late_ticks, 5);
  EXPECT_TRUE(std::isnan(r->contact_force_n)) << "no tool";
  ASSERT_NE(r->phase("demonstration"), nullptr);
  EXPECT_EQ(r->phase("alignment"), nullptr);
  EXPECT_DOUBLE_EQ(read_late_ticks(R"({"machine":{"late_ticks":7}})"), 7);
  EXPECT_DOUBLE_EQ(read_late_ticks("no json"), 0);
}

TEST(ReadReport, ReportsMistakes) {
  EXPECT_FALSE(read_report(""));
  EXPECT_FALSE(read_report("[]"));
  EXPECT_FALSE(read_report(R"({"verdict":1,"violations":[],"seats":[],"tools":[],"phases":[]})"));
  EXPECT_FALSE(read_report(R"({"verdict":"pass"})"));
}

TEST(Comparison, MarksMetAndMissedLimits) {
  const std::vector<RunResult> runs{run(Setting::kSeed, 0.0082, 0.0061), run(Setting::kDefaults, 0.0018, 0.0021),
                                    run(Setting::kBadNetwork, 0.0063, 0.004)};
  const Comparison c = compare(runs);
  const Row& leader = find_row(c, "demonstration", "leader–tool position RMS");
  EXPECT_EQ(leader.paper, "8.2");
  EXPECT_EQ(leader.cells[0].value, "8.20");
  EXPECT_EQ(leader.cells[0].limit, "≤ 16.4");
  EXPECT_EQ(leader.cells[0].mark, Mark::kMet);
  EXPECT_EQ(leader.cells[1].mark, Mark::kMet);
  EXPECT_EQ(leader.cells[2].limit, "≤ 6") << "1.25 x (1.8 mm + 3 mm of transport lag)";
  EXPECT_EQ(leader.cells[2].mark, Mark::kMissed);
  const Row& follower = find_row(c, "demonstration", "follower–tool position RMS");
  EXPECT_EQ(follower.cells[1].mark, Mark::kMissed);
  EXPECT_EQ(follower.cells[2].mark, Mark::kNone) << "nothing is asked";
  EXPECT_EQ(find_row(c, "demonstration", "joint 2 RMS, leader–slave").cells[0].value, "55.0");
  EXPECT_EQ(find_row(c, "network", "datagrams lost, up and down").cells[0].value, "5.00");
  EXPECT_EQ(find_row(c, "network", "broken invariants (promised ones)").cells[0].value, "0") << "an expected breach";
}

TEST(Comparison, NotesModelValuesBelowHalfOfThePaper) {
  const auto says_so = [](const Comparison& c) {
    return std::ranges::any_of(c.footnotes,
                               [](const std::string& n) { return n.find("below half") != std::string::npos; });
  };
  const RunResult close = run(Setting::kSeed, 0.0042, 0.0031), far = run(Setting::kSeed, 0.0040, 0.0031);
  EXPECT_FALSE(says_so(compare({&close, 1})));
  EXPECT_TRUE(says_so(compare({&far, 1})));
}

TEST(Comparison, ShowsDashesForRunsThatWereNotMade) {
  const RunResult only = run(Setting::kDefaults, 0.001, 0.001);
  const Comparison c = compare({&only, 1});
  const Row& leader = find_row(c, "demonstration", "leader–tool position RMS");
  EXPECT_EQ(leader.cells[0].value, "–");
  EXPECT_EQ(leader.cells[0].mark, Mark::kNone);
  EXPECT_TRUE(compare({}).sections.empty());
}

TEST(Comparison, AbbreviatesLimits) {
  EXPECT_EQ(cell_of(1.0, 1, {.least = 245, .most = 255}).limit, "250 ± 2 %");
  EXPECT_EQ(cell_of(0.1, 1, {.most = 0.2}).limit, "≤ 0.2");
  EXPECT_EQ(cell_of(0, 0, {.most = 0}).limit, "≤ 0");
  EXPECT_EQ(cell_of(2.0, 1, {.most = 2}).mark, Mark::kMet) << "not above";
}

TEST(TextTable, FitsATerminalOf110Columns) {
  const std::vector<RunResult> runs{run(Setting::kSeed, 0.0082, 0.0061), run(Setting::kDefaults, 0.0018, 0.0021),
                                    run(Setting::kBadNetwork, 0.0063, 0.004)};
  const std::string text = to_text(compare(runs), false);
  std::istringstream lines(text);
  std::size_t rows = 0;
  for (std::string line; std::getline(lines, line); ++rows) EXPECT_LE(display_width(line), kTextWidth) << line;
  EXPECT_GT(rows, 20u);
  EXPECT_EQ(text.find('\x1b'), std::string::npos) << "colours only on a terminal";
  EXPECT_NE(to_text(compare(runs), true).find('\x1b'), std::string::npos);
}

TEST(TextTable, FitsATerminalOf80ColumnsWithTheSameNumbers) {
  const std::vector<RunResult> runs{run(Setting::kSeed, 0.0082, 0.0061), run(Setting::kDefaults, 0.0018, 0.0021),
                                    run(Setting::kBadNetwork, 0.0063, 0.004)};
  const auto words = [](const std::string& text) {
    std::istringstream in(text.substr(text.find("FREE MOTION")));
    std::vector<std::string> all;
    for (std::string word; in >> word;)
      if (word.find("─") == std::string::npos) all.push_back(word);
    return all;
  };
  const std::string narrow = to_text(compare(runs), false, 80);
  std::istringstream lines(narrow);
  for (std::string line; std::getline(lines, line);) EXPECT_LT(display_width(line), 80u) << line;
  EXPECT_EQ(words(narrow), words(to_text(compare(runs), false)));
}

TEST(HtmlReport, IsOneFileWithoutNetworkReferences) {
  RunResult only = run(Setting::kDefaults, 0.001, 0.001);
  only.commands = {"tandem-server run free_motion --json '<x>'"};
  const std::string html =
      html_report({&only, 1}, compare({&only, 1}), {true, "2026-01-01 00:00 UTC", "2 cores", "1.0", "./demo"});
  EXPECT_TRUE(html.starts_with("<!DOCTYPE html>"));
  for (const char* outside :
       {"<link", "@import", "src=", "url(", "https:", "fetch(", "XMLHttp", "WebSocket", "import("})
    EXPECT_EQ(html.find(outside), std::string::npos) << outside;
  EXPECT_NE(html.find("&lt;x&gt;"), std::string::npos);
  EXPECT_NE(html.find("id=\"free_motion\""), std::string::npos);
  EXPECT_NE(html.find("prefers-color-scheme"), std::string::npos);
}

TEST(ListeningAddress, IsParsedFromACompleteLineOnly) {
  EXPECT_EQ(listening_address("warming up\nlistening on 127.0.0.1:4000\nmore"), "127.0.0.1:4000");
  EXPECT_EQ(listening_address("listening on [::1]:4000\n"), "[::1]:4000");
  EXPECT_EQ(listening_address("listening on 127.0.0.1:40"), "") << "the rest may follow";
  EXPECT_EQ(listening_address("not listening on 1.2.3.4:5\n"), "");
}

TEST(CommandText, QuotesShellSpecialCharacters) {
  EXPECT_EQ(command_text({"a", "--x=1", "b c", "d'e"}), "a --x=1 'b c' 'd'\\''e'");
}

}  // namespace
}  // namespace tandem::netsim::demo
