#include "common/auth/attempt_limiter.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::auth {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart{1h};
const Source kA = Source::of(Origin::v4(0x0a000001)), kB = Source::of(Origin::v4(0x0a000002)),
             kLocal = Source::of(Origin::v4(0x7f000001));
const std::optional<KeyFingerprint> kStranger;

KeyFingerprint key(unsigned number) {
  KeyFingerprint fingerprint;
  fingerprint.sha256[0] = static_cast<std::byte>(number);
  fingerprint.sha256[1] = static_cast<std::byte>(number >> 8);
  return fingerprint;
}
void fail(AttemptLimiter& attempts, const Source& source, const std::optional<KeyFingerprint>& who, Time now,
          int times = 10) {
  for (int i = 0; i < times; ++i) attempts.record_failure(source, who, now);
}
Source v6(std::uint32_t site, std::uint8_t subnet) {
  return Source::of(Origin::of_v6({0x20, 1, static_cast<std::uint8_t>(site >> 16), static_cast<std::uint8_t>(site >> 8),
                                   static_cast<std::uint8_t>(site), 0, 0, subnet, 0, 0, 0, 0, 0, 0, 0, 1}));
}

TEST(AttemptLimiter, BlocksForFiveMinutesAfterTenInTwoMinutes) {
  AttemptLimiter attempts;
  for (int i = 0; i < 9; ++i) attempts.record_failure(kA, kStranger, kStart + i * 13s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 120s), 0s);
  attempts.record_failure(kA, kStranger, kStart + 120s);  // the first failure was exactly 120 s ago
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 120s), 300s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 419s), 1s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 420s), 0s);
  EXPECT_EQ(attempts.blocked_for(kB, kStranger, kStart + 120s), 0s);
}

TEST(AttemptLimiter, AllowsTenInMoreThanTwoMinutes) {
  AttemptLimiter attempts;
  for (int i = 0; i < 100; ++i) {
    attempts.record_failure(kA, key(1), kStart + i * 14s);  // ten failures take 126 s
    ASSERT_EQ(attempts.blocked_for(kA, key(1), kStart + i * 14s), 0s) << i;
  }
}

TEST(AttemptLimiter, CountsFromZeroAfterABlock) {
  AttemptLimiter attempts;
  fail(attempts, kA, kStranger, kStart);
  ASSERT_GT(attempts.blocked_for(kA, kStranger, kStart), 0s);
  fail(attempts, kA, kStranger, kStart + 301s, 9);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 301s), 0s);
  attempts.record_failure(kA, kStranger, kStart + 301s);
  EXPECT_GT(attempts.blocked_for(kA, kStranger, kStart + 301s), 0s);
}

TEST(AttemptLimiter, CountsPerKeyAndPerSource) {
  AttemptLimiter attempts;
  for (int i = 0; i < 5; ++i) {
    attempts.record_failure(kA, key(1), kStart);
    attempts.record_failure(kB, key(1), kStart);
  }
  EXPECT_GT(attempts.blocked_for(kA, key(1), kStart), 0s) << "ten of the key";
  EXPECT_GT(attempts.blocked_for(Source::of(Origin::v4(0x0b000001)), key(1), kStart), 0s) << "wherever it comes from";
  EXPECT_EQ(attempts.blocked_for(kA, key(2), kStart), 0s) << "five of each source";
  for (unsigned i = 0; i < 5; ++i) attempts.record_failure(kA, key(10 + i), kStart);
  EXPECT_GT(attempts.blocked_for(kA, key(2), kStart), 0s) << "ten of the source";
  EXPECT_EQ(attempts.blocked_for(kB, key(2), kStart), 0s);
}

TEST(AttemptLimiter, ExemptsLoopbackAsASourceOnly) {
  AttemptLimiter attempts;
  fail(attempts, kLocal, key(1), kStart, 100);
  EXPECT_EQ(attempts.blocked_for(kLocal, key(2), kStart), 0s);
  EXPECT_EQ(attempts.blocked_for(kLocal, kStranger, kStart), 0s);
  EXPECT_GT(attempts.blocked_for(kLocal, key(1), kStart), 0s);
  AttemptLimiter strict(false);
  fail(strict, kLocal, kStranger, kStart);
  EXPECT_GT(strict.blocked_for(kLocal, kStranger, kStart), 0s);
}

