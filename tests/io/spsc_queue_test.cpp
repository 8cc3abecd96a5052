#include "common/io/spsc_queue.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <optional>
#include <thread>

#include "tests/common/base/counts.h"

namespace tandem::io {
namespace {

TEST(SpscQueue, DropsAndCountsElementsThatDoNotFit) {
  SpscQueue<int> queue{3};
  EXPECT_EQ(queue.front(), nullptr);
  for (int i = 0; i < 5; ++i) EXPECT_EQ(queue.push(i), i < 3);
  EXPECT_EQ(queue.dropped(), 2u);
  for (int i = 0; i < 3; ++i) {
    ASSERT_NE(queue.front(), nullptr);
    EXPECT_EQ(*queue.front(), i);
    queue.pop();
  }
  EXPECT_EQ(queue.front(), nullptr);
  EXPECT_TRUE(queue.push(7));
  EXPECT_EQ(*queue.front(), 7);
}

TEST(SpscQueue, GivesEachElementToOneTake) {
  SpscQueue<int> queue{3};
  EXPECT_EQ(queue.take(), std::nullopt);
  for (int i = 0; i < 2; ++i) EXPECT_TRUE(queue.push(i));
  EXPECT_EQ(queue.take(), 0);
  EXPECT_EQ(*queue.front(), 1);
  EXPECT_EQ(queue.take(), 1);
  EXPECT_EQ(queue.take(), std::nullopt);
  EXPECT_EQ(queue.front(), nullptr);
}

TEST(SpscQueue, CarriesEverythingInOrderBetweenTwoThreads) {
  const std::uint64_t count =
      test::draws(20'000, 200'000, 200'000);  // when other work uses the cores, every 16 cost two time slices
  struct Pair {
    std::uint64_t value = 0, twice = 0;  // torn copies would differ
  };
  SpscQueue<Pair> queue{16};
  std::thread writer{[&] {
    for (std::uint64_t i = 0; i < count;) {
      if (queue.push({i, 2 * i})) {
        ++i;
      } else {
        std::this_thread::yield();  // full: on a busy machine spinning would only delay the reader
      }
    }
  }};
  std::uint64_t wrong = 0;
  for (std::uint64_t i = 0; i < count;) {
    const Pair* pair = queue.front();
    if (pair == nullptr) {
      std::this_thread::yield();
      continue;
    }
    wrong += pair->value != i || pair->twice != 2 * i ? 1 : 0;
    queue.pop();
    ++i;
  }
  writer.join();
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace tandem::io
