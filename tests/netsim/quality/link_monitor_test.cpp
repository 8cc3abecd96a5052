#include "netsim/quality/link_monitor.h"

#include <gtest/gtest.h>

#include "netsim/engine/network.h"
#include "netsim/proxy/proxy_core.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Buffer = std::array<std::byte, kSlotBytes>;

/// Both ends poll the network and then send, every millisecond.
template <typename Each>
void converse(Network& network, int count, Each&& each) {
  Buffer buffer;
  for (int i = 0; i < count; ++i) {
    const Time now{1ms * i};
    while (const auto d = network.poll(now, 0, Direction::kDown, buffer)) each(*d);
    network.send(now, 0, Direction::kUp, datagram(static_cast<std::uint64_t>(i)));
    while (const auto d = network.poll(now, 0, Direction::kUp, buffer)) each(*d);
    network.send(now, 0, Direction::kDown, datagram(static_cast<std::uint64_t>(i)));
  }
}

TEST(LinkMonitor, MeasuresDelayAndLossOfTheNetwork) {
  LinkSpec spec = link_from({.delay = 10ms});
  spec.down = link_from({.delay = 20ms}).down;
  spec.up.outages = {{.start = 5s, .length = 400ms}};
  Network network{1};
  network.add_link(spec);
  LinkMonitor watch;
  network.attach_monitor(0, &watch);
  converse(network, 20'001, [](const Delivery&) {});
  const LinkSummary s = watch.summary();
  EXPECT_EQ(s.up.sent, 20'001U);
  EXPECT_EQ(s.up.lost, 400U);
  EXPECT_EQ(s.up.lost, network.counters(0, Direction::kUp).dropped());
  EXPECT_EQ(s.up.arrived, network.counters(0, Direction::kUp).out);
  EXPECT_EQ(s.up.longest_gap, 401ms);
  EXPECT_EQ(s.up.longest_gap_at, Time{5009ms});
  EXPECT_EQ(s.up.windows[0].of(Measure::kLoss).worst, 1.0);
  EXPECT_EQ(s.down.longest_gap, 1ms);
  EXPECT_EQ(s.down.lost, 0U);
  // The first ten ticks have nothing to answer; the last twenty answers are in flight. All others take 10 + 20 ms.
  EXPECT_EQ(s.round_trip.delay.count, 20'001U - 10 - 20);
  EXPECT_EQ(s.round_trip.delay.p5, 30ms);
  EXPECT_EQ(s.round_trip.delay.max, 30ms);
  EXPECT_EQ(s.round_trip.windows[1].bands[1], s.round_trip.windows[1].windows) << "amber: above 20 ms";
  EXPECT_GT(s.round_trip.windows[1].windows, 1800U);
}

TEST(LinkMonitor, MeasuresRoundTripsOfTheNewestDatagram) {
  LinkMonitor watch;
  const auto up = [&](int at, int delay, std::uint64_t index) {
    watch.sent(Direction::kUp, Time{1ms * at}, index);
    watch.arrived(Direction::kUp, Time{1ms * at}, Time{1ms * (at + delay)}, index);
  };
  watch.sent(Direction::kDown, Time{1ms}, 0);  // no datagram up to answer yet
  watch.arrived(Direction::kDown, Time{1ms}, Time{3ms}, 0);
  up(5, 7, 1);
  up(4, 9, 0);  // arrives later but was sent earlier: the newest is unchanged
  watch.sent(Direction::kDown, Time{20ms}, 1);
  up(21, 4, 2);
  watch.arrived(Direction::kDown, Time{20ms}, Time{26ms}, 1);  // answers the newest arrival so far: 7 + 6
  watch.arrived(Direction::kDown, Time{20ms}, Time{27ms}, 1);  // a copy is no answer
  const DelaySummary trips = watch.summary().round_trip.delay;
  EXPECT_EQ(trips.count, 1U);
  EXPECT_EQ(trips.max, 13ms);
}

TEST(LinkMonitor, HasNoSideEffectAndRunsWithoutHeap) {
  LinkSpec spec = link_from({.delay = 3ms, .jitter = 5ms, .loss = 0.1, .duplicate = 0.05, .reorder = 0.02});
  Network plain{9}, watched{9};
  plain.add_link(spec);
  watched.add_link(spec);
  LinkMonitor watch;
  watched.attach_monitor(0, &watch);
  std::vector<std::pair<Time, std::uint64_t>> a, b;
  a.reserve(30'000);
  b.reserve(30'000);
  converse(plain, 10'000, [&](const Delivery& d) { a.emplace_back(d.at, d.index); });
  converse(watched, 10'000, [&](const Delivery& d) { b.emplace_back(d.at, d.index); });
  EXPECT_EQ(a, b);
  Buffer buffer;
  const auto bytes = datagram(1);
  const tandem::test::AllocGuard guard;
  for (int i = 10'000; i < 20'000; ++i) {
    watched.send(Time{1ms * i}, 0, Direction::kUp, bytes);
    while (watched.poll(Time{1ms * i}, 0, Direction::kUp, buffer)) continue;
  }
  EXPECT_EQ(guard.count(), 0U);
  const LinkSummary s = watch.summary();
  EXPECT_EQ(s.up.duplicates, watched.counters(0, Direction::kUp).copies);
  EXPECT_GT(s.up.reordered, 100U);
}

TEST(LinkMonitor, DoesNotCountADroppedCopyAsLoss) {
  LinkMonitor watch;
  DelayQueue queue{8};
  PathCounters counters;
  DecisionTap tap;
  tap.monitor = &watch;
  const auto bytes = datagram(1);
  const PathDecision copy_lost{
      .index = 0, .at = Time{1ms}, .copied = true, .copy_delay = 1ms, .copy_outcome = Outcome::kLost, .released = {}};
  submit(copy_lost, queue, counters, tap, {.now = Time{}}, bytes);
  const PathDecision lost{.outcome = Outcome::kLost, .index = 1, .at = Time{}, .released = {}};
  submit(lost, queue, counters, tap, {.now = Time{}}, bytes);
  const auto item = queue.take(Time{1ms});
  ASSERT_TRUE(item);
  leave(*item, bytes.size(), Outcome::kDeliver, counters, tap);
  const DirectionSummary s = watch.summary().up;
  EXPECT_EQ(s.sent, 2U);
  EXPECT_EQ(s.arrived, 1U);
  EXPECT_EQ(s.lost, 1U);
}

TEST(LinkMonitor, JudgesProxyAndVirtualNetworkAlike) {
  const LinkSpec spec = link_from({.delay = 3ms, .jitter = 5ms, .loss = 0.1});
  Network network{5};
  network.add_link(spec);
  ProxyCore proxy{spec, 5};
  const auto client = proxy.add_client();
  ASSERT_TRUE(client);
  LinkMonitor in_network, in_proxy;
  network.attach_monitor(0, &in_network);
  proxy.attach_monitor(*client, &in_proxy);
  Buffer buffer;
  const auto bytes = datagram(1);
  for (int i = 0; i < 12'000; ++i) {
    const Time now{1ms * i};
    network.send(now, 0, Direction::kUp, bytes);
    proxy.ingress(now, *client, Direction::kUp, bytes);
    while (network.poll(now, 0, Direction::kUp, buffer)) continue;
    while (const auto egress = proxy.take(now)) proxy.done(*egress);
  }
  const DirectionSummary a = in_network.summary().up, b = in_proxy.summary().up;
  EXPECT_EQ(a.lost, b.lost);
  EXPECT_EQ(a.age.p99, b.age.p99);
  for (std::size_t w = 0; w < kWindows; ++w) EXPECT_EQ(a.windows[w].bands, b.windows[w].bands);
  EXPECT_GT(a.lost, 1000U);
}

}  // namespace
}  // namespace tandem::netsim
