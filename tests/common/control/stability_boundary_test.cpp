#include <gtest/gtest.h>

#include "tests/common/control/stability_rows.h"

/// Stability limits by bisection of simulated motion against eigenvalues of matrices that the test writes down itself.
/// The step of the last bisection is below 2 %.
namespace tandem::test {
namespace {

void expect_exact(const std::vector<StabilityRow>& rows, double least = 0.95, double most = 1.05) {
  for (const StabilityRow& row : rows) {
    print(row);
    EXPECT_GE(row.experiment, least * row.exact) << row.family << ": " << row.loop;
    EXPECT_LE(row.experiment, most * row.exact) << row.family << ": " << row.loop;
  }
}

TEST(StabilityBoundary, OfASpringOnASampledDeviceIsThatOfColgateAndSchenkel) {
  const auto rows = colgate_schenkel_rows();
  expect_exact(rows);
}

TEST(StabilityBoundary, OfALateSpringIsThatOfGilAndHulin) {
  const auto rows = gil_hulin_rows();
  expect_exact(rows);
  for (const StabilityRow& row : rows) EXPECT_NEAR(row.experiment, row.closed_form, 0.05 * row.closed_form) << row.loop;
}

TEST(StabilityBoundary, WithFrictionIsThatOfDiolaiti) {
  const auto rows = diolaiti_rows();
  expect_exact(rows, 0.9, 1.1);
  for (const StabilityRow& row : rows) EXPECT_GE(row.experiment, row.closed_form) << "the passive velocity is less";
}

TEST(StabilityBoundary, OfPositionsOverADelayIsThatOfPPlusD) {
  const auto rows = p_plus_d_rows();
  expect_exact(rows);
  for (const StabilityRow& row : rows) EXPECT_GE(row.experiment, row.closed_form) << "P+d is sufficient";
}

TEST(StabilityBoundary, OfReplicaOnASurfaceIsThatOfItsOwnSpring) {
  const auto rows = replica_rows();
  expect_exact(rows);
}

// The springs of a hand under `pd_peer` add up: the limit of the spring of a pair falls as 1 / (n - 1).
TEST(PeerGrowth, LimitsTheSpringOfAPairByTheNumberOfHands) {
  const auto rows = peer_rows();
  expect_exact(rows);
  const double whole = rows[0].exact;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const double springs = std::vector<double>{1, 2, 3, 5, 7}[i];
    EXPECT_NEAR(rows[i].exact * springs, whole, 0.02 * whole) << rows[i].loop;
  }
}

}  // namespace
}  // namespace tandem::test