TEST(AttemptLimiter, KeepsABlockUnderAttemptsFromOtherSources) {
  for (const int each : {1, 10}) {  // other sources that fail once, and others that are blocked too
    AttemptLimiter attempts;
    fail(attempts, kA, kStranger, kStart);
    for (std::uint32_t i = 0; i < 3 * AttemptLimiter::kSources; ++i)
      fail(attempts, Source::of(Origin::v4(0x0b000000U + i * 256)), kStranger, kStart + 1s, each);
    EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 2s), 298s) << each;
    EXPECT_LE(attempts.tracked(), AttemptLimiter::kSources + AttemptLimiter::kNetworks);
  }
}

TEST(AttemptLimiter, BlocksANetworkFullOfBlockedSourcesAsAWhole) {
  AttemptLimiter attempts;
  fail(attempts, kA, kStranger, kStart);
  for (std::uint32_t i = 0; i < 2 * AttemptLimiter::kSources; ++i)
    fail(attempts, Source::of(Origin::v4(0x0b000000U + i)), kStranger, kStart + 1s);
  EXPECT_LE(attempts.tracked(), AttemptLimiter::kSources + AttemptLimiter::kNetworks);
  for (std::uint32_t i = 0; i < 2 * AttemptLimiter::kSources; ++i)
    ASSERT_EQ(attempts.blocked_for(Source::of(Origin::v4(0x0b000000U + i)), kStranger, kStart + 2s), 299s) << i;
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 2s), 298s);
  EXPECT_EQ(attempts.blocked_for(Source::of(Origin::v4(0x0c000001U)), kStranger, kStart + 2s), 0s) << "another network";
  EXPECT_EQ(attempts.blocked_for(Source::of(Origin::v4(0x0b000001U)), kStranger, kStart + 301s), 0s)
      << "and its time is over";
  AttemptLimiter sites;
  for (std::uint32_t i = 0; i < AttemptLimiter::kSources + 1; ++i)
    fail(sites, v6(i / 64, static_cast<std::uint8_t>(i % 64)), kStranger, kStart);
  EXPECT_GT(sites.blocked_for(v6(0, 200), kStranger, kStart), 0s) << "a /48 of IPv6";
}

TEST(AttemptLimiter, CountsOverflowSourcesTogetherButEnrolledKeysSeparately) {
  AttemptLimiter attempts;
  for (std::uint32_t i = 0; i < AttemptLimiter::kSources; ++i)
    fail(attempts, Source::of(Origin::v4(0x0b000000U + i * 256)), kStranger, kStart);
  const Source late = Source::of(Origin::v4(0x0a000001U));
  EXPECT_EQ(attempts.blocked_for(late, kStranger, kStart), 0s);
  for (std::uint32_t i = 0; i < 10; ++i)
    attempts.record_failure(Source::of(Origin::v4(0x0a000100U + i * 256)), kStranger, kStart);
  EXPECT_EQ(attempts.blocked_for(late, kStranger, kStart), 300s);
  EXPECT_EQ(attempts.blocked_for(late, key(1), kStart), 0s) << "an enrolled key has a count of its own";
}

// For any number of sources and any failures: a reported block stays until its time is over.
TEST(AttemptLimiter, KeepsAReportedBlockUntilItExpires) {
  const std::uint64_t count = test::seeds(2);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    AttemptLimiter attempts;
    std::map<Source, Time> until;
    Time now = kStart;
    for (int step = 0; step < 30'000; ++step) {
      now += Duration{static_cast<std::int64_t>(random.below(20'000'000))};
      const std::uint32_t network = static_cast<std::uint32_t>(random.below(6000));
      const Source source = Source::of(Origin::v4(0x0b000000U + network * 256 +
                                                  static_cast<std::uint32_t>(random.below(network % 7 == 0 ? 64 : 1))));
      fail(attempts, source, kStranger, now, random.below(3) == 0 ? 1 : 10);
      if (const Duration left = attempts.blocked_for(source, kStranger, now); left > 0s) until[source] = now + left;
      if (step % 3000 != 2999) continue;
      ASSERT_LE(attempts.tracked(), AttemptLimiter::kSources + AttemptLimiter::kNetworks);
      for (const auto& [blocked, time] : until) ASSERT_GE(attempts.blocked_for(blocked, kStranger, now), time - now);
    }
  }
}

}  // namespace
}  // namespace tandem::auth
