#include "netsim/engine/network.h"

#include <gtest/gtest.h>

#include <cstring>
#include <vector>

#include "tests/netsim/engine/network_loops.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Buffer = std::array<std::byte, kSlotBytes>;

TEST(Network, DeliversTheBytesItWasGiven) {
  Network network{1};
  network.add_link(link_from({.delay = 5ms}));
  Buffer buffer;
  for (const std::size_t size : {std::size_t{0}, std::size_t{1}, std::size_t{300}, kSlotBytes}) {
    const auto sent = datagram(0xabcdef0123456789, size);
    EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, sent), Outcome::kDeliver);
    EXPECT_FALSE(network.poll(Time{5ms - 1ns}, 0, Direction::kUp, buffer));
    const auto got = network.poll(Time{5ms}, 0, Direction::kUp, buffer);
    ASSERT_TRUE(got);
    ASSERT_EQ(got->size, size);
    EXPECT_TRUE(std::equal(sent.begin(), sent.end(), buffer.begin()));
    EXPECT_FALSE(network.poll(Time{5ms}, 0, Direction::kUp, buffer));
  }
}

TEST(Network, DeliversAtOnceAndInOrderWithoutDelay) {
  Network network{1};
  network.add_link({});
  Buffer buffer;
  for (std::uint64_t i = 0; i < 10; ++i) network.send(Time{7ms}, 0, Direction::kDown, datagram(i));
  EXPECT_EQ(network.next_due(), Time{7ms});
  for (std::uint64_t i = 0; i < 10; ++i) {
    const auto got = network.poll(Time{7ms}, 0, Direction::kDown, buffer);
    ASSERT_TRUE(got);
    EXPECT_EQ(got->index, i);
    EXPECT_EQ(got->at, Time{7ms});
  }
  EXPECT_EQ(network.next_due(), std::nullopt);
}

TEST(Network, PollAnyFollowsTimeThenLinkThenDirection) {
  Network network{1};
  network.add_link(link_from({.delay = 3ms}));
  network.add_link(link_from({.delay = 1ms}));
  network.add_link(link_from({.delay = 1ms}));
  Buffer buffer;
  for (const std::uint32_t link : {2U, 0U, 1U}) {
    for (const Direction direction : {Direction::kDown, Direction::kUp}) {
      network.send(Time{}, link, direction, datagram(link));
    }
  }
  std::string order;
  while (const auto got = network.poll_any(Time{10ms}, buffer)) {
    order += std::to_string(got->link) + (got->direction == Direction::kUp ? "u " : "d ");
  }
  EXPECT_EQ(order, "1u 1d 2u 2d 0u 0d ");
}

