// Reordering and duplicates as seen by a receiver of the virtual network.
#include <gtest/gtest.h>

#include <cstring>
#include <map>
#include <vector>

#include "netsim/engine/network.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Returns `count` datagrams sent every millisecond, in order of arrival.
std::vector<Delivery> arrivals(const PathSpec& spec, std::size_t count, std::uint64_t seed = 1) {
  Network network{seed};
  network.add_link({spec, spec});
  std::vector<Delivery> all;
  std::array<std::byte, kSlotBytes> buffer;
  const auto drain = [&](Time now) {
    while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) all.push_back(*d);
  };
  Time now{};
  for (std::size_t i = 0; i < count; ++i, now += 1ms) {
    network.send(now, 0, Direction::kUp, datagram(i, 16));
    drain(now);
  }
  drain(now + 200s);
  return all;
}

TEST(Reorder, DelaysADatagramByExactlyKOthers) {
  for (const std::uint32_t k : {1U, 3U, 10U}) {
    PathSpec spec;
    spec.floor = 10ms;
    spec.reorder = {.probability = 0.002, .displacement = k};
    const auto all = arrivals(spec, 50'000);
    ASSERT_EQ(all.size(), 50'000U);
    std::size_t moved = 0, alone = 0;
    std::uint64_t last_moved = 0;
    for (std::size_t position = 0; position < all.size(); ++position) {
      // RFC 4737: reordered if a later datagram arrived before it; extent: back to the first such datagram.
      const std::uint64_t index = all[position].index;
      if (position == 0 || all[position - 1].index < index) continue;
      ++moved;
      std::size_t extent = 0;
      while (extent < position && all[position - extent - 1].index > index) ++extent;
      if (index > last_moved + 2 * k) {
        ASSERT_EQ(extent, k) << index;
        ++alone;
      }
      last_moved = index;
    }
    EXPECT_TRUE(binomial_fits(moved, 50'000, 0.002)) << moved;
    EXPECT_GT(alone, 20U);
  }
}

TEST(Reorder, DeliversAllAndNoneBeforeTheFloor) {
  PathSpec spec;
  spec.floor = 10ms;
  spec.reorder = {.probability = 0.5, .displacement = 4, .hold_limit = 30ms};
  const auto all = arrivals(spec, 20'000);
  EXPECT_EQ(all.size(), 20'000U);
  for (const Delivery& d : all) {
    ASSERT_GE(d.at - d.sent, 10ms);
    ASSERT_LE(d.at - d.sent, 40ms);
  }
}

TEST(Reorder, DeliversAllWithinTheHoldLimit) {
  PathSpec spec;
  spec.reorder = {.probability = 1, .displacement = 3, .hold_limit = 20ms};
  const auto all = arrivals(spec, 1'000);
  ASSERT_EQ(all.size(), 1'000U);
  // No later datagram passes, so all wait for their limit, in order.
  for (std::size_t i = 0; i < all.size(); ++i) {
    ASSERT_EQ(all[i].index, i);
    ASSERT_EQ(all[i].at - all[i].sent, 20ms);
  }
}

TEST(Reorder, ReleasesTheLastDatagramAtTheHoldLimit) {
  PathSpec spec;
  spec.reorder = {.probability = 1, .displacement = 3, .hold_limit = 20ms};
  Network network{1};
  network.add_link({spec, spec});
  std::array<std::byte, kSlotBytes> buffer;
  EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, datagram(0)), Outcome::kHeldBack);
  EXPECT_EQ(network.next_due(0, Direction::kUp), Time{20ms});
  EXPECT_FALSE(network.poll(Time{20ms - 1ns}, 0, Direction::kUp, buffer));
  EXPECT_TRUE(network.poll(Time{20ms}, 0, Direction::kUp, buffer));
}

// With free order the passing datagrams may be faster than the held one, which still has its own delay.
TEST(Reorder, NeverDeliversBeforeItsDelayEvenWhenOrderIsFree) {
  PathSpec plain;
  plain.body = {.kind = BodySpec::Kind::kUniform, .high = 40ms};
  plain.order = ArrivalOrder::kFree;
  PathSpec with = plain;
  with.reorder = {.probability = 0.1, .displacement = 2};
  const auto own = decisions(path_of(plain), 10'000);
  Path path = path_of(with);
  std::size_t released = 0;
  for (std::size_t i = 0; i < own.size(); ++i) {
    for (const Release& r : path.send(Time{1ms * static_cast<std::int64_t>(i)}, kSize).released) {
      ASSERT_GE(r.at, own[r.index].at) << r.index;
      ++released;
    }
  }
  EXPECT_GT(released, 500U);
}

TEST(Reorder, DoesNotChangeOtherDatagrams) {
  PathSpec plain;
  plain.floor = 5ms;
  plain.body = {.kind = BodySpec::Kind::kUniform, .high = 4ms};
  PathSpec with = plain;
  with.reorder.probability = 0.1;
  const auto a = decisions(path_of(plain), 10'000);
  const auto b = decisions(path_of(with), 10'000);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_TRUE(b[i].outcome == Outcome::kHeldBack || a[i].at == b[i].at) << i;
  }
}

TEST(Duplicate, CopiesItsShareAndNoLostDatagram) {
  PathSpec spec;
  spec.floor = 2ms;
  spec.loss.probability = 0.3;
  spec.duplicate = {.probability = 0.1, .delay_max = 5ms};
  constexpr std::size_t n = 200'000;
  const auto all = arrivals(spec, n);
  std::map<std::uint64_t, std::vector<Time>> times;
  for (const Delivery& d : all) times[d.index].push_back(d.at);
  std::size_t copies = 0;
  for (const auto& [index, at] : times) {
    ASSERT_LE(at.size(), 2U);
    if (at.size() < 2) continue;
    ++copies;
    ASSERT_GE(at[1], at[0]);
    ASSERT_LE(at[1] - at[0], 5ms);
    ASSERT_EQ(at[0], Time{1ms * static_cast<std::int64_t>(index) + 2ms});
  }
  EXPECT_TRUE(binomial_fits(times.size(), n, 0.7));
  EXPECT_TRUE(binomial_fits(copies, times.size(), 0.1));
}

TEST(Duplicate, CopiesEveryDatagramAtProbabilityOne) {
  PathSpec spec;
  spec.duplicate = {.probability = 1, .delay_max = Duration{}};
  const auto all = arrivals(spec, 100);
  ASSERT_EQ(all.size(), 200U);
  for (std::size_t i = 0; i < all.size(); ++i) {
    EXPECT_EQ(all[i].index, i / 2);
    EXPECT_EQ(all[i].at, all[i].sent);
  }
}

TEST(Duplicate, FollowsAReorderedDatagram) {
  PathSpec spec;
  spec.reorder = {.probability = 0.2, .displacement = 2};
  spec.duplicate = {.probability = 1, .delay_max = 1ms};
  std::map<std::uint64_t, std::vector<Time>> times;
  for (const Delivery& d : arrivals(spec, 5'000)) times[d.index].push_back(d.at);
  ASSERT_EQ(times.size(), 5'000U);
  for (const auto& [index, at] : times) {
    ASSERT_EQ(at.size(), 2U) << index;
    ASSERT_LE(at[1] - at[0], 1ms);
  }
}

}  // namespace
}  // namespace tandem::netsim
