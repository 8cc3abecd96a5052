#include "hal/drivers/openhaptics/latest.h"

#include <gtest/gtest.h>

#include <thread>

namespace tandem::hal::openhaptics {
namespace {

struct Pair {
  std::uint64_t n = 0, thrice = 0;
};

TEST(Latest, ReturnsTheNewestUntilANewerOneArrives) {
  Latest<Pair> latest;
  EXPECT_EQ(latest.read().n, 0u);
  latest.write({1, 3});
  latest.write({2, 6});
  EXPECT_EQ(latest.read().n, 2u);
  EXPECT_EQ(latest.read().n, 2u);
  latest.write({3, 9});
  EXPECT_EQ(latest.read().thrice, 9u);
}

TEST(Latest, NeverReturnsATornOrOlderValue) {
  Latest<Pair> latest;
  constexpr std::uint64_t kCount = 200'000;
  std::thread writer([&] {
    for (std::uint64_t n = 1; n <= kCount; ++n) latest.write({n, 3 * n});
  });
  std::uint64_t before = 0;
  while (before < kCount) {
    const Pair seen = latest.read();
    ASSERT_EQ(seen.thrice, 3 * seen.n);
    ASSERT_GE(seen.n, before);
    before = seen.n;
    std::this_thread::yield();
  }
  writer.join();
}

}  // namespace
}  // namespace tandem::hal::openhaptics
