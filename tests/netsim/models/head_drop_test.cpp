// Drop-head queue: which datagram is dropped, and when the others leave.
#include "netsim/models/head_drop.h"

#include <gtest/gtest.h>

#include <cstring>
#include <deque>
#include <map>

#include "netsim/engine/network.h"
#include "netsim/profiles/capacity_csv.h"
#include "tests/netsim/engine/network_loops.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;

/// Rate of 1 ms per 100 bytes, without overhead.
RateSpec slow(RateSpec limits) {
  limits.bits_per_s = 800'000;
  limits.overhead_bytes = 0;
  limits.drop = RateSpec::Drop::kHead;
  return limits;
}

/// Verdicts by index for 100-byte datagrams sent at these times; empty: pushed out or rejected.
std::map<std::uint64_t, std::optional<Time>> fates(const PathSpec& spec, const std::vector<Time>& times,
                                                   std::size_t size = 100) {
  Path path = path_of(spec);
  std::map<std::uint64_t, std::optional<Time>> fate;
  const auto settle = [&](Time now) {
    while (const auto s = path.resolve(now)) {
      fate[s->decision.index] = dropped(s->decision.outcome) ? std::nullopt : std::optional{s->decision.at};
    }
  };
  for (const Time now : times) {
    settle(now);
    const PathDecision v = path.send(now, size);
    if (v.outcome != Outcome::kWaiting) fate[v.index] = std::nullopt;
    settle(now);
  }
  settle(Time{1h});
  return fate;
}

TEST(HeadDrop, DropsTheOldestWaitingAndAdvancesTheOthers) {
  // The limit is three: 0 is being sent, 1 and 2 wait. 3 pushes 1 out, 4 pushes 2 out.
  PathSpec spec;
  spec.rate = slow({.queue_datagrams = 3});
  const auto fate = fates(spec, {Time{}, Time{}, Time{}, Time{}, Time{}});
  EXPECT_EQ(fate.at(0), Time{1ms});
  EXPECT_EQ(fate.at(1), std::nullopt);
  EXPECT_EQ(fate.at(2), std::nullopt);
  EXPECT_EQ(fate.at(3), Time{2ms});
  EXPECT_EQ(fate.at(4), Time{3ms});
}

TEST(HeadDrop, NeverDropsTheDatagramBeingSent) {
  PathSpec one;
  one.rate = slow({.queue_datagrams = 1});
  // Only the datagram being sent fits. Datagrams that arrive meanwhile are rejected, because none can be pushed out.
  const auto fate = fates(one, {Time{}, Time{500us}, Time{1ms - 1ns}, Time{1ms}});
  EXPECT_EQ(fate.at(0), Time{1ms});
  EXPECT_EQ(fate.at(1), std::nullopt);
  EXPECT_EQ(fate.at(2), std::nullopt);
  EXPECT_EQ(fate.at(3), Time{2ms});
}

TEST(HeadDrop, CountsBytesAsTheTailDoes) {
  // Limit 300 bytes. At 0.5 ms, 50 bytes of the first are left, so 250 are free: two waiting ones and 50 bytes.
  PathSpec spec;
  spec.rate = slow({.queue_bytes = 300});
  Path path = path_of(spec);
  std::vector<std::uint64_t> gone;
  const auto settle = [&](Time now) {
    while (const auto s = path.resolve(now)) {
      if (s->decision.outcome == Outcome::kPushedOut) gone.push_back(s->decision.index);
    }
  };
  for (int i = 0; i < 3; ++i) path.send(Time{}, 100), settle(Time{});
  EXPECT_EQ(path.send(Time{500us}, 50).outcome, Outcome::kWaiting);
  settle(Time{500us});
  EXPECT_TRUE(gone.empty());
  EXPECT_EQ(path.send(Time{500us}, 1).outcome, Outcome::kWaiting);
  settle(Time{500us});
  EXPECT_EQ(gone, (std::vector<std::uint64_t>{1}));
  // A datagram that would not fit even without the waiting ones is rejected, and none is dropped for it.
  EXPECT_EQ(path.send(Time{500us}, 251).outcome, Outcome::kQueueFull);
  settle(Time{500us});
  EXPECT_EQ(gone.size(), 1U);
  EXPECT_EQ(path.send(Time{500us}, 250).outcome, Outcome::kWaiting);
  settle(Time{500us});
  EXPECT_EQ(gone, (std::vector<std::uint64_t>{1, 2, 3, 4}));
}

