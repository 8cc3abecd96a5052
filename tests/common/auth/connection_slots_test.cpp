#include "common/auth/connection_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <vector>

#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::auth {
namespace {

using namespace std::chrono_literals;
using Cause = ConnectionSlots::Cause;
using Id = ConnectionSlots::Id;

constexpr Time kStart{1h};
KeyFingerprint key(std::uint64_t number) {
  KeyFingerprint fingerprint;
  fingerprint.sha256[0] = static_cast<std::byte>(number);
  return fingerprint;
}
Source from(std::uint64_t number) { return Source::of(Origin::v4(static_cast<std::uint32_t>(0x0a000000U + number))); }

/// Returns the connections that must be closed now, in this order.
std::vector<Id> closed(ConnectionSlots& places, Time now, std::optional<Cause> all = {}) {
  std::vector<Id> ids;
  while (const auto one = places.close_one(now)) {
    ids.push_back(one->id);
    EXPECT_EQ(one->cause, all.value_or(one->cause)) << one->id;
  }
  return ids;
}

TEST(ConnectionSlots, CloseAnIdleUnjoinedConnectionAfterTenSeconds) {
  ConnectionSlots places({});
  places.enter(1, key(1), from(1), kStart);
  places.enter(2, key(1), from(1), kStart);
  places.set_joined(2, true, kStart + 1s);
  places.set_busy(1, true, kStart + 4s);
  EXPECT_TRUE(closed(places, kStart + 20s).empty()) << "its request is being carried out";
  places.set_busy(1, false, kStart + 20s);
  EXPECT_TRUE(closed(places, kStart + 29999ms).empty());
  EXPECT_EQ(closed(places, kStart + 30s, Cause::kIdle), std::vector<Id>{1});
  EXPECT_TRUE(closed(places, kStart + 24h).empty()) << "a joined connection stays";
  places.set_joined(2, false, kStart + 24h);  // another connection took the seat
  EXPECT_TRUE(closed(places, kStart + 24h + 9s).empty());
  EXPECT_EQ(closed(places, kStart + 24h + 10s, Cause::kIdle), std::vector<Id>{2});
}

TEST(ConnectionSlots, AllowFourUnjoinedConnectionsPerKey) {
  ConnectionSlots places({});
  for (Id id = 1; id <= 10; ++id) places.enter(id, key(1), from(id), kStart + id * 1ms);
  for (const Id id : {1, 2, 3}) places.set_joined(id, true, kStart + 500ms);
  places.enter(11, key(2), from(1), kStart);
  EXPECT_TRUE(closed(places, kStart + 999ms).empty()) << "so many may be about to join";
  EXPECT_EQ(closed(places, kStart + 2s, Cause::kPerKey), (std::vector<Id>{4, 5, 6})) << "the oldest";
  EXPECT_EQ(places.size(), 8u);
}

TEST(ConnectionSlots, AllowSixteenUnjoinedConnectionsPerSource) {
  ConnectionSlots places({});
  for (Id id = 1; id <= 30; ++id) places.enter(id, key(id / 3), from(1), kStart + id * 1ms);
  places.enter(31, key(200), from(2), kStart);
  const auto gone = closed(places, kStart + 5s, Cause::kPerSource);
  EXPECT_EQ(gone.size(), 14u);
  EXPECT_FALSE(std::ranges::find(gone, Id{31}) != gone.end());
  EXPECT_FALSE(std::ranges::find(gone, Id{30}) != gone.end()) << "the only one of its key, while others have several";
}

TEST(ConnectionSlots, EvictUnjoinedConnectionsAndNeverJoinedOnes) {
  ConnectionSlots places({.places = 100});
  for (Id id = 1; id <= 98; ++id) {
    places.enter(id, key(id), from(id), kStart);
    places.set_joined(id, true, kStart);
  }
  for (Id id = 201; id <= 203; ++id) places.enter(id, key(200), from(200), kStart + id * 1ms);
  EXPECT_EQ(closed(places, kStart + 300ms, Cause::kFull), std::vector<Id>{201});
  EXPECT_TRUE(places.may_join(false));
  for (Id id = 99; id <= 100; ++id) {
    places.enter(id, key(id), from(id), kStart + 400ms);
    places.set_joined(id, true, kStart + 400ms);
  }
  EXPECT_EQ(closed(places, kStart + 400ms, Cause::kFull), std::vector<Id>{202});
  EXPECT_FALSE(places.may_join(false));
  EXPECT_TRUE(places.may_join(true)) << "a lost connection comes back in its own place";
  EXPECT_EQ(places.size(), 101u) << "one stays for who shows a resume secret";
  places.enter(300, key(3), from(3), kStart + 500ms);
  EXPECT_EQ(closed(places, kStart + 500ms, Cause::kFull), std::vector<Id>{203})
      << "the connection that waits longest without a join makes room";
}

// For any traffic: joined and busy connections are never closed, and the remaining ones keep the limits.
TEST(ConnectionSlots, KeepItsLimitsUnderAnyTraffic) {
  const std::uint64_t count = test::seeds(30);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const ConnectionSlots::Limits limits{.places = 5 + random.below(100)};
    ConnectionSlots places(limits);
    struct Held {
      std::uint64_t key, source;
      Time entered, heard;
      bool joined = false, busy = false;
    };
    std::map<Id, Held> held;
    Time now = kStart;
    Id last = 0;
    for (int step = 0; step < 1500; ++step) {
      now += Duration{static_cast<std::int64_t>(random.below(300'000'000))};
      const auto anybody = [&] {
        return std::next(held.begin(), static_cast<std::ptrdiff_t>(random.below(held.size())));
      };
      const auto what = random.below(10);
      if (what < 5) {
        const Held newcomer{random.below(12), random.below(4), now, now};
        held[++last] = newcomer;
        places.enter(last, key(newcomer.key), from(newcomer.source), now);
      } else if (!held.empty()) {
        const auto one = anybody();
        Held& h = one->second;
        if (what == 5) {
          places.leave(one->first);
          held.erase(one);
        } else if (what == 6) {
          const bool joins = random.below(3) != 0 && (h.joined || places.may_join(false));
          if (joins != h.joined) h.heard = now;
          places.set_joined(one->first, h.joined = joins, now);
        } else {
          places.set_busy(one->first, h.busy = random.below(4) == 0, now);
          h.heard = now;
        }
      }
      while (const auto one = places.close_one(now)) {
        const auto found = held.find(one->id);
        ASSERT_NE(found, held.end());
        ASSERT_FALSE(found->second.joined);
        ASSERT_FALSE(found->second.busy);
        held.erase(found);
      }
      ASSERT_EQ(places.size(), held.size());
      std::map<std::uint64_t, std::size_t> of_key, of_source;
      std::size_t bare = 0, busy = 0, joined = 0;
      for (const auto& [id, h] : held) {
        joined += h.joined ? 1 : 0;
        if (h.joined) continue;
        if (h.busy) {
          ++busy;
          continue;
        }
        ++bare;
        EXPECT_LT(now - h.heard, limits.idle);
        if (now - h.entered < limits.settle) continue;
        EXPECT_LE(++of_key[h.key], limits.per_key);
        EXPECT_LE(++of_source[h.source], limits.per_source);
      }
      EXPECT_EQ(places.joined(), joined);
      EXPECT_LE(joined, limits.places);
      EXPECT_LE(places.size(),
                std::max(limits.places, joined + busy + ConnectionSlots::Limits::reserved(limits.places)));
      if (HasFailure()) return;
    }
  }
}

}  // namespace
}  // namespace tandem::auth
