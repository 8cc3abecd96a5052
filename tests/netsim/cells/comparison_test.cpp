// Reports of a comparison: CSV, the page, the figure, and the verdict on the default.
#include <gtest/gtest.h>

#include <algorithm>
#include <stdexcept>
#include <string>

#include "netsim/cells/comparison_page.h"
#include "netsim/cells/comparison_result.h"
#include "netsim/cells/shipped_cells.h"
#include "netsim/feel/meters.h"
#include "proto/text/cells_text.h"

namespace tandem::netsim {
namespace {

/// Two laws and two delays, task free; a result with 3 seeds of `value(cell, seed)` for every number.
template <class Value>
ComparisonResult comparison(const std::string& grids, const Value& value) {
  auto spec = parse_cells_text("version: 1 scene: \"contact\" seeds: 3 summary: \"a < b\"\n" + grids, "mine.textproto");
  if (!spec) throw std::runtime_error(to_text(spec.error()));
  ComparisonResult out{.typed = "mine.textproto", .spec = std::move(*spec), .cells = {}, .results = {}};
  out.cells = cells_of(out.spec);
  for (const Cell& cell : out.cells) {
    CellResult& result = out.results.emplace_back(CellResult{}).value();
    for (std::uint64_t seed = 1; seed <= 3; ++seed) {
      CellRun& run = result.runs.emplace_back();
      run.seed = seed;
      run.values.fill(value(cell, seed));
      run.values[static_cast<std::size_t>(CellNumber::kUnstable)] = cell.law == LawKind::kRaw ? 1 : 0;
    }
  }
  return out;
}

constexpr const char* kGrid = "grid { name: \"laws\" law: [REPLICA, PD, RAW] task: FREE delay_ms: [0, 20] }";

TEST(Comparison, JudgesTheDefaultAgainstStableLawsOnly) {
  const auto value = [](const Cell& cell, std::uint64_t) {
    return cell.law == LawKind::kReplica ? 1.0 : cell.law == LawKind::kRaw ? 0.1 : cell.delay_ms == 0 ? 0.95 : 0.5;
  };
  const ComparisonResult c = comparison(kGrid, value);
  const auto verdicts = judge_default(c);
  ASSERT_EQ(verdicts.size(), 4u);
  const DefaultVerdict& tracking = verdicts[0];
  EXPECT_EQ(tracking.compared, 2u);
  ASSERT_EQ(tracking.exceptions.size(), 1u) << "0.95 is within 10 %, 0.1 is unstable";
  EXPECT_EQ(c.cells[tracking.exceptions[0].own].delay_ms, 20);
  EXPECT_EQ(c.cells[tracking.exceptions[0].best].law, LawKind::kPd);
  EXPECT_TRUE(verdicts[1].exceptions.empty()) << "more stiffness is better";
  EXPECT_NE(comparison_text(c).find("Tracking: the default is best or within 10 % in 1 of 2 conditions"),
            std::string::npos)
      << comparison_text(c);
}

TEST(Comparison, WritesOneRowOfCsvPerCell) {
  const ComparisonResult c =
      comparison(kGrid, [](const Cell&, std::uint64_t seed) { return 0.001 * static_cast<double>(seed * seed); });
  const std::string csv = comparison_csv(c);
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 7);
  EXPECT_TRUE(
      csv.starts_with("cell[1],grid,law,coupling,hands[1],delay[ms],jitter[ms],loss[%],outage[ms],task,alpha,"
                      "seeds[1],tracking_median[m],tracking_worst[m],tracking_worst_seed[1],"))
      << csv;
  EXPECT_NE(csv.find("\n2,laws,replica,esc,2,20,0,0,0,free,1,3,0.004,0.009,3,"), std::string::npos) << csv;
  EXPECT_NE(csv.find("stiffness_felt_median[N/m],stiffness_felt_worst[N/m]"), std::string::npos);
  EXPECT_NE(csv.find(",1,tandem-netsim sweep --cells mine.textproto --cell 2\n"), std::string::npos) << csv;
}

TEST(Comparison, LeavesOutCellsThatWereNotRun) {
  ComparisonResult c = comparison(kGrid, [](const Cell&, std::uint64_t) { return 1.0; });
  c.results[1].reset();
  const std::string csv = comparison_csv(c), page = comparison_page(c, "0");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 6);
  EXPECT_NE(page.find("5 of 6 cells"), std::string::npos);
  EXPECT_NE(page.find("The sweep is not complete"), std::string::npos);
}

