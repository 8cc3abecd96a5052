#include "netsim/models/distributions.h"

#include <gtest/gtest.h>

#include <cmath>

namespace tandem::netsim {
namespace {

TEST(Distributions, NormalMatchesTables) {
  EXPECT_DOUBLE_EQ(normal_quantile(0.5), 0);
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_NEAR(normal_quantile(0.999), 3.090232306167814, 1e-13);
  EXPECT_NEAR(normal_quantile(1e-10), -6.361340902404056, 1e-12);
}

TEST(Distributions, InvertTheNormalDistributionInEveryBranch) {
  for (double z = -8; z <= 8; z += 0.01) {
    const double u = normal_cdf(z);
    // Near 1, double precision cannot distinguish quantiles.
    if (u >= 1 - 1e-9) break;
    EXPECT_NEAR(normal_quantile(u), z, 1e-6) << z;
  }
}

TEST(Distributions, AreFiniteAtBothEndsOfTheGenerator) {
  for (const double u : {0.0, 0x1.0p-53, 1 - 0x1.0p-53}) {
    const double open = open_unit(u);
    EXPECT_TRUE(std::isfinite(normal_quantile(open))) << u;
    EXPECT_TRUE(std::isfinite(log_logistic_quantile(std::min(open, 1 - 0x1.0p-53), 0.5))) << u;
    EXPECT_TRUE(std::isfinite(exponential_quantile(u))) << u;
    EXPECT_TRUE(std::isfinite(pareto_quantile(u, 0.5))) << u;
  }
}

TEST(Distributions, MatchHandComputedQuantiles) {
  EXPECT_NEAR(exponential_quantile(0.5), std::log(2), 1e-15);
  EXPECT_NEAR(pareto_quantile(0.75, 2), 2, 1e-14);
  EXPECT_DOUBLE_EQ(pareto_quantile(0, 1.5), 1);
  EXPECT_DOUBLE_EQ(log_normal_at(0, 0.75), 1);
  EXPECT_NEAR(log_logistic_quantile(0.9, 2), 3, 1e-14);  // (0.9 / 0.1)^(1/2)
  EXPECT_NEAR(log_logistic_at(normal_quantile(0.9), 2), 3, 1e-12);
}

}  // namespace
}  // namespace tandem::netsim
