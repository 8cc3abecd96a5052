#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

#include "netsim/engine/network.h"
#include "tests/netsim/support.h"

/// Properties that hold for every model, checked on a network with one client and the same path in both directions.
namespace tandem::netsim::test {

/// Sends random sizes at random times and polls irregularly. Checks in + copies = out + dropped + in flight at all
/// times.
/// @return the counters after all datagrams have left
inline PathCounters conserved(const PathSpec& path, std::uint64_t seed) {
  Network network{seed};
  network.add_link({path, path});
  RandomStream random{seed};
  std::array<std::byte, kSlotBytes> buffer;
  std::uint64_t in = 0, out = 0;
  Time now{};
  for (int i = 0; i < 20'000; ++i) {
    now += Duration{static_cast<std::int64_t>(random.below(1'500'000))};
    network.send(now, 0, Direction::kUp, datagram(0, 16 + random.below(300)));
    ++in;
    if (random.below(3) == 0) {
      while (network.poll(now, 0, Direction::kUp, buffer)) ++out;
    }
    const PathCounters& c = network.counters(0, Direction::kUp);
    EXPECT_EQ(c.in, in);
    EXPECT_EQ(c.out, out);
    EXPECT_GE(c.in + c.copies, c.out + c.dropped());
    if (testing::Test::HasFailure()) return c;  // report one failure only
  }
  while (network.poll(now + 20s, 0, Direction::kUp, buffer)) ++out;
  const PathCounters& c = network.counters(0, Direction::kUp);
  EXPECT_EQ(c.in_flight(), 0U);
  EXPECT_EQ(c.in + c.copies, out + c.dropped());
  EXPECT_EQ(network.next_due(), std::nullopt);
  return c;
}

/// Returns the arrivals of one datagram per millisecond, polled every `poll_every` datagrams.
inline std::vector<std::pair<std::uint64_t, Time>> arrivals(const PathSpec& path, int poll_every) {
  Network network{3};
  network.add_link({path, path});
  std::array<std::byte, kSlotBytes> buffer;
  std::vector<std::pair<std::uint64_t, Time>> log;
  Time now{};
  for (int i = 0; i < 10'000; ++i, now += 1ms) {
    network.send(now, 0, Direction::kUp, datagram(1));
    if (i % poll_every != 0) continue;
    while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) log.emplace_back(d->index, d->at);
  }
  while (const auto d = network.poll(now + 10s, 0, Direction::kUp, buffer)) log.emplace_back(d->index, d->at);
  return log;
}

}  // namespace tandem::netsim::test
