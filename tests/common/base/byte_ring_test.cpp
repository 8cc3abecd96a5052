// A stream of bytes between two threads: order, bounds, wrap, visibility.
#include "common/base/byte_ring.h"

#include <gtest/gtest.h>

#include <array>
#include <thread>
#include <vector>

#include "common/base/rng.h"

namespace tandem {
namespace {

std::vector<std::byte> counted(std::size_t size, std::size_t first) {
  std::vector<std::byte> bytes(size);
  for (std::size_t i = 0; i < size; ++i) bytes[i] = static_cast<std::byte>(first + i);
  return bytes;
}

TEST(ByteRing, ShowsBytesOnlyOncePublished) {
  ByteRing ring{64};
  std::array<std::byte, 100> out;
  ring.put(counted(10, 0));
  EXPECT_EQ(ring.take(out), 0u);
  ring.publish();
  EXPECT_EQ(ring.take(std::span{out}.first(4)), 4u);
  EXPECT_EQ(ring.taken(), 4u);
  EXPECT_EQ(ring.take(out), 6u);
  EXPECT_EQ(out[0], std::byte{4});
  EXPECT_EQ(ring.take(out), 0u);
}

TEST(ByteRing, HoldsExactlyItsCapacity) {
  ByteRing ring{65};
  EXPECT_EQ(ring.capacity(), 128u);
  ring.put(counted(100, 0));
  EXPECT_TRUE(ring.fits(28));
  EXPECT_FALSE(ring.fits(29));
  ring.publish();
  std::array<std::byte, 1> one;
  EXPECT_EQ(ring.take(one), 1u);
  EXPECT_TRUE(ring.fits(29));
  EXPECT_FALSE(ring.fits(30));
  EXPECT_EQ(ByteRing{0}.capacity(), 64u);
}

TEST(ByteRing, KeepsOrderAcrossTheEndOfItsMemory) {
  RandomStream random{3};
  ByteRing ring{64};
  std::size_t written = 0, read = 0;
  std::array<std::byte, 64> out;
  for (int n = 0; n < 10'000; ++n) {
    if (const std::size_t size = random.below(40); ring.fits(size)) {
      ring.put(counted(size, written));
      written += size;
    }
    ring.publish();
    const std::size_t size = ring.take(std::span{out}.first(random.below(50)));
    for (std::size_t i = 0; i < size; ++i) ASSERT_EQ(out[i], static_cast<std::byte>(read + i));
    read += size;
    ASSERT_LE(written - read, 64u);
  }
  EXPECT_GT(read, 50'000u);
}

TEST(ByteRing, PassesEveryByteToAnotherThread) {
  constexpr std::size_t kBytes = 1'000'000;
  ByteRing ring{4096};
  std::thread writer{[&] {
    for (std::size_t written = 0; written < kBytes;) {
      if (!ring.fits(100)) {
        std::this_thread::yield();
        continue;
      }
      ring.put(counted(100, written));
      written += 100;
      ring.publish();
    }
  }};
  std::array<std::byte, 777> out;
  std::size_t read = 0, wrong = 0;
  while (read < kBytes) {
    const std::size_t size = ring.take(out);
    for (std::size_t i = 0; i < size; ++i) wrong += out[i] != static_cast<std::byte>(read + i) ? 1 : 0;
    read += size;
    if (size == 0) std::this_thread::yield();
  }
  writer.join();
  EXPECT_EQ(read, kBytes);
  EXPECT_EQ(wrong, 0u);
}

}  // namespace
}  // namespace tandem
