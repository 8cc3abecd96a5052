#include "client/app/device_statistics.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace tandem::client {
namespace {

TEST(DeviceStatistics, GiveBucketsThatHoldEveryExchange) {
  hal::DeviceStats stats;
  stats.ticks = 1000;
  stats.missed = 2, stats.resyncs = 3, stats.unanswered = 4, stats.late = 5;
  hal::DeviceHistograms histograms;
  for (int i = 0; i < 999; ++i) histograms.period.add(1'000'000);
  histograms.period.add(40'000'000);
  const auto j = to_json(stats, histograms);
  EXPECT_EQ(j["missed_periods"], 2);
  EXPECT_EQ(j["resyncs"], 3);
  EXPECT_EQ(j["unanswered"], 4);
  EXPECT_EQ(j["late"], 5);
  ASSERT_EQ(j["period_ms"]["buckets"].size(), 2u);
  // 1 ms is in the last quarter of the octave that ends at 2^20 ns.
  EXPECT_DOUBLE_EQ(j["period_ms"]["buckets"][0]["from"].get<double>(), 0.917504);
  EXPECT_DOUBLE_EQ(j["period_ms"]["buckets"][0]["to"].get<double>(), 1.048576);
  EXPECT_EQ(j["period_ms"]["buckets"][0]["count"], 999);
  EXPECT_DOUBLE_EQ(j["period_ms"]["max"].get<double>(), 40);
  EXPECT_TRUE(j["round_trip_ms"].is_null());
  const auto lines = summary(stats, histograms);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_EQ(lines[0], "device: 1000 exchanges, 5 late by more than 1 ms, 2 periods missed, 4 unanswered, 3 resyncs");
  EXPECT_EQ(lines[1].find("period: p50 "), 0u) << lines[1];
  EXPECT_TRUE(lines[1].ends_with("max 40.000 ms")) << "buckets are for the JSON: " << lines[1];
}

TEST(DeviceStatistics, KeepTheTextToOneShortLineForAnyNumberOfBuckets) {
  hal::DeviceHistograms histograms;
  for (int i = 0; i < 99'990; ++i) histograms.round_trip.add(300'000);
  for (int i = 0; i < 10; ++i) histograms.round_trip.add(1'000'000 << i);
  EXPECT_GT(to_json({}, histograms)["round_trip_ms"]["buckets"].size(), 8u);
  const auto lines = summary({}, histograms);
  ASSERT_EQ(lines.size(), 2u);
  EXPECT_LT(lines[1].size(), 80u) << lines[1];
}

}  // namespace
}  // namespace tandem::client
