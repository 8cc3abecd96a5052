#include "common/auth/pending_slots.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>
#include <ranges>
#include <set>
#include <string>
#include <vector>

#include "common/auth/returning_addresses.h"
#include "common/base/rng.h"
#include "tests/common/base/counts.h"

namespace tandem::auth {
namespace {

using namespace std::chrono_literals;
using Id = PendingSlots::Id;

constexpr Time kStart{1h};
/// Returns address `host` of the network 10.x.y.0/24 with the number `network`.
constexpr Origin at(std::uint32_t network, std::uint32_t host) {
  return Origin::v4(0x0a000000U + network * 256 + host);
}

TEST(Origin, NetworkIsTheFirst24BitsOfIpv4And64OfIpv6) {
  EXPECT_EQ(Origin::v4(0x0a000001).network, Origin::v4(0x0a0000ff).network);
  EXPECT_NE(Origin::v4(0x0a000001), Origin::v4(0x0a0000ff));
  EXPECT_NE(Origin::v4(0x0a000001).network, Origin::v4(0x0a000101).network);
  std::array<std::uint8_t, 16> a{0x20, 1, 0xd, 0xb8, 0, 0, 0, 1, 1, 2, 3, 4, 5, 6, 7, 8}, b = a;
  b[15] = 99;
  EXPECT_EQ(Origin::of_v6(a).network, Origin::of_v6(b).network);
  EXPECT_NE(Origin::of_v6(a), Origin::of_v6(b));
  b[7] = 2;
  EXPECT_NE(Origin::of_v6(a).network, Origin::of_v6(b).network);
  EXPECT_EQ(Origin::of_v6({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0xff, 0xff, 10, 0, 0, 1}), Origin::v4(0x0a000001));
  EXPECT_NE(Origin::of_v6({0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0}).network, Origin::v4(0).network);
}

TEST(PendingSlots, EvictTheOldestOfTheAddressWithMostWhenFull) {
  PendingSlots places({.places = 6});
  std::vector<Id> ids;
  for (const auto& [network, host] :
       std::vector<std::pair<unsigned, unsigned>>{{1, 1}, {2, 1}, {2, 2}, {2, 2}, {2, 3}, {3, 1}})
    ids.push_back(places.arrive(at(network, host), false, kStart).id);
  const auto sixth = places.arrive(at(4, 1), false, kStart);
  EXPECT_EQ(sixth.evicted, ids[2]) << "network 2 holds most, in it the address 2";
  EXPECT_EQ(places.size(), 6u);
  EXPECT_EQ(places.arrive(at(3, 2), false, kStart).evicted, ids[1]) << "of equals the oldest";
}

TEST(PendingSlots, CountANewConnectionWithItsOwnNetwork) {
  PendingSlots places({.places = 4});
  std::vector<Id> ids;
  for (const unsigned network : {1U, 1U, 2U, 2U}) ids.push_back(places.arrive(at(network, 1), false, kStart).id);
  EXPECT_EQ(places.arrive(at(2, 1), false, kStart).evicted, ids[2])
      << "the network that wants a third place pays for it";
  EXPECT_EQ(places.arrive(at(1, 1), false, kStart).evicted, ids[0]);
}

TEST(PendingSlots, EvictSilentConnectionsBeforeThoseThatSent) {
  PendingSlots places({.places = 4});
  const Id silent = places.arrive(at(1, 1), false, kStart).id, alone = places.arrive(at(2, 1), false, kStart).id;
  const Id second = places.arrive(at(1, 2), false, kStart + 50ms).id;
  const Id spoke = places.arrive(at(3, 1), false, kStart + 60ms).id;
  places.first_byte(spoke);
  EXPECT_EQ(places.arrive(at(3, 1), false, kStart + 120ms).evicted, silent)
      << "network 1 has two, one of them silent for long";
  EXPECT_EQ(places.arrive(at(3, 1), false, kStart + 160ms).evicted, spoke)
      << "1 and 2 have one connection each, which may be slow";
  places.leave(alone);
  places.leave(second);
  EXPECT_EQ(places.size(), 2u);
}

TEST(PendingSlots, RequireAFirstByteInFiveSecondsOrOneUnderPressure) {
  PendingSlots places({.places = 10});
  std::vector<Id> ids;
  for (unsigned i = 0; i < 4; ++i) ids.push_back(places.arrive(at(i, 1), false, kStart).id);
  places.first_byte(ids[0]);
  EXPECT_FALSE(places.under_pressure());
  EXPECT_FALSE(places.expire(kStart + 4999ms));
  EXPECT_EQ(places.next_event(kStart + 4999ms), kStart + 4999ms) << "a handshake can begin";
  ids.push_back(places.arrive(at(9, 1), false, kStart + 100ms).id);
  EXPECT_TRUE(places.under_pressure()) << "half of the places";
  EXPECT_EQ(places.expire(kStart + 1000ms), ids[1]);
  EXPECT_FALSE(places.under_pressure());
  EXPECT_FALSE(places.expire(kStart + 1000ms)) << "and time is plenty again";
  EXPECT_EQ(places.expire(kStart + 5000ms), ids[0]) << "it spoke, and its handshake is not over";
  EXPECT_EQ(places.expire(kStart + 5000ms), ids[2]);
  EXPECT_EQ(places.expire(kStart + 5000ms), ids[3]);
  EXPECT_FALSE(places.expire(kStart + 5000ms));
  EXPECT_EQ(places.next_event(kStart + 5000ms), kStart + 5100ms);
}

TEST(PendingSlots, QueueAThousandConnectionsWithoutEviction) {
  PendingSlots places({.places = 2000, .pending = 2000});
  for (std::uint32_t i = 0; i < 1000; ++i) {
    const auto placed = places.arrive(at(i / 200, i % 200), false, kStart);
    EXPECT_FALSE(placed.evicted);
    places.first_byte(placed.id);
  }
  Time now = kStart, last = kStart;
  std::size_t begun = 0;
  while (begun < 1000) {
    while (places.next_handshake(now)) {
      ++begun;
      last = now;
    }
    ASSERT_LT(now, kStart + 5s) << begun;
    now = std::max(*places.next_event(now), now);
  }
  EXPECT_NEAR(seconds(last - kStart), 700.0 / 300.0, 1e-3) << "300 at once, 700 at 300/s";
}

TEST(PendingSlots, ServeTheLeastRecentlyServedNetworkFirst) {
  PendingSlots places({.handshakes_per_s = 10, .handshakes_at_once = 1});
  const auto waiting = [&](const Origin& origin) {
    const Id id = places.arrive(origin, false, kStart).id;
    places.first_byte(id);
    return id;
  };
  std::vector<Id> crowd;
  for (unsigned i = 0; i < 20; ++i) crowd.push_back(waiting(at(1, i % 2)));
  EXPECT_EQ(places.next_handshake(kStart)->id, crowd[0]);
  EXPECT_FALSE(places.next_handshake(kStart)) << "the rate";
  const Id other = waiting(at(2, 1));
  EXPECT_EQ(places.next_handshake(kStart + 200ms)->id, other) << "it came last, and its network was never served";
  EXPECT_EQ(places.next_handshake(kStart + 400ms)->id, crowd[1]) << "the other address";
  places.leave(other);
  const Id again = waiting(at(2, 1));
  EXPECT_EQ(places.next_handshake(kStart + 600ms)->id, again) << "served before network 1 was";
  const Id more = waiting(at(2, 1));
  EXPECT_EQ(places.next_handshake(kStart + 800ms)->id, crowd[2]);
  EXPECT_EQ(places.next_handshake(kStart + 1000ms)->id, more);
}

TEST(PendingSlots, EvictStalledHandshakesUnderPressure) {
  PendingSlots places({.places = 40, .pending = 4});
  std::vector<Id> stalled;
  for (unsigned i = 0; i < 4; ++i) {
    stalled.push_back(places.arrive(at(1, i), false, kStart).id);
    places.first_byte(stalled.back());
    EXPECT_FALSE(places.next_handshake(kStart)->evicted);
  }
  const Id honest = places.arrive(at(2, 1), false, kStart).id;
  places.first_byte(honest);
  const auto next = places.next_handshake(kStart);
  ASSERT_TRUE(next);
  EXPECT_EQ(next->id, honest);
  EXPECT_EQ(next->evicted, stalled[0]);
  EXPECT_EQ(places.in_handshake(), 4u);
}

TEST(PendingSlots, ReserveSlotsForReturningAddresses) {
  PendingSlots places({.places = 64, .pending = 16, .handshakes_per_s = 1, .handshakes_at_once = 10});
  for (unsigned i = 0; i < 200; ++i) (void)places.arrive(at(i, 1), false, kStart);
  EXPECT_EQ(places.size(), 56u) << "an eighth is kept free";
  std::vector<Id> returning;
  for (unsigned i = 0; i < 8; ++i) {
    const auto placed = places.arrive(at(500, i), true, kStart);
    EXPECT_FALSE(placed.evicted);
    returning.push_back(placed.id);
  }
  std::set<Id> gone;
  for (unsigned i = 0; i < 300; ++i)
    gone.insert(places.arrive(at(1000 + i, 1), false, kStart + 1s).evicted.value_or(0));
  for (const Id id : returning) EXPECT_FALSE(gone.contains(id)) << "though its network holds most";
  std::vector<Id> strangers;
  for (unsigned i = 0; i < 6; ++i) {
    strangers.push_back(places.arrive(at(2000 + i, 1), false, kStart + 2s).id);
    places.first_byte(strangers.back());
  }
  for (const Id id : returning) places.first_byte(id);
  int of_returning = 0;
  for (int i = 0; i < 10; ++i) {
    const auto next = places.next_handshake(kStart + 2s);
    ASSERT_TRUE(next);
    of_returning += std::ranges::find(returning, next->id) != returning.end() ? 1 : 0;
  }
  EXPECT_EQ(of_returning, 5);
}

TEST(ReturningAddresses, AreRememberedForFifteenMinutesAndBounded) {
  ReturningAddresses known;
  known.note(at(1, 1), kStart);
  EXPECT_TRUE(known.contains(at(1, 1), kStart + 15min));
  EXPECT_FALSE(known.contains(at(1, 1), kStart + 15min + 1s));
  EXPECT_FALSE(known.contains(at(1, 2), kStart));
  for (std::uint32_t i = 0; i < ReturningAddresses::kMax; ++i) known.note(Origin::v4(i), kStart + 1s);
  EXPECT_FALSE(known.contains(at(1, 1), kStart + 1s)) << "the oldest note went";
}

// For any traffic: the bounds hold and no connection is closed twice. The only address of its network is not closed
// while another network holds two slots.
TEST(PendingSlots, KeepsItsBoundsAndSharesUnderAnyTraffic) {
  const std::uint64_t count = test::seeds(20);
  for (std::uint64_t seed = 1; seed <= count; ++seed) {
    SCOPED_TRACE("seed " + std::to_string(seed));
    RandomStream random(seed);
    const PendingSlots::Limits limits{.places = 1 + random.below(60),
                                      .pending = 1 + random.below(20),
                                      .handshakes_per_s = 20,
                                      .handshakes_at_once = 20};
    PendingSlots places(limits);
    struct Held {
      Origin origin;
      bool returning;
    };
    std::map<Id, Held> held;
    Time now = kStart;
    const auto gone = [&](Id id) { ASSERT_EQ(held.erase(id), 1u) << "closed twice, or never there"; };
    const auto evicted = [&](Id id, bool of_handshakes) {
      ASSERT_TRUE(held.contains(id));
      const Held victim = held.at(id);
      std::map<Origin::Network, std::size_t> per_network;
      for (const auto& [other, h] : held)
        if (h.returning == victim.returning) ++per_network[h.origin.network];
      const std::size_t most = std::ranges::max(per_network | std::views::values);
      if (!of_handshakes && most > 1 && std::ranges::none_of(held, [](const auto& h) { return h.second.returning; })) {
        EXPECT_GT(per_network[victim.origin.network], 1u);
      }
      std::size_t returning = 0;
      for (const auto& [other, h] : held) returning += h.returning ? 1 : 0;
      if (!of_handshakes && victim.returning) {
        EXPECT_GT(returning, PendingSlots::Limits::reserved(limits.places));
      }
      gone(id);
    };
    for (int step = 0; step < 2000; ++step) {
      now += Duration{static_cast<std::int64_t>(random.below(60'000'000))};
      const auto anybody = [&] {
        return std::next(held.begin(), static_cast<std::ptrdiff_t>(random.below(held.size())))->first;
      };
      switch (random.below(4)) {
        case 0:
        case 1: {
          const Held newcomer{at(static_cast<unsigned>(random.below(8)), static_cast<unsigned>(random.below(4))),
                              random.below(8) == 0};
          const auto placed = places.arrive(newcomer.origin, newcomer.returning, now);
          ASSERT_TRUE(held.emplace(placed.id, newcomer).second);
          ASSERT_NE(placed.evicted, placed.id) << "the youngest is not the oldest";
          if (placed.evicted) evicted(*placed.evicted, false);
          break;
        }
        case 2:
          if (!held.empty()) places.first_byte(anybody());
          break;
        default:
          if (!held.empty()) {
            const Id id = anybody();
            places.leave(id);
            gone(id);
          }
      }
      while (const auto late = places.expire(now)) gone(*late);
      while (const auto next = places.next_handshake(now)) {
        ASSERT_TRUE(held.contains(next->id));
        ASSERT_NE(next->evicted, next->id);
        if (next->evicted) evicted(*next->evicted, true);
      }
      ASSERT_EQ(places.size(), held.size());
      ASSERT_LE(places.size(), limits.places);
      ASSERT_LE(places.in_handshake(), limits.pending);
      if (HasFatalFailure()) return;
    }
  }
}

}  // namespace
}  // namespace tandem::auth
