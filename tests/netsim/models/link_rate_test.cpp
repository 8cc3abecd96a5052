#include "netsim/models/link_rate.h"

#include <gtest/gtest.h>

#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

TEST(LinkRate, SendsExactlyAtItsRate) {
  // 100 bytes + 28 at 1 Mbit/s take 1024 us each.
  LinkRate rate{{.bits_per_s = 1'000'000}};
  for (int i = 1; i <= 1000; ++i) ASSERT_EQ(rate.serve(Time{}, 100), Time{i * 1024us});
}

TEST(LinkRate, DoesNotDriftWhenANanosecondIsNotAWholeBit) {
  // 128 bytes at 3000007 bit/s: one datagram takes 1024e9/3000007 ns, which is not an integer.
  constexpr std::uint64_t kBits = 3'000'007;
  LinkRate rate{{.bits_per_s = kBits}};
  for (std::uint64_t i = 1; i <= 1'000'000; ++i) {
    const auto done = rate.serve(Time{}, 100);
    const std::uint64_t exact = (i * 1'024'000'000'000 + kBits - 1) / kBits;  // rounded up
    ASSERT_EQ(static_cast<std::uint64_t>(done->time_since_epoch().count()), exact) << i;
  }
}

TEST(LinkRate, IsIdleAgainAfterItsWork) {
  LinkRate rate{{.bits_per_s = 1'000'000}};
  EXPECT_EQ(rate.serve(Time{}, 100), Time{1024us});
  EXPECT_EQ(rate.serve(Time{5ms}, 100), Time{5ms + 1024us});
  EXPECT_EQ(rate.serve(Time{5ms + 24us}, 100), Time{5ms + 2048us});
}

TEST(LinkRate, DropsTheTailWhenBytesAreFull) {
  // 10 datagrams of 128 bytes fit into 1280.
  LinkRate rate{{.bits_per_s = 1'000'000, .queue_bytes = 1280}};
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(rate.serve(Time{}, 100)) << i;
  EXPECT_FALSE(rate.serve(Time{}, 100));
  // Another datagram fits as soon as one has been sent, to the nanosecond.
  EXPECT_FALSE(rate.serve(Time{1024us - 1ns}, 100));
  EXPECT_EQ(rate.serve(Time{1024us}, 100), Time{11 * 1024us});
}

TEST(LinkRate, DropsDatagramsThatWouldWaitTooLong) {
  LinkRate rate{{.bits_per_s = 1'000'000, .queue_wait = 2048us}};
  EXPECT_TRUE(rate.serve(Time{}, 100));   // waits 0
  EXPECT_TRUE(rate.serve(Time{}, 100));   // 1024
  EXPECT_TRUE(rate.serve(Time{}, 100));   // 2048
  EXPECT_FALSE(rate.serve(Time{}, 100));  // 3072
}

TEST(LinkRate, CountsOverheadAndTakesEmptyAndHugeDatagrams) {
  LinkRate bare{{.bits_per_s = 8'000'000, .overhead_bytes = 0}};
  EXPECT_EQ(bare.serve(Time{}, 0), Time{});
  EXPECT_EQ(bare.serve(Time{}, 65'507), Time{65'507us});
  LinkRate with{{.bits_per_s = 8'000'000, .overhead_bytes = 28}};
  EXPECT_EQ(with.serve(Time{}, 0), Time{28us});
}

TEST(LinkRate, PropagationDoesNotFillTheQueue) {
  // 1 kHz through 5 s of propagation: thousands in flight, at most one in the queue.
  PathSpec spec;
  spec.rate = {.bits_per_s = 10'000'000, .queue_bytes = 1000};
  spec.floor = 5s;
  const auto all = decisions(path_of(spec), 20'000);
  EXPECT_EQ(count_of(all, Outcome::kDeliver), 20'000U);
}

TEST(LinkRate, NeverWaitsLongerThanAnHourEvenWithoutLimits) {
  LinkRate rate{{.bits_per_s = 100}};
  std::size_t taken = 0;
  for (int i = 0; i < 10'000; ++i) taken += rate.serve(Time{}, 65'507) ? 1 : 0;
  EXPECT_EQ(taken, 1U);  // the first one alone takes 5243 s
}

}  // namespace
}  // namespace tandem::netsim