TEST(HeadDrop, KeepsTheLimitOfWaiting) {
  // The maximum wait is 2.5 ms. Four at once would wait 0, 1, 2, 3 ms. The fourth pushes 1 out and waits 2 ms.
  PathSpec spec;
  spec.rate = slow({.queue_wait = 2'500us});
  const auto fate = fates(spec, {Time{}, Time{}, Time{}, Time{}});
  EXPECT_EQ(fate.at(0), Time{1ms});
  EXPECT_EQ(fate.at(1), std::nullopt);
  EXPECT_EQ(fate.at(2), Time{2ms});
  EXPECT_EQ(fate.at(3), Time{3ms});
}

TEST(HeadDrop, WorksOnRecordedCapacity) {
  // Opportunities at 2 and 5 ms, repeated every 6 ms. Three datagrams fit; the fourth pushes the first out.
  auto link = parse_capacity("2\n5\n", "c.trace");
  ASSERT_TRUE(link);
  PathSpec spec = link->up;
  spec.rate.overhead_bytes = 0;
  spec.rate.queue_datagrams = 3;
  spec.rate.drop = RateSpec::Drop::kHead;
  const auto fate = fates(spec, {Time{}, Time{}, Time{}, Time{}, Time{3ms}}, 1500);
  EXPECT_EQ(fate.at(0), std::nullopt);
  EXPECT_EQ(fate.at(1), Time{2ms});
  EXPECT_EQ(fate.at(2), Time{5ms});
  EXPECT_EQ(fate.at(3), Time{8ms});
  EXPECT_EQ(fate.at(4), Time{11ms});
}

TEST(HeadDrop, MatchesTailDropWhenNothingIsDropped) {
  // Twin: below its limit, the drop-head queue gives every datagram the same time as the tail-drop queue. Times agree
  // to the nanosecond, at an uneven rate and with all other models.
  PathSpec tail = everything();
  tail.outages.clear();
  tail.rate = {.bits_per_s = 1'333'337, .queue_datagrams = 60'000};
  PathSpec head = tail;
  head.rate.drop = RateSpec::Drop::kHead;
  for (const Duration period : {Duration{1ms}, Duration{700us}}) {
    std::map<std::uint64_t, PathDecision> late;
    Path path = path_of(head);
    const auto settle = [&](Time now) {
      while (auto s = path.resolve(now)) late[s->decision.index] = s->decision;
    };
    const auto all = decisions(path_of(tail), 20'000, period);
    for (std::size_t i = 0; i < all.size(); ++i) {
      const Time now{period * static_cast<std::int64_t>(i)};
      settle(now);
      const PathDecision v = path.send(now, kSize);
      if (v.outcome != Outcome::kWaiting) late[v.index] = v;
      settle(now);
    }
    settle(Time{1h});
    for (const PathDecision& v : all) {
      ASSERT_EQ(late.at(v.index).outcome, v.outcome) << v.index;
      ASSERT_EQ(late.at(v.index).at, v.at) << v.index;
      ASSERT_EQ(late.at(v.index).copy_delay, v.copy_delay) << v.index;
    }
  }
}

TEST(HeadDrop, AgreesWithASimulationStepByStep) {
  // Twin: a queue of 125-byte datagrams, 1 ms each, at most 5, simulated in steps of half a millisecond.
  PathSpec spec;
  spec.rate = {.bits_per_s = 1'000'000, .overhead_bytes = 0, .queue_datagrams = 5};
  spec.rate.drop = RateSpec::Drop::kHead;
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SCOPED_TRACE(seed);
    RandomStream random{seed};
    std::vector<Time> times;
    std::map<std::uint64_t, std::optional<Time>> expected;
    std::deque<std::uint64_t> waiting;
    std::optional<std::pair<std::uint64_t, int>> sending;  // with the end of sending [half ms]
    for (int half = 0; half < 2000; ++half) {
      if (sending && sending->second == half) sending.reset();
      const auto begin = [&] {
        if (sending || waiting.empty()) return;
        sending = {waiting.front(), half + 2};
        waiting.pop_front();
        expected[sending->first] = Time{sending->second * 500us};
      };
      begin();
      for (std::uint64_t n = random.below(half / 200 % 2 == 0 ? 3 : 2); n > 0; --n) {
        if (waiting.size() + (sending ? 1 : 0) == 5) {
          expected[waiting.front()] = std::nullopt;
          waiting.pop_front();
        }
        waiting.push_back(times.size());
        times.emplace_back(half * 500us);
        begin();
      }
    }
    for (int half = 2000; sending || !waiting.empty(); ++half) {
      if (sending && sending->second == half) sending.reset();
      if (sending || waiting.empty()) continue;
      sending = {waiting.front(), half + 2};
      waiting.pop_front();
      expected[sending->first] = Time{sending->second * 500us};
    }
    EXPECT_EQ(fates(spec, times, 125), expected);
  }
}

TEST(HeadDrop, KeepsTheNewestWhereTheTailKeepsTheOldest) {
  // Purpose of drop-head: a stream of commands has the same loss, but much younger datagrams.
  PathSpec spec;
  spec.rate = {.bits_per_s = 1'000'000, .queue_wait = 200ms};  // 1.248 ms of work every 1 ms
  Network tail{1}, head{1};
  tail.add_link({spec, {}});
  spec.rate.drop = RateSpec::Drop::kHead;
  head.add_link({spec, {}});
  for (int i = 0; i < 20'000; ++i) {
    for (Network* network : {&tail, &head}) network->send(Time{i * 1ms}, 0, Direction::kUp, datagram(1));
    std::array<std::byte, kSlotBytes> buffer;
    for (Network* network : {&tail, &head}) {
      while (network->poll(Time{i * 1ms}, 0, Direction::kUp, buffer)) {
      }
    }
  }
  const PathCounters &t = tail.counters(0, Direction::kUp), &h = head.counters(0, Direction::kUp);
  EXPECT_EQ(t.of(Outcome::kPushedOut), 0U);
  EXPECT_EQ(h.of(Outcome::kQueueFull), 0U);
  EXPECT_NEAR(static_cast<double>(t.of(Outcome::kQueueFull)), static_cast<double>(h.of(Outcome::kPushedOut)), 200);
  EXPECT_EQ(h.in_flight() + h.out + h.dropped(), h.in);
}

/// Path with every model that defers verdicts, and all other models.
PathSpec fickle() {
  PathSpec spec = everything();
  spec.rate.drop = RateSpec::Drop::kHead;
  spec.rate.bits_per_s = 1'200'000;
  spec.rate.queue_bytes = 3000;
  spec.outages.push_back({.length = 20ms, .mode = OutageSpec::Mode::kHoldLast, .mean_gap = 500ms, .length_max = 90ms});
  spec.corruption = {.probability = 0.05, .mode = CorruptionSpec::Mode::kTruncate};
  return spec;
}

TEST(HeadDrop, ConservesDatagramsAtEveryInstant) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    SCOPED_TRACE(seed);
    const PathCounters c = conserved(fickle(), seed);
    for (const Outcome outcome : {Outcome::kPushedOut, Outcome::kReplaced, Outcome::kLost, Outcome::kHeldBack}) {
      EXPECT_GT(c.of(outcome), 0U) << name(outcome);
    }
    EXPECT_GT(c.truncated, 0U);
  }
}

TEST(HeadDrop, IsIndependentOfThePollTimes) {
  const auto often = arrivals(fickle(), 1);
  EXPECT_EQ(often, arrivals(fickle(), 7));
  EXPECT_EQ(often, arrivals(fickle(), 500));
}

TEST(HeadDrop, MissesNothingIfPolledAtDueTimes) {
  Network network{4};
  network.add_link({fickle(), fickle()});
  std::array<std::byte, kSlotBytes> buffer;
  Time now{};
  for (int i = 0; i < 5'000; ++i) {
    const Time next_send{i * 1ms};
    while (const auto due = network.next_due(0, Direction::kUp)) {
      if (*due > next_send) break;
      ASSERT_GE(*due, now - 1ms) << i;
      now = std::max(now, *due);
      while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) {
        ASSERT_EQ(d->at, now) << i;  // woken exactly on time
      }
    }
    now = next_send;
    while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) ASSERT_EQ(d->at, now);
    network.send(now, 0, Direction::kUp, datagram(1));
  }
}

