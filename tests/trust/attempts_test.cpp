#include "common/trust/attempts.h"

#include <gtest/gtest.h>

#include <map>
#include <optional>
#include <string>

#include "common/base/rng.h"
#include "tests/base/counts.h"

namespace tandem::trust {
namespace {

using namespace std::chrono_literals;

constexpr Time kStart{1h};
const Source kA = Source::v4(0x0a000001), kB = Source::v4(0x0a000002), kLocal = Source::v4(0x7f000001);
const std::optional<Pin> kStranger;

Pin key(unsigned number) {
  Pin pin;
  pin.sha256[0] = static_cast<std::byte>(number);
  pin.sha256[1] = static_cast<std::byte>(number >> 8);
  return pin;
}
void fail(Attempts& attempts, const Source& source, const std::optional<Pin>& who, Time now, int times = 10) {
  for (int i = 0; i < times; ++i) attempts.wrong(source, who, now);
}
Source v6(std::uint32_t site, std::uint8_t subnet) {
  return Source::of_v6({0x20, 1, static_cast<std::uint8_t>(site >> 16), static_cast<std::uint8_t>(site >> 8), static_cast<std::uint8_t>(site), 0, 0, subnet, 0, 0, 0, 0, 0, 0, 0, 1});
}

TEST(Attempts, TenInTwoMinutesBlockForFive) {
  Attempts attempts;
  for (int i = 0; i < 9; ++i) attempts.wrong(kA, kStranger, kStart + i * 13s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 120s), 0s);
  attempts.wrong(kA, kStranger, kStart + 120s);  // the first was exactly 120 s ago
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 120s), 300s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 419s), 1s);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 420s), 0s);
  EXPECT_EQ(attempts.blocked_for(kB, kStranger, kStart + 120s), 0s);
}

TEST(Attempts, TenInMoreThanTwoMinutesDoNot) {
  Attempts attempts;
  for (int i = 0; i < 100; ++i) {
    attempts.wrong(kA, key(1), kStart + i * 14s);  // ten of them take 126 s
    ASSERT_EQ(attempts.blocked_for(kA, key(1), kStart + i * 14s), 0s) << i;
  }
}

TEST(Attempts, AreCountedFromZeroAfterABlock) {
  Attempts attempts;
  fail(attempts, kA, kStranger, kStart);
  ASSERT_GT(attempts.blocked_for(kA, kStranger, kStart), 0s);
  fail(attempts, kA, kStranger, kStart + 301s, 9);
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 301s), 0s);
  attempts.wrong(kA, kStranger, kStart + 301s);
  EXPECT_GT(attempts.blocked_for(kA, kStranger, kStart + 301s), 0s);
}

TEST(Attempts, AreCountedPerKeyAndPerSource) {
  Attempts attempts;
  for (int i = 0; i < 5; ++i) {
    attempts.wrong(kA, key(1), kStart);
    attempts.wrong(kB, key(1), kStart);
  }
  EXPECT_GT(attempts.blocked_for(kA, key(1), kStart), 0s) << "ten of the key";
  EXPECT_GT(attempts.blocked_for(Source::v4(0x0b000001), key(1), kStart), 0s) << "wherever it comes from";
  EXPECT_EQ(attempts.blocked_for(kA, key(2), kStart), 0s) << "five of each source";
  for (unsigned i = 0; i < 5; ++i) attempts.wrong(kA, key(10 + i), kStart);
  EXPECT_GT(attempts.blocked_for(kA, key(2), kStart), 0s) << "ten of the source";
  EXPECT_EQ(attempts.blocked_for(kB, key(2), kStart), 0s);
}

TEST(Attempts, LoopbackIsExemptAsASourceOnly) {
  Attempts attempts;
  fail(attempts, kLocal, key(1), kStart, 100);
  EXPECT_EQ(attempts.blocked_for(kLocal, key(2), kStart), 0s);
  EXPECT_EQ(attempts.blocked_for(kLocal, kStranger, kStart), 0s);
  EXPECT_GT(attempts.blocked_for(kLocal, key(1), kStart), 0s);
  Attempts strict(false);
  fail(strict, kLocal, kStranger, kStart);
  EXPECT_GT(strict.blocked_for(kLocal, kStranger, kStart), 0s);
}

