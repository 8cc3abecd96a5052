#include "common/transport/replay_window.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::transport {
namespace {

using Verdict = ReplayWindow::Verdict;

/// Reference implementation that remembers every counter.
struct Naive {
  std::set<std::uint64_t> seen;
  Verdict note(std::uint64_t c) {
    if (seen.empty() || c > *seen.rbegin()) {
      seen.insert(c);
      return Verdict::kNewer;
    }
    if (*seen.rbegin() - c >= 1024) return Verdict::kTooOld;
    return seen.insert(c).second ? Verdict::kLate : Verdict::kDuplicate;
  }
};

TEST(ReplayWindow, MatchesAWindowOfUnlimitedSize) {
  constexpr std::uint64_t kEnd = ~std::uint64_t{0};
  const std::uint64_t last = test::seeds(60);
  for (std::uint64_t seed = 1; seed <= last; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    ReplayWindow window;
    Naive naive;
    std::uint64_t now = seed % 3 == 0 ? kEnd - 3000 : seed % 3 == 1 ? 0 : random.bits() / 2;
    for (int i = 0; i < 4000; ++i) {
      switch (random.below(40)) {
        case 0:
          now += std::min<std::uint64_t>(random.below(2500), kEnd - now);
          break;
        case 1:
          now += std::min<std::uint64_t>(1023 + random.below(3), kEnd - now);
          break;
        default:
          now += std::min<std::uint64_t>(random.below(3), kEnd - now);
      }
      const std::uint64_t back = random.below(3) == 0 ? random.below(1100) : random.below(4);
      const std::uint64_t c = now - std::min(now, back);
      const Verdict judged = window.check(c), noted = window.record(c);
      ASSERT_EQ(judged, noted) << i;
      ASSERT_EQ(noted, naive.note(c)) << i << ": " << c;
      ASSERT_EQ(window.newest(), *naive.seen.rbegin());
    }
  }
}

TEST(ReplayWindow, WorksAtTheLastCounter) {
  constexpr std::uint64_t kEnd = ~std::uint64_t{0};
  ReplayWindow window;
  EXPECT_EQ(window.record(kEnd), Verdict::kNewer);
  EXPECT_EQ(window.record(kEnd), Verdict::kDuplicate);
  EXPECT_EQ(window.record(kEnd - 1023), Verdict::kLate);
  EXPECT_EQ(window.record(kEnd - 1024), Verdict::kTooOld);
  EXPECT_EQ(window.record(0), Verdict::kTooOld);
}

TEST(ReplayWindow, ChecksWithoutSideEffect) {
  ReplayWindow window;
  EXPECT_EQ(window.check(5), Verdict::kNewer);
  EXPECT_FALSE(window.any());
  window.record(5);
  EXPECT_EQ(window.check(9), Verdict::kNewer);
  EXPECT_EQ(window.newest(), 5U);
}

}  // namespace
}  // namespace tandem::transport
