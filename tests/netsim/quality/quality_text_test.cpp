#include "netsim/quality/quality_text.h"

#include <gtest/gtest.h>

#include "tests/netsim/quality/quality_support.h"

namespace tandem::netsim {
namespace {

using namespace test;

WindowSummaries seconds_in(std::uint64_t green, std::uint64_t amber, std::uint64_t red) {
  WindowSummaries all;
  for (std::size_t w = 0; w < kWindows; ++w) all[w].length = window_length(w);
  all[1].bands = {green, amber, red};
  all[1].windows = green + amber + red;
  return all;
}

TEST(QualityText, RequiresNinetyNineOfAHundredSecondsForAVerdict) {
  EXPECT_EQ(verdict(seconds_in(99, 1, 0)), Band::kGreen);
  EXPECT_EQ(verdict(seconds_in(99, 0, 1)), Band::kGreen);
  EXPECT_EQ(verdict(seconds_in(98, 2, 0)), Band::kAmber);
  EXPECT_EQ(verdict(seconds_in(98, 1, 1)), Band::kAmber);
  EXPECT_EQ(verdict(seconds_in(98, 0, 2)), Band::kRed);
  EXPECT_EQ(verdict(seconds_in(0, 0, 0)), std::nullopt);
  auto brief = seconds_in(0, 0, 0);
  brief[0].bands = {0, 5, 0};
  brief[0].windows = 5;
  EXPECT_EQ(verdict(brief), Band::kAmber) << "shorter than a second: judged by its tenths";
  LinkSummary link;
  link.up.windows = seconds_in(100, 0, 0);
  EXPECT_EQ(verdict(link), Band::kGreen) << "a link that was too short has no verdict";
  link.round_trip.windows = seconds_in(0, 0, 100);
  EXPECT_EQ(verdict(link), Band::kRed);
}

TEST(QualityText, OrdersByVerdictThenByShare) {
  const auto with = [](std::uint64_t green, std::uint64_t amber, std::uint64_t red) {
    LinkSummary link;
    link.up.windows = seconds_in(green, amber, red);
    return badness(link);
  };
  EXPECT_EQ(with(0, 0, 0), 0) << "nothing was judged";
  const double order[] = {0,
                          with(100, 0, 0),
                          with(99, 0, 1),
                          with(98, 2, 0),
                          with(50, 50, 0),
                          with(98, 1, 1),
                          with(98, 0, 2),
                          with(0, 0, 100)};
  for (std::size_t i = 1; i < std::size(order); ++i) EXPECT_LT(order[i - 1], order[i]) << i;
}

TEST(QualityText, NamesTheCauseAndTheTime) {
  auto all = regular(60'001, 2ms);
  for (std::size_t i = 30'000; i < 30'120; ++i) all[i].delays = {};
  LinkSummary link;
  link.up = judged(all).summary();
  link.down = judged(regular(60'001, 2ms)).summary();
  const std::string text = quality_text(link, "");
  EXPECT_NE(text.find("up: red; "), std::string::npos) << text;
  EXPECT_NE(text.find("\n  worst: 12 % lost in the second to 30.12 s (100 % in 100 ms), 0.20 % in all; "
                      "nothing received for 121 ms from 30.00 s\n"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("down: green; all of its seconds are green\n"), std::string::npos) << text;
  EXPECT_NE(text.find("round trip: too short to judge\n"), std::string::npos) << text;
}

TEST(QualityText, ListsTheWorstFirstAndTheOthersByName) {
  LinkSummary good, bad, worse;
  good.up.windows = seconds_in(100, 0, 0);
  bad.up.windows = seconds_in(0, 97, 3);
  worse.up.windows = seconds_in(0, 90, 10);
  for (LinkSummary* link : {&good, &bad, &worse}) link->up.sent = 100;
  const std::string text = quality_report({{"anna", good}, {"bert", bad}, {"cleo", worse}}, false);
  EXPECT_TRUE(text.starts_with("  network of cleo: red")) << text;
  EXPECT_NE(text.find("    others: bert red, anna green\n"), std::string::npos) << text;
  EXPECT_EQ(text.find("windows of"), std::string::npos) << "numbers only when asked for";
  const std::string all = quality_report({{"anna", good}, {"bert", bad}, {"cleo", worse}}, true);
  EXPECT_LT(all.find("cleo"), all.find("bert"));
  EXPECT_LT(all.find("bert"), all.find("anna"));
  EXPECT_NE(all.find("windows of"), std::string::npos);
  EXPECT_EQ(quality_report({{"anna", good}, {"bert", good}}, false),
            "  network: green for all links, usable for stiff contact and fast motion\n");
  EXPECT_EQ(quality_report({{"anna", LinkSummary{}}}, false), "  network: too short to judge\n");
  EXPECT_EQ(quality_report({}, true), "");
}

TEST(QualityText, NeverRoundsSharesToNoneOrAll) {
  EXPECT_EQ(share_text(0), "0 %");
  EXPECT_EQ(share_text(1e-9), "<0.001 %");
  EXPECT_EQ(share_text(0.00083), "0.083 %");
  EXPECT_EQ(share_text(0.0083), "0.83 %");
  EXPECT_EQ(share_text(0.017), "1.7 %");
  EXPECT_EQ(share_text(0.41), "41 %");
  EXPECT_EQ(share_text(0.9996), ">99.9 %");
  EXPECT_EQ(share_text(0.996), "99.6 %");
  EXPECT_EQ(share_text(1), "100 %");
  EXPECT_EQ(delay_text(0.00007), "0.07 ms");
  EXPECT_EQ(delay_text(0.00825), "8.25 ms");
  EXPECT_EQ(delay_text(0.0615), "61.5 ms");
  EXPECT_EQ(delay_text(0.4104), "410 ms");
  EXPECT_EQ(delay_text(12.34), "12.3 s");
}

}  // namespace
}  // namespace tandem::netsim
