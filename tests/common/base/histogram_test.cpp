#include "common/base/histogram.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include "common/base/rng.h"

namespace tandem {
namespace {

TEST(Histogram, IsZeroWhenEmpty) {
  const Histogram h;
  EXPECT_EQ(h.count(), 0U);
  EXPECT_EQ(h.quantile(0.5), 0);
  EXPECT_EQ(h.max(), 0);
}

TEST(Histogram, IsExactForSmallValues) {
  Histogram h;
  for (int ns = 0; ns < 60; ++ns) h.add(ns);
  EXPECT_EQ(h.quantile(0), 0);
  EXPECT_EQ(h.quantile(0.5), 29);
  EXPECT_EQ(h.quantile(1), 59);
}

TEST(Histogram, QuantilesAreAtMostThreePercentHigh) {
  RandomStream random{3};
  std::vector<std::int64_t> values;
  Histogram h;
  for (int i = 0; i < 20'000; ++i) {
    const auto value = static_cast<std::int64_t>(random.bits() >> (1 + random.below(62)));
    values.push_back(value);
    h.add(value);
  }
  std::sort(values.begin(), values.end());
  for (const double q : {0.001, 0.1, 0.5, 0.9, 0.99, 0.999}) {
    const auto exact = static_cast<double>(values[static_cast<std::size_t>(std::ceil(q * 20'000)) - 1]);
    EXPECT_GE(static_cast<double>(h.quantile(q)), exact) << q;
    EXPECT_LE(static_cast<double>(h.quantile(q)), exact * (1 + 1.0 / 32) + 1) << q;
  }
  EXPECT_EQ(h.quantile(1), values.back());
  EXPECT_EQ(h.max(), values.back());
}

TEST(Histogram, QuantileIsThatOfASumOverSingleBins) {
  for (const std::uint64_t seed : {1, 2, 3, 4, 5, 6, 7, 8}) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    std::array<std::uint64_t, LogScale::kBins> bins{};
    Histogram h;
    for (std::uint64_t i = 0, n = 1 + random.below(300); i < n; ++i) {
      const std::uint64_t value = random.bits() >> (1 + random.below(62));
      ++bins[LogScale::bin_of(value)];
      h.add(static_cast<std::int64_t>(value));
    }
    for (const double q : {0.0, 0.01, 0.25, 0.5, 0.75, 0.99, 1.0}) {
      std::uint64_t below = 0;
      std::size_t bin = 0;
      while ((below += bins[bin]) == 0 || static_cast<double>(below) < q * static_cast<double>(h.count())) ++bin;
      EXPECT_EQ(h.quantile(q), std::min(LogScale::last_of(bin), h.max())) << q;
    }
  }
}

TEST(Histogram, TakesTheWholeRange) {
  Histogram h;
  h.add(std::numeric_limits<std::int64_t>::max());
  h.add(std::numeric_limits<std::int64_t>::min());  // a negative value counts as 0
  EXPECT_EQ(h.quantile(0.5), 0);
  EXPECT_EQ(h.quantile(1), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(h.quantile(-1), 0);
  EXPECT_EQ(h.quantile(2), std::numeric_limits<std::int64_t>::max());
  EXPECT_EQ(h.quantile(std::numeric_limits<double>::quiet_NaN()), 0);
}

TEST(Histogram, HasContiguousBins) {
  // Neighbouring powers of two and their neighbours fall into ascending quantiles.
  for (int bit = 1; bit < 62; ++bit) {
    const std::int64_t value = std::int64_t{1} << bit;
    for (const std::int64_t v : {value - 1, value, value + 1}) {
      Histogram h;
      h.add(v);
      h.add(std::numeric_limits<std::int64_t>::max());
      EXPECT_GE(h.quantile(0.5), v);
      EXPECT_LE(static_cast<double>(h.quantile(0.5)), static_cast<double>(v) * (1 + 1.0 / 32)) << v;
    }
  }
}

TEST(Histogram, HoldsEveryValueInOneOfContiguousBuckets) {
  Histogram h;
  for (std::int64_t v = 0; v < 3'000'000; v += 997) h.add(v);
  h.add(std::numeric_limits<std::int64_t>::max());
  std::uint64_t held = 0;
  std::int64_t before = -1;
  h.each_bucket([&](std::int64_t first, std::int64_t last, std::uint64_t count) {
    EXPECT_GT(first, before);
    EXPECT_GE(last, first);
    if (first >= 64) {
      EXPECT_LE(static_cast<double>(last - first), 0.25 * static_cast<double>(first)) << first;
    }
    held += count;
    before = last;
  });
  EXPECT_EQ(held, h.count());
  EXPECT_EQ(before, std::numeric_limits<std::int64_t>::max());
  Histogram one;
  one.add(1'000'000);  // 2^19 * 1.907: the last quarter of its octave, 7/8 of 2^20 to 2^20 - 1
  one.each_bucket([](std::int64_t first, std::int64_t last, std::uint64_t count) {
    EXPECT_EQ(first, 917'504);
    EXPECT_EQ(last, 1'048'575);
    EXPECT_EQ(count, 1u);
  });
}

TEST(Histogram, OfALinkHasTheSameQuantilesInLessMemory) {
  static_assert(4 * sizeof(ShortLinkHistogram) < sizeof(Histogram) && 3 * sizeof(LinkHistogram) < sizeof(Histogram));
  RandomStream random{9};
  Histogram whole;
  LinkHistogram link;
  ShortLinkHistogram brief;
  for (int i = 0; i < 20'000; ++i) {
    const auto ns = static_cast<std::int64_t>(random.bits() >> (25 + random.below(39)));
    whole.add(ns);
    link.add(ns);
    brief.add(ns);
  }
  for (const double q : {0.0, 0.01, 0.25, 0.5, 0.75, 0.99, 1.0}) {
    EXPECT_EQ(link.quantile(q), whole.quantile(q)) << q;
    EXPECT_EQ(brief.quantile(q), whole.quantile(q)) << q;
  }
  const std::int64_t hour = 3'600'000'000'000;
  link.add(hour);
  EXPECT_EQ(link.quantile(1), hour) << "beyond its bins";
  EXPECT_EQ(link.count(), 20'001U);
}

TEST(Histogram, KeepsItsQuantilesWhenABinIsFull) {
  ShortLinkHistogram h, other;
  for (int i = 0; i < 400'000; ++i) h.add(i % 100 < 99 ? 10 : 50);
  EXPECT_EQ(h.count(), 400'000U);
  EXPECT_EQ(h.quantile(0.5), 10);
  EXPECT_EQ(h.quantile(0.98), 10);
  EXPECT_EQ(h.quantile(0.995), 50);
  for (int i = 0; i < 60'000; ++i) other.add(50);
  h.merge(other);
  EXPECT_EQ(h.count(), 460'000U);
  EXPECT_EQ(h.quantile(0.01), 10);
  EXPECT_EQ(h.quantile(1), 50);
}

TEST(Histogram, MergesLikeDirectAdding) {
  Histogram a, b, both;
  for (int i = 0; i < 1000; ++i) {
    (i % 3 == 0 ? a : b).add(i * 977);
    both.add(i * 977);
  }
  a.merge(b);
  EXPECT_EQ(a.count(), both.count());
  EXPECT_EQ(a.quantile(0.37), both.quantile(0.37));
  EXPECT_EQ(a.max(), both.max());
  a.reset();
  EXPECT_EQ(a.count(), 0U);
}

}  // namespace
}  // namespace tandem