TEST(Network, RejectsAndCountsDatagramsItCannotStore) {
  Network network{1};
  network.add_link({});
  Buffer buffer;
  EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, datagram(1, kSlotBytes + 1)), Outcome::kTooLong);
  EXPECT_EQ(network.send(Time{}, 0, Direction::kUp, datagram(1, 65'507)), Outcome::kTooLong);
  EXPECT_EQ(network.send(Time{}, 5, Direction::kUp, datagram(1)), Outcome::kOverflow);
  EXPECT_FALSE(network.poll(Time{}, 5, Direction::kUp, buffer));
  const auto& counters = network.counters(0, Direction::kUp);
  EXPECT_EQ(counters.of(Outcome::kTooLong), 2U);
  EXPECT_EQ(counters.in_flight(), 0U);
}

TEST(Network, KeepsTenSecondsOfOneKilohertzThenOverflows) {
  Network network{1};
  network.add_link({});
  const auto bytes = datagram(1);
  for (int i = 0; i < 10'000; ++i) ASSERT_EQ(network.send(Time{i * 1ms}, 0, Direction::kUp, bytes), Outcome::kDeliver);
  Outcome last = Outcome::kDeliver;
  for (int i = 0; i < 10'000; ++i) last = network.send(Time{10s}, 0, Direction::kUp, bytes);
  EXPECT_EQ(last, Outcome::kOverflow);
  const auto& counters = network.counters(0, Direction::kUp);
  EXPECT_EQ(counters.in, 20'000U);
  EXPECT_EQ(counters.in_flight() + counters.of(Outcome::kOverflow), 20'000U);
}

TEST(Network, KeepsAMinuteOfDelayAtOneKilohertz) {
  Network network{1};
  network.add_link(link_from({.delay = 60s}));
  Buffer buffer;
  const auto bytes = datagram(1);
  std::uint64_t out = 0;
  for (int i = 0; i < 125'000; ++i) {
    ASSERT_EQ(network.send(Time{i * 1ms}, 0, Direction::kUp, bytes), Outcome::kDeliver);
    while (network.poll(Time{i * 1ms}, 0, Direction::kUp, buffer)) ++out;
  }
  EXPECT_EQ(out, 65'000U);
}

TEST(Network, ConservesDatagramsAtEveryInstant) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const PathCounters c = conserved(everything(), seed);
    for (const Outcome outcome : {Outcome::kOutage, Outcome::kHoldFull, Outcome::kLost, Outcome::kHeldBack}) {
      EXPECT_GT(c.of(outcome), 0U) << name(outcome);
    }
    EXPECT_GT(c.copies, 0U);
  }
}

TEST(Network, IsIndependentOfThePollTimes) { EXPECT_EQ(arrivals(everything(), 1), arrivals(everything(), 500)); }

/// Returns a digest of all decisions of link 0 while `others` more links are busy.
std::uint64_t decision_digest(std::uint64_t seed, std::size_t others, std::size_t other_size = 64) {
  Network network{seed};
  for (std::size_t i = 0; i <= others; ++i) network.add_link({everything(), everything()});
  Digest digest;
  Buffer buffer;
  for (int i = 0; i < 20'000; ++i) {
    const Time now{i * 1ms};
    for (std::uint32_t other = 1; other <= others; ++other) {
      network.send(now, other, i % 2 == 0 ? Direction::kUp : Direction::kDown, datagram(1, other_size));
    }
    for (const Direction direction : {Direction::kUp, Direction::kDown}) {
      digest.add(static_cast<std::uint64_t>(network.send(now, 0, direction, datagram(1))));
      while (const auto d = network.poll(now, 0, direction, buffer)) {
        digest.add(d->index);
        digest.add(static_cast<std::uint64_t>(d->at.time_since_epoch().count()));
      }
    }
  }
  return digest.value();
}

TEST(Network, RepeatsDecisionsOfASeedDespiteOtherFlows) {
  const std::uint64_t alone = decision_digest(42, 0);
  EXPECT_EQ(decision_digest(42, 0), alone);
  EXPECT_EQ(decision_digest(42, 2), alone);
  EXPECT_EQ(decision_digest(42, 2, 999), alone);
  EXPECT_NE(decision_digest(43, 0), alone);
}

// Changes only if a model or the derivation of keys changes; stored seeds then give other networks.
TEST(Network, KeepsTheRecordedDecisionsOfASeed) { EXPECT_EQ(decision_digest(1, 0), 0x200c91e72e528129ULL); }

TEST(Network, ChangesNoOtherDecisionWhenAModelIsEnabled) {
  // Loss verdicts do not depend on the delay; delays do not depend on models enabled after them.
  PathSpec plain;
  plain.loss.probability = 0.1;
  PathSpec more = everything();
  more.loss = plain.loss;
  more.outages.clear();
  more.rate = {};
  const auto a = decisions(path_of(plain), 20'000);
  const auto b = decisions(path_of(more), 20'000);
  for (std::size_t i = 0; i < a.size(); ++i) {
    ASSERT_EQ(a[i].outcome == Outcome::kLost, b[i].outcome == Outcome::kLost) << i;
  }
}

TEST(Network, StreamsAreIndependent) {
  // Loss of two directions, two links and two purposes: correlation below 4/sqrt(n).
  constexpr std::size_t n = 400'000;
  PathSpec spec;
  spec.loss.probability = 0.5;
  spec.duplicate.probability = 0.5;
  const auto bits = [&](std::uint64_t link, Direction direction, bool copies) {
    PathSpec own = spec;
    if (copies) own.loss.probability = 0;
    Path path{own, Path::key_for(1, link, direction)};
    std::vector<double> x;
    for (std::size_t i = 0; i < n; ++i) {
      const PathDecision v = path.send(Time{}, kSize);
      x.push_back((copies ? v.copied : v.outcome == Outcome::kLost) ? 1 : -1);
    }
    return x;
  };
  const std::vector<std::vector<double>> streams{bits(0, Direction::kUp, false), bits(0, Direction::kDown, false),
                                                 bits(1, Direction::kUp, false), bits(0, Direction::kUp, true)};
  for (std::size_t i = 0; i < streams.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      double sum = 0;
      for (std::size_t k = 0; k < n; ++k) sum += streams[i][k] * streams[j][k];
      EXPECT_LT(std::abs(sum / n), 4 / std::sqrt(static_cast<double>(n))) << i << " " << j;
    }
  }
}

TEST(Network, TakesNoHeapOnThePacketPath) {
  Network network{5};
  network.add_link({everything(), everything()});
  network.add_link({});
  const auto bytes = datagram(1);
  Buffer buffer;
  const tandem::test::AllocGuard guard;
  std::size_t out = 0;
  for (int i = 0; i < 30'000; ++i) {
    const Time now{i * 500us};
    for (const std::uint32_t link : {0U, 1U}) {
      for (const Direction direction : {Direction::kUp, Direction::kDown}) {
        network.send(now, link, direction, bytes);
        while (network.poll(now, link, direction, buffer)) ++out;
      }
    }
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(out, 60'000U);
}

}  // namespace
}  // namespace tandem::netsim
