#include "common/base/rng.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <set>

namespace tandem {
namespace {

TEST(Mix64, IsThePublishedSplitMix64) {  // [Steele, Lea, Flood 2014], seed 1234567: values listed by Rosetta Code
  std::uint64_t state = 1234567;
  for (const std::uint64_t expected : {6457827717110365317ULL, 3203168211198807973ULL, 9817491932198370423ULL,
                                       4593380528125082431ULL, 16408922859458223821ULL}) {
    EXPECT_EQ(mix64(state), expected);
    state += 0x9e3779b97f4a7c15ULL;
  }
}

TEST(Mix64, ChangesHalfOfTheOutputBitsWithEveryInputBit) {
  for (int bit = 0; bit < 64; ++bit) {
    double flipped = 0;
    for (std::uint64_t i = 0; i < 2000; ++i) flipped += std::popcount(mix64(i) ^ mix64(i ^ (std::uint64_t{1} << bit)));
    EXPECT_NEAR(flipped / 2000, 32, 0.6) << "bit " << bit;
  }
}

TEST(RandomKey, IsAPureFunctionOfKeyAndCounter) {
  const RandomKey a{5}, b{5};
  EXPECT_EQ(a.bits(99), b.bits(99));
  EXPECT_EQ(a.uniform(7), b.uniform(7));
  RandomStream s{5};
  for (std::uint64_t i = 0; i < 10; ++i) EXPECT_EQ(s.bits(), a.bits(i));
}

TEST(RandomKey, DerivesIndependentKeys) {
  const RandomKey root{1};
  std::set<std::uint64_t> seen;
  for (std::uint64_t purpose = 0; purpose < 300; ++purpose)
    for (std::uint64_t c = 0; c < 20; ++c) seen.insert(root.derive(purpose).bits(c));
  for (std::uint64_t c = 0; c < 20; ++c) seen.insert(root.bits(c));
  EXPECT_EQ(seen.size(), 301U * 20U);
  EXPECT_NE(root.derive(1).derive(2).bits(0), root.derive(2).derive(1).bits(0));
  double correlation = 0;  // of keys with neighbouring purposes and with neighbouring seeds
  for (std::uint64_t c = 0; c < 20000; ++c)
    correlation += (root.derive(8).uniform(c) - 0.5) * (root.derive(9).uniform(c) - 0.5) +
                   (RandomKey{8}.uniform(c) - 0.5) * (RandomKey{9}.uniform(c) - 0.5);
  EXPECT_LT(std::abs(correlation / 20000 * 12), 0.05);
}

TEST(RandomKey, IsUniformFromZeroToBelowOne) {
  RandomStream s{3};
  double sum = 0, square = 0, least = 1, most = 0;
  int cell[10]{};
  for (int i = 0; i < 100'000; ++i) {
    const double u = s.uniform();
    ASSERT_GE(u, 0);
    ASSERT_LT(u, 1);
    sum += u;
    square += u * u;
    least = std::min(least, u);
    most = std::max(most, u);
    ++cell[static_cast<int>(10 * u)];
  }
  EXPECT_NEAR(sum / 1e5, 0.5, 0.005);
  EXPECT_NEAR(square / 1e5, 1.0 / 3, 0.005);
  EXPECT_LT(least, 1e-4);
  EXPECT_GT(most, 1 - 1e-4);
  for (const int count : cell) EXPECT_NEAR(count, 10'000, 500);
}

TEST(RandomStream, StaysInItsRange) {
  RandomStream s{4};
  bool seen[7]{};
  for (int i = 0; i < 1000; ++i) {
    const double u = s.uniform(-3, 5);
    ASSERT_GE(u, -3);
    ASSERT_LT(u, 5);
    seen[s.below(7)] = true;
    ASSERT_EQ(s.below(1), 0U);
  }
  for (const bool b : seen) EXPECT_TRUE(b);
}

}  // namespace
}  // namespace tandem
