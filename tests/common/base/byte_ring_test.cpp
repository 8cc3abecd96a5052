// A stream of bytes between two threads: order, bounds, wrap, visibility.
#include "common/base/byte_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>

#include "common/base/rng.h"

namespace tandem {
namespace {

/// Byte number `n` of a stream without zeros.
std::byte counted(std::size_t n) { return static_cast<std::byte>(1 + n % 255); }

/// Appends bytes that continue the count. @return false if the ring is full
bool put(ByteRing& ring, std::size_t size, std::size_t first) {
  std::byte* const at = ring.reserve(size);
  if (at == nullptr) return false;
  for (std::size_t i = 0; i < size; ++i) at[i] = counted(first + i);
  ring.commit(size);
  return true;
}

TEST(ByteRing, ShowsBytesOnlyOncePublished) {
  ByteRing ring{64};
  std::array<std::byte, 100> out;
  ASSERT_TRUE(put(ring, 10, 0));
  EXPECT_EQ(ring.take(out), 0u);
  ring.publish();
  EXPECT_EQ(ring.take(std::span{out}.first(4)), 4u);
  EXPECT_EQ(ring.taken(), 4u);
  EXPECT_EQ(ring.take(out), 6u);
  EXPECT_EQ(out[0], counted(4));
  EXPECT_EQ(ring.take(out), 0u);
}

TEST(ByteRing, HoldsExactlyItsCapacity) {
  ByteRing ring{65};
  EXPECT_EQ(ring.capacity(), 128u);
  ASSERT_TRUE(put(ring, 100, 0));
  EXPECT_EQ(ring.reserve(29), nullptr);
  EXPECT_TRUE(put(ring, 28, 100));
  EXPECT_EQ(ring.reserve(1), nullptr);
  EXPECT_EQ(ByteRing{0}.capacity(), 64u);
  EXPECT_EQ(ByteRing{64}.reserve(65), nullptr);
}

// 100 of 128 bytes: a piece of 40 does not fit before the end, so 28 zeros precede it.
TEST(ByteRing, FillsTheRestOfItsMemoryWithZeros) {
  ByteRing ring{128};
  ASSERT_TRUE(put(ring, 100, 0));
  ring.publish();
  std::array<std::byte, 128> out;
  ASSERT_EQ(ring.take(std::span{out}.first(30)), 30u);
  EXPECT_EQ(ring.reserve(40), nullptr) << "28 and 40 do not fit beside 70";
  ASSERT_EQ(ring.take(std::span{out}.first(10)), 10u);
  ASSERT_TRUE(put(ring, 40, 100));
  ring.publish();
  ASSERT_EQ(ring.take(out), 60u + 28u + 40u);
  for (std::size_t i = 0; i < 28; ++i) ASSERT_EQ(out[60 + i], std::byte{0});
  for (std::size_t i = 0; i < 40; ++i) ASSERT_EQ(out[60 + 28 + i], counted(100 + i));
}

TEST(ByteRing, KeepsOrderAcrossTheEndOfItsMemory) {
  RandomStream random{3};
  ByteRing ring{64};
  std::size_t written = 0, read = 0;
  std::array<std::byte, 64> out;
  for (int n = 0; n < 10'000; ++n) {
    const std::size_t size = random.below(30);
    if (put(ring, size, written)) written += size;
    ring.publish();
    const std::size_t taken = ring.take(std::span{out}.first(random.below(50)));
    for (std::size_t i = 0; i < taken; ++i) {
      if (out[i] == std::byte{0}) continue;
      ASSERT_EQ(out[i], counted(read++));
    }
  }
  EXPECT_GT(read, 50'000u);
}

TEST(ByteRing, PassesEveryByteToAnotherThread) {
  constexpr std::size_t kBytes = 1'000'000;
  ByteRing ring{4096};
  std::thread writer{[&] {
    for (std::size_t written = 0; written < kBytes;) {
      if (put(ring, 100, written)) {
        written += 100;
        ring.publish();
      } else {
        std::this_thread::yield();
      }
    }
  }};
  std::array<std::byte, 777> out;
  std::size_t read = 0, wrong = 0;
  while (read < kBytes) {
    const std::size_t size = ring.take(out);
    for (std::size_t i = 0; i < size; ++i)
      if (out[i] != std::byte{0}) wrong += out[i] != counted(read++) ? 1 : 0;
    if (size == 0) std::this_thread::yield();
  }
  writer.join();
  EXPECT_EQ(read, kBytes);
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace tandem