TEST(HeadDrop, TakesNoHeap) {
  Network network{5};
  network.add_link({fickle(), fickle()});
  const auto bytes = datagram(1);
  std::array<std::byte, kSlotBytes> buffer;
  const tandem::test::AllocGuard guard;
  std::size_t out = 0;
  for (int i = 0; i < 20'000; ++i) {
    network.send(Time{i * 500us}, 0, Direction::kUp, bytes);
    while (network.poll(Time{i * 500us}, 0, Direction::kUp, buffer)) ++out;
  }
  EXPECT_EQ(guard.count(), 0U);
  EXPECT_GT(out, 1000U);
}

TEST(HeadDrop, RejectsAContradictorySpec) {
  const auto keys = [](RateSpec rate) {
    PathSpec spec;
    spec.rate = std::move(rate);
    spec.rate.drop = RateSpec::Drop::kHead;
    std::string text;
    for (const SpecError& problem : problems(spec)) text += problem.key + " ";
    return text;
  };
  EXPECT_EQ(keys({.bits_per_s = 1000}), "rate.drop ");
  EXPECT_EQ(keys({}), "rate.drop rate.drop ");
  EXPECT_EQ(keys({.bits_per_s = 1000, .queue_datagrams = 4, .codel = CoDelSpec{}}), "rate.codel ");
  EXPECT_EQ(keys({.bits_per_s = 1000, .competing_peak = 1s, .competing_period = 2s, .queue_datagrams = 4}),
            "rate.competing_peak ");
}

}  // namespace
}  // namespace tandem::netsim
