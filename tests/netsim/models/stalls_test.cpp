#include "netsim/models/stalls.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Stalls of exactly 80 ms: the Pareto distribution is capped at its minimum.
constexpr StallSpec kEighty{.rate_per_s = 0.5, .length_min = 80ms, .alpha = 1, .cap = 80ms};

/// Returns the start of the first stall after `t`, to the nanosecond.
Time next_start(Stalls& stalls, Time t) {
  while (stalls.release(t) == t) t += 1ms;
  Time lo = t - 1ms, hi = t;
  while (hi - lo > 1ns) {
    const Time mid = lo + (hi - lo) / 2;
    (stalls.release(mid) == mid ? lo : hi) = mid;
  }
  return hi;
}

TEST(Stalls, HoldForTheirLengthAndReleaseAtOneInstant) {
  PathSpec spec;
  spec.stall = kEighty;
  Path path = path_of(spec, 5);
  const auto all = decisions(path, 20'000);
  // Groups by release: a stall of 80 ms at 1 kHz releases exactly the 80 datagrams sent during it. Groups of 82 or more
  // come from two overlapping stalls. Delays decrease by 1 ms.
  std::size_t stalls_seen = 0;
  for (std::size_t i = 1; i < all.size();) {
    const Time sent{1ms * static_cast<std::int64_t>(i)};
    if (all[i].at == sent) {
      ++i;
      continue;
    }
    ++stalls_seen;
    std::size_t together = 0;
    const Time end = all[i].at;
    for (; i < all.size() && all[i].at == end; ++i, ++together) {
      ASSERT_EQ(all[i].at - Time{1ms * static_cast<std::int64_t>(i)},
                end - sent - 1ms * static_cast<std::int64_t>(together));
    }
    ASSERT_TRUE(together == 80 || together > 80 || i == all.size()) << together;
  }
  EXPECT_GT(stalls_seen, 3U);
}

TEST(Stalls, EndIsStartPlusLength) {
  Stalls stalls{kEighty, RandomKey{8}};
  Time t{};
  for (int i = 0; i < 100; ++i) {
    const Time start = next_start(stalls, t);
    const Time end = stalls.release(start);
    ASSERT_GE(end - start, 80ms);
    ASSERT_EQ(stalls.release(start + 79ms), end);
    ASSERT_EQ(stalls.release(end), end);
    ASSERT_EQ(stalls.release(start + 80ms - 1ns), end);
    t = end;
  }
}

TEST(Stalls, BeginAsAPoissonProcess) {
  const StallSpec spec{.rate_per_s = 2, .length_min = 1us, .alpha = 100, .cap = 1us};
  Stalls stalls{spec, RandomKey{9}};
  std::vector<double> gaps;
  // Finds such short stalls by steps of their own length.
  Time last{};
  for (Time t{}; t < Time{60s}; t += 1us) {
    if (stalls.release(t) == t) continue;
    gaps.push_back(seconds(t - last));
    last = t;
    t += 1us;
  }
  EXPECT_NEAR(static_cast<double>(gaps.size()), 120, 5 * std::sqrt(120.0));
  EXPECT_LT(ks_distance(gaps, [](double x) { return 1 - std::exp(-2 * x); }),
            2.7 / std::sqrt(static_cast<double>(gaps.size())));
}

TEST(Stalls, LengthsArePareto) {
  const StallSpec spec{.rate_per_s = 0.05, .length_min = 10ms, .alpha = 1.5, .cap = 2s};
  Stalls stalls{spec, RandomKey{10}};
  std::vector<double> lengths;
  Time t{};
  for (int i = 0; i < 300; ++i) {
    while (stalls.release(t) == t) t += 5ms;  // the step is shorter than every stall
    Time start = t - 5ms, inside = t;
    while (inside - start > 1us) {
      const Time mid = start + (inside - start) / 2;
      (stalls.release(mid) == mid ? start : inside) = mid;
    }
    lengths.push_back(seconds(stalls.release(t) - inside));
    t = stalls.release(t);
  }
  const auto pareto = [](double x) { return x < 0.01 ? 0 : x >= 2 ? 1 : 1 - std::pow(0.01 / x, 1.5); };
  EXPECT_LT(ks_distance(lengths, pareto), 2.7 / std::sqrt(300.0));
}

TEST(Stalls, AreIndependentOfTheOrderOfQueries) {
  const StallSpec spec{.rate_per_s = 5, .length_min = 20ms, .alpha = 1.2, .cap = 400ms};
  Stalls forward{spec, RandomKey{11}}, backward{spec, RandomKey{11}};
  std::vector<Time> ends;
  for (int i = 0; i < 20'000; ++i) ends.push_back(forward.release(Time{i * 1ms}));
  for (int i = 19'999; i >= 0; --i) ASSERT_EQ(backward.release(Time{i * 1ms}), ends[static_cast<std::size_t>(i)]);
}

}  // namespace
}  // namespace tandem::netsim
