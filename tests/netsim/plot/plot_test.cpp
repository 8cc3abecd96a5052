#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "netsim/plot/downsample.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::plot {
namespace {

TEST(RoundTicks, AreRoundNumbersInsideTheRange) {
  const Ticks t = round_ticks(-0.013, 0.047, 5);
  ASSERT_FALSE(t.values.empty());
  EXPECT_EQ(t.decimals, 2);
  EXPECT_NEAR(t.values.front(), 0.0, 0.011);
  for (const double v : t.values) {
    EXPECT_GE(v, -0.013 - 1e-12);
    EXPECT_LE(v, 0.047 + 1e-12);
    EXPECT_NEAR(v / 0.02, std::round(v / 0.02), 1e-9);
  }
  EXPECT_EQ(round_ticks(0, 18, 9).values, (std::vector<double>{0, 2, 4, 6, 8, 10, 12, 14, 16, 18}));
}

TEST(RoundTicks, AreNeverTooMany) {
  for (int e = -12; e <= 12; ++e)
    for (const double m : {1.0, 1.7, 2.3, 4.9, 5.1, 9.9})
      for (const int wanted : {1, 2, 3, 5, 10}) {
        const double span = m * std::pow(10, e);
        const Ticks t = round_ticks(0.3 * span, 1.3 * span, wanted);
        EXPECT_LE(t.values.size(), static_cast<std::size_t>(2 * wanted + 2)) << span << " " << wanted;
        EXPECT_GE(t.values.size() + (wanted < 2 ? 1 : 0), 1u) << span << " " << wanted;
      }
}

TEST(RoundTicks, AreEmptyForAnInvalidRange) {
  const double nan = std::numeric_limits<double>::quiet_NaN(), inf = std::numeric_limits<double>::infinity();
  EXPECT_TRUE(round_ticks(nan, 1, 5).values.empty());
  EXPECT_TRUE(round_ticks(0, inf, 5).values.empty());
  EXPECT_TRUE(round_ticks(1, 1, 5).values.empty());
  EXPECT_TRUE(round_ticks(2, 1, 5).values.empty());
  EXPECT_TRUE(round_ticks(1e18, 1e18 + 256, 5).values.empty()) << "the span is lost in rounding";
}

TEST(NumberText, FormatsNumbersReadably) {
  EXPECT_EQ(number_text(-1.25, 1), "−1.2");
  EXPECT_EQ(number_text(-0.001, 2), "0.00") << "no minus zero";
  EXPECT_EQ(number_text(std::numeric_limits<double>::quiet_NaN(), 2), "–");
  EXPECT_EQ(significant_text(8.2, 2), "8.2");
  EXPECT_EQ(significant_text(0.3501, 2), "0.35");
  EXPECT_EQ(significant_text(249.7, 3), "250");
  EXPECT_EQ(significant_text(9.96, 2), "10");
}

TEST(DownsampleExtremes, KeepsEveryPeakTheEndsAndTheOrder) {
  std::vector<Point2> curve;
  for (int k = 0; k < 20'000; ++k) curve.push_back({k * 1e-3, std::sin(k * 1e-3)});
  curve[7321].y = 50;  // one sample wide
  curve[15'002].y = -70;
  const auto thin = downsample_extremes(curve, 1000);
  EXPECT_LE(thin.size(), 1000u);
  EXPECT_GT(thin.size(), 900u);
  EXPECT_EQ(thin.front(), curve.front());
  EXPECT_EQ(thin.back(), curve.back());
  EXPECT_TRUE(std::ranges::is_sorted(thin, {}, &Point2::x));
  EXPECT_EQ(std::ranges::count(thin, curve[7321]), 1);
  EXPECT_EQ(std::ranges::count(thin, curve[15'002]), 1);
}

TEST(DownsampleExtremes, KeepsShortCurvesAndDropsNonFinitePoints) {
  const std::vector<Point2> curve{{0, 1}, {1, std::numeric_limits<double>::quiet_NaN()}, {2, 3}};
  EXPECT_EQ(downsample_extremes(curve, 1000), (std::vector<Point2>{{0, 1}, {2, 3}}));
  EXPECT_TRUE(downsample_extremes({}, 1000).empty());
}

TEST(DownsamplePath, KeepsTheShapeOfACircle) {
  std::vector<Point2> circle;
  for (int k = 0; k <= 20'000; ++k) circle.push_back({100 * std::cos(k * 1e-3), 100 * std::sin(k * 1e-3)});
  const auto thin = downsample_path(circle, 1.0, 1000);
  EXPECT_LE(thin.size(), 1000u);
  EXPECT_GT(thin.size(), 400u);
  for (const Point2& p : thin) EXPECT_NEAR(std::hypot(p.x, p.y), 100, 1e-9);
  EXPECT_EQ(thin.back(), circle.back());
}

TEST(SvgPlot, DrawsEveryCurveWithUnitsAndEscapedText) {
  Figure figure{"a < b & \"c\"", 1, {}};
  Panel panel{.title = "one", .x_label = "time [s]", .y_label = "x [mm]"};
  panel.curves = {{"slave", "slave", {{0, 0}, {1, 5}, {2, -5}}}, {"trainer", "trainer", {{0, 1}, {1, 4}, {2, -4}}}};
  panel.bands = {{0.5, 1, "a"}};
  figure.panels = {panel, panel};
  const std::string svg = to_svg(figure);
  EXPECT_TRUE(svg.starts_with("<svg"));
  EXPECT_TRUE(svg.ends_with("</svg>\n"));
  EXPECT_NE(svg.find("a &lt; b &amp; &quot;c&quot;"), std::string::npos);
  EXPECT_NE(svg.find("time [s]"), std::string::npos);
  EXPECT_NE(svg.find("x [mm]"), std::string::npos);
  const auto count = [&](const std::string& what) {
    std::size_t n = 0;
    for (std::size_t at = svg.find(what); at != std::string::npos; at = svg.find(what, at + 1)) ++n;
    return n;
  };
  EXPECT_EQ(count("line trainer"), 3u) << "two panels and one legend entry";
  EXPECT_EQ(count("<svg"), count("</svg>"));
  EXPECT_EQ(count("nan"), 0u);
  EXPECT_EQ(to_svg(figure), svg) << "same numbers, same bytes";
}

/// Position of a text of a class: x of its middle, y, and the text.
struct LocatedText {
  double x = 0, y = 0;
  std::string text;
};
std::vector<LocatedText> texts_of(const std::string& svg, const std::string& kind) {
  std::vector<LocatedText> found;
  const std::string begin = "<text class=\"" + kind + "\" x=\"";
  for (std::size_t at = svg.find(begin); at != std::string::npos; at = svg.find(begin, at + 1)) {
    LocatedText t;
    t.x = std::stod(svg.substr(at + begin.size()));
    t.y = std::stod(svg.substr(svg.find("y=\"", at) + 3));
    const std::size_t open = svg.find('>', at) + 1;
    t.text = svg.substr(open, svg.find('<', open) - open);
    found.push_back(t);
  }
  return found;
}

TEST(SvgPlot, UsesOneColumnWithoutOverlapOnANarrowScreen) {
  Panel panel{.title = "one", .x_label = "time [s]", .y_label = "x [mm]"};
  panel.curves = {{"a legend entry that is long", "slave", {{0, 0}, {18, 5}}},
                  {"another one that is long", "trainer", {{0, 1}, {18, 4}}}};
  panel.bands = {{7, 8.5, "trainee pushes"}, {14, 15.5, "trainer pushes"}};
  panel.verticals = {{11.5, "α moves"}};
  const Figure figure{"narrow", 3, {panel, panel, panel}};
  const std::string narrow = to_svg(figure, kNarrowWidth), wide = to_svg(figure);
  EXPECT_NE(narrow.find("viewBox=\"0 0 372 "), std::string::npos);
  std::vector<double> columns;
  for (const LocatedText& t : texts_of(narrow, "label mid"))
    if (t.text == "time [s]") columns.push_back(t.x);
  EXPECT_EQ(columns, std::vector<double>(3, columns.at(0))) << "one below the other";
  for (const std::string& svg : {narrow, wide}) {
    const auto marks = texts_of(svg, "note mid");
    ASSERT_EQ(marks.size(), 9u);
    for (std::size_t a = 0; a < marks.size(); ++a)
      for (std::size_t b = a + 1; b < marks.size(); ++b) {
        if (std::abs(marks[a].y - marks[b].y) > 10) continue;
        const double apart = std::abs(marks[a].x - marks[b].x);
        EXPECT_GE(apart, 6.2 * static_cast<double>(marks[a].text.size() + marks[b].text.size() - 2) / 2)
            << marks[a].text << " and " << marks[b].text;
      }
  }
  const auto legend = texts_of(narrow, "legend");
  ASSERT_EQ(legend.size(), 2u);
  EXPECT_LT(legend[0].y, legend[1].y) << "both do not fit into one row";
}

TEST(SvgPlot, SurvivesCurvesWithoutPointsAndWithoutHeight) {
  Figure figure{"empty", 2, {}};
  figure.panels.push_back({.y_label = "nothing", .curves = {{"none", "trainer", {}}}});
  figure.panels.push_back({.y_label = "flat", .curves = {{"flat", "slave", {{1, 2}, {1, 2}}}}});
  const std::string svg = to_svg(figure);
  EXPECT_EQ(svg.find("nan"), std::string::npos);
  EXPECT_EQ(svg.find("inf"), std::string::npos);
  const Range r = range_of(figure.panels[1].curves, true, 0.5);
  EXPECT_NEAR(r.hi - r.lo, 0.5, 1e-12);
}

}  // namespace
}  // namespace tandem::netsim::plot