TEST(Attempts, ABlockIsNotWashedAwayByOtherSources) {
  for (const int each : {1, 10}) {  // others that fail once, and others that get blocked too
    Attempts attempts;
    fail(attempts, kA, kStranger, kStart);
    for (std::uint32_t i = 0; i < 3 * Attempts::kSources; ++i) fail(attempts, Source::v4(0x0b000000U + i * 256), kStranger, kStart + 1s, each);
    EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 2s), 298s) << each;
    EXPECT_LE(attempts.remembered(), Attempts::kSources + Attempts::kNetworks);
  }
}

TEST(Attempts, ANetworkFullOfBlockedSourcesIsBlockedAsAWhole) {
  Attempts attempts;
  fail(attempts, kA, kStranger, kStart);
  for (std::uint32_t i = 0; i < 2 * Attempts::kSources; ++i) fail(attempts, Source::v4(0x0b000000U + i), kStranger, kStart + 1s);
  EXPECT_LE(attempts.remembered(), Attempts::kSources + Attempts::kNetworks);
  for (std::uint32_t i = 0; i < 2 * Attempts::kSources; ++i) ASSERT_EQ(attempts.blocked_for(Source::v4(0x0b000000U + i), kStranger, kStart + 2s), 299s) << i;
  EXPECT_EQ(attempts.blocked_for(kA, kStranger, kStart + 2s), 298s);
  EXPECT_EQ(attempts.blocked_for(Source::v4(0x0c000001U), kStranger, kStart + 2s), 0s) << "another network";
  EXPECT_EQ(attempts.blocked_for(Source::v4(0x0b000001U), kStranger, kStart + 301s), 0s) << "and its time is over";
  Attempts sites;
  for (std::uint32_t i = 0; i < Attempts::kSources + 1; ++i) fail(sites, v6(i / 64, static_cast<std::uint8_t>(i % 64)), kStranger, kStart);
  EXPECT_GT(sites.blocked_for(v6(0, 200), kStranger, kStart), 0s) << "a /48 of IPv6";
}

TEST(Attempts, SourcesForWhichThereIsNoRoomAreCountedTogetherButEnrolledKeysAreNot) {
  Attempts attempts;
  for (std::uint32_t i = 0; i < Attempts::kSources; ++i) fail(attempts, Source::v4(0x0b000000U + i * 256), kStranger, kStart);
  const Source late = Source::v4(0x0a000001U);
  EXPECT_EQ(attempts.blocked_for(late, kStranger, kStart), 0s);
  for (std::uint32_t i = 0; i < 10; ++i) attempts.wrong(Source::v4(0x0a000100U + i * 256), kStranger, kStart);
  EXPECT_EQ(attempts.blocked_for(late, kStranger, kStart), 300s);
  EXPECT_EQ(attempts.blocked_for(late, key(1), kStart), 0s) << "an enrolled key has a count of its own";
}

// Whatever sources do, in whatever number: a block that was reported once stands until its time is over.
TEST(Attempts, AReportedBlockStandsUntilItsTime) {
  const std::uint64_t count = test::seeds(2);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    Attempts attempts;
    std::map<Source, Time> until;
    Time now = kStart;
    for (int step = 0; step < 30'000; ++step) {
      now += Duration{static_cast<std::int64_t>(random.below(20'000'000))};
      const std::uint32_t network = static_cast<std::uint32_t>(random.below(6000));
      const Source source = Source::v4(0x0b000000U + network * 256 + static_cast<std::uint32_t>(random.below(network % 7 == 0 ? 64 : 1)));
      fail(attempts, source, kStranger, now, random.below(3) == 0 ? 1 : 10);
      if (const Duration left = attempts.blocked_for(source, kStranger, now); left > 0s) until[source] = now + left;
      if (step % 3000 != 2999) continue;
      ASSERT_LE(attempts.remembered(), Attempts::kSources + Attempts::kNetworks);
      for (const auto& [blocked, time] : until)
        ASSERT_GE(attempts.blocked_for(blocked, kStranger, now), time - now);
    }
  }
}

}  // namespace
}  // namespace tandem::trust
