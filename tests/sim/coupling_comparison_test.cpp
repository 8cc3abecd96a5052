// The default beside the couplings of shared haptic environments, for 2 to 8 hands over delay, in whole sessions.
#include <gtest/gtest.h>

#include <cstdio>
#include <string>
#include <vector>

#include "tests/common/base/counts.h"
#include "tests/sim/coupling_cell.h"

namespace tandem::test {
namespace {

/// Cells in which the default may be worse by more than a tenth. ARCHITECTURE.md, "Beside the couplings of shared
/// haptic environments", says why.
bool named(const Measure& measure, double delay_ms) {
  if (measure.name == "unrest") return true;
  return measure.name == "following" && delay_ms >= 500;
}

TEST(CouplingComparison, TheDefaultBeatsPeersAndAverageExceptInNamedCells) {
  const bool full = draws(0, 1, 1) == 1;
  const std::vector<std::size_t> hands = full ? std::vector<std::size_t>{2, 3, 5, 8} : std::vector<std::size_t>{2, 4};
  const std::vector<double> delays = full ? std::vector<double>{0, 20, 100, 200, 500} : std::vector<double>{20, 500};
  const std::uint64_t seeds = draws(1, 3, 20);
  for (const std::size_t n : hands) {
    for (const double delay_ms : delays) {
      const Cell own = average_cell(kDefault, n, delay_ms, seeds);
      EXPECT_EQ(own.unstable, 0) << n << " hands, " << delay_ms << " ms";
      for (const Contender& other : {kPeer, kAverage}) {
        const Cell theirs = average_cell(other, n, delay_ms, seeds);
        for (const Measure& m : kMeasures) {
          if (!loses(m, own, theirs)) continue;
          const std::string where = std::to_string(n) + " hands, " + std::to_string(static_cast<int>(delay_ms)) +
                                    " ms, " + std::string(m.name);
          std::printf("[  named   ] %s: %.3g, %s %.3g %s\n", where.c_str(), m.scale * own.*m.value, other.name.data(),
                      m.scale * theirs.*m.value, m.unit.data());
          EXPECT_TRUE(named(m, delay_ms)) << where << " against " << other.name;
        }
      }
    }
  }
}

// The comparison can fail: against itself with less damping it names the difference, and a tenth counts as none.
TEST(CouplingComparison, NamesADifferenceOfMoreThanATenth) {
  const Cell own{.tracking = 0.0112, .stiffness = 89}, other{.tracking = 0.01, .stiffness = 100};
  EXPECT_TRUE(loses(kMeasures[0], own, other));
  EXPECT_FALSE(loses(kMeasures[0], other, own));
  EXPECT_TRUE(loses(kMeasures[3], own, other)) << "more is better";
  EXPECT_FALSE(loses(kMeasures[0], {.tracking = 0.0109}, other));
}

// Springs between all pairs of hands: each hand has n - 1 of them, so the loop over the network is as stiff as k (n -
// 1). `PeerGrowth.*` computes the boundary; here whole sessions with devices, gates and friction meet it.
TEST(CouplingComparison, PeersBecomeUnstableAsTheirNumberGrows) {
  for (const std::size_t n : {2, 4}) EXPECT_FALSE(run_raw_peers(n, 10, 80, 1).unstable()) << n << " hands";
  EXPECT_TRUE(run_raw_peers(7, 10, 80, 1).unstable());
  EXPECT_FALSE(run_raw_peers(7, 10, 30, 1).unstable()) << "the same hands on softer springs";
}

}  // namespace
}  // namespace tandem::test
