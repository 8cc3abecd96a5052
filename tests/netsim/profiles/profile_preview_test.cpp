#include "netsim/profiles/profile_preview.h"

#include <gtest/gtest.h>

#include "netsim/profiles/profile_loader.h"
#include "netsim/profiles/profile_preview_figure.h"
#include "netsim/profiles/profile_preview_text.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t n = 0;
  for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + what.size())) ++n;
  return n;
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t end = text.find('\n', at);
    lines.push_back(text.substr(at, end - at));
    at = end + 1;
  }
  return lines;
}

TEST(ProfilePreview, CountsEveryDatagramOnce) {
  LinkSpec link = link_from({.delay = 10ms, .duplicate = 0.5});
  link.up.outages = {{.start = 1s, .length = 400ms, .period = 2s}};
  const ProfilePreview p = preview_profile({.link = link, .length = 10s, .shown = 4s});
  EXPECT_EQ(p.ways[0].delays.size(), 10'000U - 5 * 400);
  EXPECT_EQ(p.ways[1].delays.size(), 10'000U) << "datagrams under way at the end still arrive; there are no copies";
  EXPECT_EQ(p.ways[0].fates[static_cast<std::size_t>(Outcome::kOutage)], 2000U);
  EXPECT_EQ(p.ways[0].quantile(0), 10ms);
  EXPECT_EQ(p.ways[0].quantile(1), 10ms);
  ASSERT_EQ(p.ways[0].shown.size(), 4000U);
  for (std::size_t i = 0; i < 4000; ++i) {
    const bool out = i % 2000 >= 1000 && i % 2000 < 1400;
    ASSERT_EQ(p.ways[0].shown[i], out ? ProfilePreviewDirection::kLost : 10'000) << i;
  }
  EXPECT_EQ(p.quality.up.lost, 2000U);
  EXPECT_EQ(p.quality.up.longest_gap, 401ms);
}

TEST(ProfilePreview, MeasuresQuantilesLikeTheProfileChecks) {
  const auto profile = shipped_profile("wifi-busy");
  ASSERT_TRUE(profile);
  const ProfilePreview p = preview_profile({.link = profile->link, .length = 60s});
  Path path{profile->link.down, Path::key_for(1, 0, Direction::kDown)};
  auto all = delays(decisions(path, 60'000));
  std::sort(all.begin(), all.end());
  ASSERT_EQ(p.ways[1].delays.size(), all.size());
  for (const double q : {0.05, 0.5, 0.95, 0.99}) {
    const double expected = all[static_cast<std::size_t>(q * static_cast<double>(all.size() - 1))];
    EXPECT_EQ(static_cast<double>(p.ways[1].quantile(q).count()), expected);
  }
}

TEST(ProfilePreview, ReportsItsProgressAndShowsOnlyItsLength) {
  std::vector<double> told;
  const ProfilePreview p = preview_profile({.link = {}, .length = 45s, .shown = 60s}, [&](double s) {
    told.push_back(s);
    return true;
  });
  EXPECT_EQ(p.shown, 45s);
  EXPECT_EQ(told, (std::vector<double>{0, 20.0 / 45, 40.0 / 45}));
}

TEST(ProfilePreview, EndsEarlyOnRequestAndCoversWhatItPlayed) {
  for (const std::size_t looks : {1u, 3u}) {
    std::size_t told = 0;
    const ProfilePreview p =
        preview_profile({.link = {}, .length = 100s, .shown = 60s}, [&](double) { return ++told < looks; });
    EXPECT_EQ(told, looks);
    EXPECT_EQ(p.length, looks == 1 ? 1ms : 40'001ms);
    EXPECT_EQ(p.shown, p.length);
    for (const ProfilePreviewDirection& way : p.ways) {
      EXPECT_EQ(way.delays.size(), static_cast<std::size_t>(p.length / 1ms));
      EXPECT_EQ(way.shown.size(), way.delays.size());
    }
  }
}

/// Returns 60 columns of 100 datagrams with 10 ms, except columns 30 to 33: 100 ms; half lost; all lost; one lost.
ProfilePreviewDirection drawn() {
  ProfilePreviewDirection way;
  for (int i = 0; i < 6000; ++i) {
    std::int32_t us = 10'000;
    if (i >= 3000 && i < 3100) us = 100'000;
    if (i >= 3100 && i < 3200 && i % 2 == 0) us = ProfilePreviewDirection::kLost;
    if (i >= 3200 && i < 3300) us = ProfilePreviewDirection::kLost;
    if (i == 3350) us = ProfilePreviewDirection::kLost;
    way.shown.push_back(us);
    if (us >= 0) way.delays.push_back(1us * us);
  }
  std::sort(way.delays.begin(), way.delays.end());
  return way;
}

TEST(ProfilePreview, DrawsDarkWhereTheDatagramsAre) {
  const std::string text = delay_picture(drawn(), 6s, {.width = 72, .utf8 = false});
  const auto lines = lines_of(text);
  ASSERT_EQ(lines.size(), 12U + 2 + 2) << text;
  const std::string margin(11, ' ');
  EXPECT_EQ(lines[0], "   100 ms |" + std::string(30, ' ') + "#");
  for (int row = 1; row < 11; ++row) EXPECT_EQ(lines[static_cast<std::size_t>(row)].substr(10), "|") << row;
  // Column 31 has half of its datagrams, which is dark; 32 has none; 33 has all but one.
  EXPECT_EQ(lines[11], "  10.0 ms |" + std::string(30, '#') + " # " + std::string(27, '#'));
  // Every 2 s: columns 0, 20, 39 and 59.
  EXPECT_EQ(lines[12], "          ++-------------------+------------------+-------------------+");
  EXPECT_EQ(lines[13], "           0 s                 2 s                4 s                 6 s");
  EXPECT_EQ(lines[14], "     lost  " + std::string(31, ' ') + "##:");
}

TEST(ProfilePreview, DrawsAConstantDelayAsOneLineInUtf8) {
  const auto plain = lines_of(delay_picture(drawn(), 6s, {.width = 72, .utf8 = false}));
  const auto fine = lines_of(delay_picture(drawn(), 6s, {.width = 72, .utf8 = true}));
  ASSERT_EQ(plain.size(), fine.size());
  for (std::size_t i = 0; i + 1 < plain.size(); ++i) {
    std::size_t width = 0;
    for (const char c : fine[i]) width += (static_cast<unsigned char>(c) & 0xC0U) != 0x80U ? 1 : 0;
    EXPECT_EQ(width, plain[i].size()) << fine[i];
  }
  ProfilePreviewDirection constant;
  constant.shown.assign(3000, 20'000);
  const std::string text = delay_picture(constant, 3s, {.width = 72, .utf8 = false});
  EXPECT_EQ(count(text, "####"), 60U / 4) << text;
  ProfilePreviewDirection lost;
  lost.shown.assign(3000, ProfilePreviewDirection::kLost);
  EXPECT_EQ(count(delay_picture(lost, 3s, {.width = 72, .utf8 = false}), "####"), 60U / 4);
}

TEST(ProfilePreview, HistogramAddsUpToEverything) {
  const std::string text = delay_histogram(drawn(), {.width = 72, .utf8 = false});
  const auto lines = lines_of(text);
  ASSERT_EQ(lines.size(), 12U) << text;
  EXPECT_NE(lines.front().find("98 %"), std::string::npos) << text;
  EXPECT_NE(lines.back().find("to 100 ms"), std::string::npos) << text;
  EXPECT_NE(lines.back().find("100 %"), std::string::npos) << text;
  EXPECT_EQ(delay_histogram(ProfilePreviewDirection{}, {.width = 72, .utf8 = false}), "           nothing arrived\n");
}

TEST(ProfilePreview, FigureShadesOutagesAndMarksEveryLoss) {
  ProfilePreview p;
  p.length = p.shown = 6s;
  p.ways = {drawn(), drawn()};
  const plot::Figure figure =
      profile_preview_figure(p, "a < b", {{Direction::kUp, 0.99, 12.0}, {Direction::kUp, 0.05, 9.0}});
  ASSERT_EQ(figure.panels.size(), 3U);
  ASSERT_EQ(figure.panels[0].bands.size(), 1U) << "lost for 5 ms and more";
  EXPECT_DOUBLE_EQ(figure.panels[0].bands[0].from, 3.2);
  EXPECT_DOUBLE_EQ(figure.panels[0].bands[0].to, 3.3);
  EXPECT_EQ(figure.panels[0].rug.size(), 50U + 1 + 1);
  EXPECT_EQ(figure.panels[2].notes.size(), 1U) << "values below the median are drawn at the edge";
  EXPECT_DOUBLE_EQ(figure.panels[2].notes[0].at.x, 2);
  const std::string svg = plot::to_svg_file(figure);
  EXPECT_TRUE(svg.starts_with("<?xml"));
  EXPECT_NE(svg.find("a &lt; b"), std::string::npos);
  EXPECT_EQ(count(svg, "<style>"), 1U);
  EXPECT_EQ(count(svg, "<svg"), count(svg, "</svg>"));
  EXPECT_EQ(count(svg, "class=\"band\""), 2U);
  // Losses 2 ms apart are one pixel at 1004 pixels for 6 s: marks merge, but none is omitted.
  EXPECT_GE(count(svg, "class=\"rug\""), 4U);
  EXPECT_EQ(count(svg, "nan"), 0U);
}

}  // namespace
}  // namespace tandem::netsim