TEST(ComparisonPage, IsOneFileWithoutScriptAndExternalResource) {
  const ComparisonResult c = comparison(kGrid, [](const Cell& cell, std::uint64_t seed) {
    return 0.01 * (cell.delay_ms + 1.0) * static_cast<double>(seed);
  });
  const std::string page = comparison_page(c, "0.1");
  EXPECT_TRUE(page.starts_with("<!DOCTYPE html>"));
  std::string resources = page;  // without the name of the SVG language, which is no resource
  for (std::size_t at = 0; (at = resources.find("http://www.w3.org/2000/svg")) != std::string::npos;)
    resources.erase(at, 26);
  for (const char* part : {"<script", "http:", "https:", "src=", "@import", "url(", "<link"})
    EXPECT_EQ(resources.find(part), std::string::npos) << part;
  for (const char* part :
       {"prefers-color-scheme: dark", "each with 3 seeds", "a &lt; b", "replica, free", "title=\"cell 2, worst",
        "(seed 3)", "tandem-netsim sweep --cells mine.textproto --cell 6", "<svg", "best or within 10 %"})
    EXPECT_NE(page.find(part), std::string::npos) << part;
  EXPECT_EQ(page.find("<details", page.find("id=\"all\"")) == std::string::npos, false);
}

TEST(ComparisonPage, NamesItsFileOnceUnderTheTitle) {
  ComparisonResult c = comparison(kGrid, [](const Cell&, std::uint64_t) { return 1.0; });
  c.spec.name = "comparison";  // as the shipped file, whose page had the title "Comparison comparison"
  const std::string page = comparison_page(c, "0.1");
  EXPECT_NE(page.find("<h1>Laws and couplings compared</h1>"), std::string::npos);
  EXPECT_NE(page.find("<title>Tandem: laws and couplings compared (comparison)</title>"), std::string::npos);
  EXPECT_NE(page.find("<p>Cells of comparison: "), std::string::npos);
}

TEST(ComparisonPage, ColoursTheWorstSquareMost) {
  const ComparisonResult c = comparison(kGrid, [](const Cell& cell, std::uint64_t) {
    return cell.law == LawKind::kRaw && cell.delay_ms > 0 ? 10.0 : cell.law == LawKind::kReplica ? 0.01 : 0.1;
  });
  const std::string maps = heat_maps(c, 0);
  EXPECT_NE(maps.find("<td class=h9 title=\"cell 6, worst 10000 (seed 1)\">10000</td>"), std::string::npos) << maps;
  EXPECT_NE(maps.find("<td class=h0 title=\"cell 1, worst 10 (seed 1)\">10</td>"), std::string::npos) << maps;
  EXPECT_NE(maps.find("<td class=h0 title=\"cell 6, worst 10.0 (seed 1)\">10.0</td>"), std::string::npos)
      << "the largest stiffness is the best";
}

TEST(ComparisonPage, StaysBelowThreeMegabytesForTheShippedCells) {
  const EmbeddedFile* const shipped = find_shipped_cells("comparison");
  ASSERT_NE(shipped, nullptr);
  auto spec = parse_cells_text(shipped->text, "comparison.textproto");
  ASSERT_TRUE(spec);
  ComparisonResult c{.typed = "comparison", .spec = std::move(*spec), .cells = {}, .results = {}};
  c.cells = cells_of(c.spec);
  CellRun run;
  run.values.fill(0.0123456);
  c.results.assign(c.cells.size(), CellResult{{run, run, run}});
  const std::string page = comparison_page(c, "0.1");
  EXPECT_LT(page.size(), 3'000'000u);
  EXPECT_NE(page.find("--cells comparison --cell 2000</code>"), std::string::npos);
  EXPECT_LT(plot::to_svg_file(laws_figure(c)).size(), 300'000u);
}

TEST(ComparisonFigure, DrawsOneCurvePerLaw) {
  const ComparisonResult c = comparison(
      std::string(kGrid) + "grid { name: \"wall\" law: [REPLICA, PD] task: WALL delay_ms: [0, 20] jitter_ms: [0, 5] }",
      [](const Cell& cell, std::uint64_t) { return 0.001 * cell.delay_ms + 0.001; });
  const plot::Figure figure = laws_figure(c);
  ASSERT_EQ(figure.panels.size(), 2u);
  ASSERT_EQ(figure.panels[0].curves.size(), 2u) << "raw is unstable";
  EXPECT_EQ(figure.panels[0].curves[0].label, "replica");
  EXPECT_NEAR(figure.panels[0].curves[0].points[1].y, 21, 1e-9) << "mm";
  ASSERT_EQ(figure.panels[1].curves.size(), 2u);
  EXPECT_EQ(figure.panels[1].curves[0].points.size(), 2u) << "without jitter only";
}

}  // namespace
}  // namespace tandem::netsim
