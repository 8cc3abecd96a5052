// A control server under attack, in virtual time: rejected clients, and the duration of joins.
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <map>
#include <optional>
#include <queue>
#include <string>
#include <tuple>
#include <vector>

#include "common/auth/pending_slots.h"
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

enum class Attack { kSilent, kOneByte, kWholeHandshake };

/// The connection handling in virtual time: connections arrive, send, shake hands, are evicted.
struct DoorModel {
  explicit DoorModel(const PendingSlots::Limits& limits) : places(limits) {}

  struct Peer {
    bool honest = false;
    Attack attack = Attack::kSilent;
    Duration round_trip{};
    Time began{};
  };
  struct Event {
    Time at;
    std::uint64_t order;
    std::function<void()> what;
    bool operator<(const Event& other) const { return std::tie(at, order) > std::tie(other.at, other.order); }
  };
  void later(Time when, std::function<void()> what) { events.push({when, order++, std::move(what)}); }

  void connect(const Origin& origin, const Peer& peer) {
    const auto placed = places.arrive(origin, false, now);
    peers[placed.id] = peer;
    if (placed.evicted) closed(*placed.evicted);
    if (peer.honest || peer.attack != Attack::kSilent)
      later(now + peer.round_trip, [this, id = placed.id] { places.first_byte(id); });
  }
  void closed(Id id) {
    const auto found = peers.find(id);
    if (found->second.honest) ++refused;
    peers.erase(found);
  }
  void tend() {
    while (const auto late = places.expire(now)) closed(*late);
    while (const auto next = places.next_handshake(now)) {
      if (next->evicted) closed(*next->evicted);
      const Peer& peer = peers.at(next->id);
      if (!peer.honest && peer.attack != Attack::kWholeHandshake) continue;  // the handshake stalls
      later(now + peer.round_trip, [this, id = next->id] {
        const auto found = peers.find(id);
        if (found == peers.end()) return;
        if (found->second.honest) joined.push_back(now - found->second.began);
        places.leave(id);
        peers.erase(found);
      });
    }
    ASSERT_LE(places.size(), limit);
    if (const auto next = places.next_event(now); next && (!due || *next < *due)) {
      due = *next;
      later(*next, [this] { due.reset(); });
    }
  }
  void run() {
    while (!events.empty()) {
      const Event event = events.top();
      events.pop();
      now = event.at;
      event.what();
      tend();
    }
  }

  PendingSlots places;
  std::size_t limit = 1024;
  Time now = kStart;
  std::priority_queue<Event> events;
  std::uint64_t order = 0;
  std::map<Id, Peer> peers;
  std::optional<Time> due;
  std::size_t refused = 0;
  std::vector<Duration> joined;
};

/// 64 addresses × 10 connections a second for 25 s; meanwhile 100 honest joins.
struct Siege {
  Attack attack = Attack::kSilent;
  bool same_network = false, attackers_in_one_network = false;
  bool at_once = false;  ///< all 100 in the tenth second, from one address; else four a second from ten addresses
};
DoorModel besiege(const Siege& siege, std::uint64_t seed) {
  DoorModel door({});
  RandomStream random(seed);
  const auto around = [&](std::uint64_t ns) { return Duration{static_cast<std::int64_t>(random.below(ns))}; };
  for (unsigned address = 0; address < 64; ++address) {
    const Origin from = siege.same_network               ? at(7, 100 + address)
                        : siege.attackers_in_one_network ? at(9, address)
                                                         : at(100 + address, 1);
    for (int i = 0; i < 250; ++i) {
      const Duration round_trip = 1ms + around(20'000'000);
      door.later(kStart + i * 100ms + around(100'000'000), [&door, &siege, from, round_trip] {
        door.connect(from, {false, siege.attack, round_trip, door.now});
      });
    }
  }
  for (unsigned i = 0; i < 100; ++i) {
    const Duration round_trip = 1ms + around(50'000'000), offset = around(100'000'000);
    const Origin from = siege.at_once ? at(7, 1) : at(7, i % 10);
    door.later(kStart + (siege.at_once ? 10s : i * 250ms) + offset,
               [&door, from, round_trip] { door.connect(from, {true, {}, round_trip, door.now}); });
  }
  door.run();
  return door;
}

TEST(PendingSlots, AcceptHonestJoinsWhile64AddressesHoldSilentConnections) {
  const std::uint64_t count = test::seeds(1);
  Duration longest{};
  for (std::uint64_t seed = 1; seed <= count; ++seed)
    for (const bool same_network : {false, true})
      for (const bool one_network : {false, true})
        for (const bool at_once : {false, true}) {
          SCOPED_TRACE("seed " + std::to_string(seed) + (same_network ? " same network" : "") +
                       (one_network ? " one network" : "") + (at_once ? " at once" : ""));
          const DoorModel door = besiege({Attack::kSilent, same_network, one_network, at_once}, seed);
          ASSERT_EQ(door.refused, 0u);
          ASSERT_EQ(door.joined.size(), 100u);
          longest = std::max(longest, std::ranges::max(door.joined));
          ASSERT_LE(std::ranges::max(door.joined), 1s);
        }
  std::printf("[ measured ] longest join under 640 silent connections a second, in virtual time: %.3f s\n",
              seconds(longest));
}

TEST(PendingSlots, AcceptSequentialHonestJoinsDespiteSendingAttackers) {
  const std::uint64_t count = test::seeds(1);
  for (const Attack attack : {Attack::kOneByte, Attack::kWholeHandshake}) {
    Duration longest{};
    for (std::uint64_t seed = 1; seed <= count; ++seed)
      for (const bool same_network : {false, true})
        for (const bool one_network : {false, true}) {
          SCOPED_TRACE("seed " + std::to_string(seed) + (same_network ? " same network" : "") +
                       (one_network ? " one network" : ""));
          const DoorModel door = besiege({attack, same_network, one_network, false}, seed);
          ASSERT_EQ(door.refused, 0u);
          ASSERT_EQ(door.joined.size(), 100u);
          longest = std::max(longest, std::ranges::max(door.joined));
          ASSERT_LE(std::ranges::max(door.joined), 1s);
        }
    std::printf("[ measured ] longest join under 640 %s a second, in virtual time: %.3f s\n",
                attack == Attack::kOneByte ? "connections that send one byte" : "whole handshakes", seconds(longest));
  }
}

}  // namespace
}  // namespace tandem::auth
