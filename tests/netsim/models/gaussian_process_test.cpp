#include "netsim/models/gaussian_process.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

#include "netsim/models/distributions.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

TEST(GaussianProcess, IsAFunctionOfTimeForAnyOrderOfQueries) {
  for (const Duration tau : {Duration{10us}, Duration{1ms}, Duration{80ms}, Duration{10s}}) {
    GaussianProcess forward{tau, RandomKey{5}};
    std::vector<double> values;
    for (int i = 0; i < 5000; ++i) values.push_back(forward.at(Time{i * 370us}));
    GaussianProcess backward{tau, RandomKey{5}};
    for (int i = 4999; i >= 0; --i) ASSERT_EQ(backward.at(Time{i * 370us}), values[static_cast<std::size_t>(i)]) << i;
    GaussianProcess sparse{tau, RandomKey{5}};
    for (int i = 0; i < 5000; i += 17) ASSERT_EQ(sparse.at(Time{i * 370us}), values[static_cast<std::size_t>(i)]) << i;
  }
}

TEST(GaussianProcess, IsStandardNormalAtTimesFarApart) {
  GaussianProcess process{5ms, RandomKey{11}};
  std::vector<double> samples;
  for (int i = 0; i < 100'000; ++i) samples.push_back(process.at(Time{i * 50'123us}));
  EXPECT_LT(ks_distance(samples, normal_cdf), 2.7 / std::sqrt(100'000.0));
}

TEST(GaussianProcess, ForgetsExponentially) {
  const Duration tau = 20ms;
  GaussianProcess process{tau, RandomKey{12}};
  // Values every tau/4 over 40,000 tau; correlation with the value k steps later.
  std::vector<double> z;
  for (int i = 0; i < 160'000; ++i) z.push_back(process.at(Time{i * (tau / 4)}));
  for (const int lag : {2, 4, 8, 16}) {
    double sum = 0;
    const std::size_t n = z.size() - static_cast<std::size_t>(lag);
    for (std::size_t i = 0; i < n; ++i) sum += z[i] * z[i + static_cast<std::size_t>(lag)];
    EXPECT_NEAR(sum / static_cast<double>(n), std::exp(-lag / 4.0), 0.03) << lag;
  }
}

TEST(GaussianProcess, KeepsItsVarianceBetweenSteps) {
  GaussianProcess process{20ms, RandomKey{13}};
  for (const double part : {0.0, 0.25, 0.5, 0.9}) {
    double sum = 0;
    const int n = 40'000;
    for (int i = 0; i < n; ++i) {
      const double z = process.at(Time{process.step() * (997LL * i) + from_seconds(part * seconds(process.step()))});
      sum += z * z;
    }
    EXPECT_NEAR(sum / n, 1, 0.03) << part;  // 4 sigma of a chi-square
  }
}

TEST(GaussianProcess, IsSmoothWithinAStep) {
  GaussianProcess process{80ms, RandomKey{14}};
  double before = process.at(Time{});
  for (int i = 1; i < 100'000; ++i) {
    const double now = process.at(Time{i * 10us});
    ASSERT_LT(std::abs(now - before), 0.1) << i;  // a step of 0.6 ms moves it by 0.13 (1 sigma)
    before = now;
  }
}

}  // namespace
}  // namespace tandem::netsim
