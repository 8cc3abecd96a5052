#include <gtest/gtest.h>

#include <stdexcept>

#include "netsim/engine/addresses.h"
#include "netsim/engine/network.h"
#include "netsim/proxy/proxy_core.h"
#include "tests/netsim/engine/decision_matrix.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;
using Buffer = std::array<std::byte, kSlotBytes>;

LinkSpec both(const PathSpec& path) { return {path, path}; }

/// Returns the arrivals of 97-byte datagrams (125 with overhead: 1000 bits) sent up at these times.
std::vector<Time> arrivals(const LinkSchedule& schedule, const std::vector<Duration>& times) {
  Network network{1};
  network.add_link(schedule, 0);
  Buffer buffer;
  std::vector<Time> all;
  for (const Duration t : times) network.send(Time{t}, 0, Direction::kUp, datagram(1, 97));
  while (const auto d = network.poll_any(Time{1h}, buffer)) all.push_back(d->at);
  return all;
}

TEST(Schedule, AppliesAnOutageToItsClientOnly) {
  const NetworkEvent events[] = {{.at = 12ms, .clients = {"trainee"}, .outage = OutageSpec{.length = 4ms}}};
  for (const char* client : {"trainer", "trainee"}) {
    Network network{1};
    network.add_link(schedule_for(link_from({.delay = 1ms}), events, client), 0);
    std::string verdicts;
    for (int i = 8; i < 20; ++i) {
      verdicts += network.send(Time{i * 1ms}, 0, Direction::kUp, datagram(1)) == Outcome::kOutage ? 'x' : '-';
    }
    EXPECT_EQ(verdicts, client == std::string("trainee") ? "----xxxx----" : "------------");
  }
}

TEST(Schedule, AppliesAChangeFromItsTime) {
  const LinkSchedule schedule{.initial = link_from({.delay = 5ms}),
                              .changes = {{10ms, link_from({.delay = 50ms})}, {20ms, link_from({.delay = 2ms})}}};
  // Two changes between two datagrams both take effect.
  EXPECT_EQ(arrivals(schedule, {0ms, 9'999'999ns, 10ms}),
            (std::vector<Time>{Time{5ms}, Time{14'999'999ns}, Time{60ms}}));
  EXPECT_EQ(arrivals(schedule, {0ms, 100ms}), (std::vector<Time>{Time{5ms}, Time{102ms}}));
}

TEST(Schedule, KeepsOrderAcrossAChangeToAFasterLink) {
  const LinkSchedule schedule{.initial = link_from({.delay = 50ms}), .changes = {{10ms, link_from({.delay = 2ms})}}};
  EXPECT_EQ(arrivals(schedule, {9ms, 10ms, 40ms, 58ms}),
            (std::vector<Time>{Time{59ms}, Time{59ms}, Time{59ms}, Time{60ms}}));
}

TEST(Schedule, ServesTheQueueAtTheNewRate) {
  LinkSpec slow, fast;
  slow.up.rate.bits_per_s = 100'000;    // 10 ms per datagram
  fast.up.rate.bits_per_s = 1'000'000;  // 1 ms
  // Three at 0 end at 10, 20, 30 ms. At 10 ms 2000 bits are left: 20 ms at the slow rate, 2 ms at the fast one.
  const LinkSchedule faster{.initial = slow, .changes = {{10ms, fast}}};
  // Sent at 10 ms: 2 ms for the queue plus 1 ms give 13 ms, but not before the earlier result of 30 ms.
  EXPECT_EQ(arrivals(faster, {0ms, 0ms, 0ms, 10ms, 29ms, 30ms}),
            (std::vector<Time>{Time{10ms}, Time{20ms}, Time{30ms}, Time{30ms}, Time{30ms}, Time{31ms}}));
  // Reverse case: three at 0 end at 1, 2, 3 ms. At 1 ms 2000 bits are left: 20 ms at the slow rate.
  const LinkSchedule slower{.initial = fast, .changes = {{1ms, slow}}};
  EXPECT_EQ(arrivals(slower, {0ms, 0ms, 0ms, 1ms, 100ms}),
            (std::vector<Time>{Time{1ms}, Time{2ms}, Time{3ms}, Time{31ms}, Time{110ms}}));
  // To a link without a rate and back: the queue is then empty.
  const LinkSchedule none{.initial = slow, .changes = {{1ms, LinkSpec{}}, {2ms, slow}}};
  EXPECT_EQ(arrivals(none, {0ms, 0ms, 1ms, 50ms}), (std::vector<Time>{Time{10ms}, Time{20ms}, Time{20ms}, Time{60ms}}));
}

TEST(Schedule, KeepsDatagramsHeldByAnOutage) {
  LinkSpec base = link_from({.delay = 1ms});
  const NetworkEvent events[] = {{.at = 10ms, .outage = OutageSpec{.length = 100ms, .mode = OutageSpec::Mode::kHold}},
                                 {.at = 50ms, .link = link_from({.delay = 3ms})}};
  EXPECT_EQ(arrivals(schedule_for(base, events, "1"), {20ms, 60ms, 109ms, 110ms}),
            (std::vector<Time>{Time{111ms}, Time{113ms}, Time{113ms}, Time{113ms}}));
}

TEST(Schedule, CountsDatagramsOfTheNextLinkForReordering) {
  LinkSpec reorders, plain;
  reorders.up.reorder = {.probability = 1, .displacement = 2, .hold_limit = 50ms};
  const LinkSchedule schedule{.initial = reorders, .changes = {{1ms, plain}}};
  Network network{1};
  network.add_link(schedule, 0);
  Buffer buffer;
  for (const Duration t : {0ms, 1ms, 2ms, 3ms}) network.send(Time{t}, 0, Direction::kUp, datagram(1));
  std::string order;
  while (const auto d = network.poll_any(Time{10ms}, buffer)) order += std::to_string(d->index);
  EXPECT_EQ(order, "1203");
}

// Strongest continuity property: a change without effect leaves every decision unchanged.
TEST(Schedule, ChangesNoDecisionForAChangeRevertedAtOnce) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const auto run = [seed](bool away, bool counted) {
      PathSpec spec = everything();
      if (counted) spec.loss.gilbert_elliott = GilbertElliottSpec{.p = 0.02, .r = 0.3};
      LinkSchedule schedule{.initial = both(spec)};
      if (away) {
        // Loss, queue and slots are equal, so their state continues; all other models are functions of time.
        PathSpec other = spec;
        other.duplicate.probability = 0;
        schedule.changes = {{1s, both(other)}, {1s + 1ns, both(spec)}, {3s, both(other)}, {3s + 1ns, both(spec)}};
      }
      Network network{seed};
      network.add_link(schedule, 0);
      return log_of(network, {{.seed = seed}});
    };
    EXPECT_EQ(difference(run(true, false), run(false, false)), "") << seed;
    EXPECT_EQ(difference(run(true, true), run(false, true)), "") << seed;
  }
}

TEST(Schedule, DrawsForALaterLinkAsIfPresentFromTheStart) {
  PathSpec lossy;
  lossy.loss = {.probability = 0.1, .periods = BadPeriodsSpec{.good_mean = 300ms, .bad_mean = 50ms, .loss_bad = 0.7}};
  lossy.body = {.kind = BodySpec::Kind::kLogNormal, .scale = 4ms, .shape = 0.8, .cap = 60ms, .tau = 20ms};
  lossy.stall = {.rate_per_s = 1, .length_min = 10ms, .alpha = 1.5, .cap = 200ms};
  const auto run = [&](const LinkSchedule& schedule) {
    Network network{4};
    network.add_link(schedule, 0);
    auto rows = log_of(network, {{.seed = 4}});
    std::erase_if(rows,
                  [](const Decision& d) { return d.in < Time{2500ms}; });  // half a second until the order settles
    return rows;
  };
  EXPECT_EQ(difference(run({.initial = {}, .changes = {{2s, both(lossy)}}}), run({.initial = both(lossy)})), "");
}

TEST(Schedule, KeepsDatagramsAndCountsAcrossManyChanges) {
  LinkSchedule schedule{.initial = both(everything())};
  for (int i = 1; i <= 50; ++i) {
    PathSpec spec = everything();
    spec.floor = i * 1ms;
    if (i % 3 == 0) spec.rate.bits_per_s = 700'000;
    if (i % 7 == 0) spec.rate.queue_datagrams = 20;
    if (i % 4 == 0) spec.rate = {};
    if (i % 5 == 0) spec.reorder = {};
    schedule.changes.push_back({i * 90ms, both(spec)});
  }
  Network network{6};
  network.add_link(schedule, 0);
  const auto rows = log_of(network, {{.seed = 6}});
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    std::uint64_t next = 0;
    Time last{};
    for (const Decision& d : rows) {
      if (d.direction != direction || d.copy) continue;
      EXPECT_EQ(d.index, next++);
      if (d.outcome != Outcome::kDeliver) continue;
      EXPECT_GE(d.out, last);
      last = d.out;
    }
    const PathCounters& c = network.counters(0, direction);
    EXPECT_EQ(c.in, next);
    EXPECT_EQ(c.in + c.copies, c.out + c.dropped() + c.in_flight());
  }
}

TEST(Schedule, ChangesLinksWithoutHeapOnThePacketPath) {
  LinkSchedule schedule{.initial = both(everything())};
  for (int i = 1; i <= 20; ++i) {
    PathSpec spec = everything();
    spec.floor = i * 1ms;
    spec.rate.queue_datagrams = i % 2 == 0 ? 30 : 60;
    schedule.changes.push_back({i * 100ms, both(spec)});
  }
  schedule.rebinds = {{500ms, {20ms}}, {1s, {20ms}}};
  Network network{6};
  network.add_link(schedule, 0);
  const auto bytes = datagram(1);
  Buffer buffer;
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 5'000; ++i) {
    network.send(Time{i * 500us}, 0, static_cast<Direction>(i % 2), bytes);
    while (network.poll_any(Time{i * 500us}, buffer)) {
    }
  }
  EXPECT_EQ(guard.count(), 0U);
}

// ---- Addresses

TEST(Addresses, ChangeAtTheirTimeAndExpireLater) {
  const LinkSchedule::AddressChange changes[] = {{10ms, {5ms}}, {20ms, {0ms}}};
  Addresses addresses{changes};
  EXPECT_EQ(addresses.current(Time{10ms - 1ns}), 0U);
  EXPECT_EQ(addresses.current(Time{10ms}), 1U);
  EXPECT_EQ(addresses.current(Time{25ms}), 2U);
  EXPECT_FALSE(addresses.dead(0, Time{15ms - 1ns}));
  EXPECT_TRUE(addresses.dead(0, Time{15ms}));
  EXPECT_TRUE(addresses.dead(1, Time{20ms}));
  EXPECT_FALSE(addresses.dead(2, Time{1h}));
}

TEST(Addresses, AreBounded) {
  Addresses addresses;
  for (std::size_t i = 1; i < Addresses::kMax; ++i) {
    ASSERT_TRUE(addresses.change(Time{static_cast<std::int64_t>(i) * 1ms}, {}));
  }
  EXPECT_FALSE(addresses.change(Time{1h}, {}));
  EXPECT_EQ(addresses.current(Time{2h}), Addresses::kMax - 1);
}

TEST(Addresses, IdentifySendersAndDropDatagramsForOldAddresses) {
  Network network{1};
  network.add_link({.initial = link_from({.delay = 2ms}), .rebinds = {{10ms, {5ms}}}}, 0);
  Buffer buffer;
  const auto up = [&](Duration sent) {
    network.send(Time{sent}, 0, Direction::kUp, datagram(1));
    const auto d = network.poll(Time{sent + 2ms}, 0, Direction::kUp, buffer);
    return d ? static_cast<int>(d->address) : -1;
  };
  const auto down = [&](Duration sent, std::uint32_t address) {
    network.send_to(Time{sent}, 0, address, datagram(1));
    const auto d = network.poll(Time{sent + 2ms}, 0, Direction::kDown, buffer);
    return d ? static_cast<int>(d->address) : -1;
  };
  EXPECT_EQ(up(8ms), 0);
  EXPECT_EQ(down(8ms, 0), 0);    // still valid at the time of the change
  EXPECT_EQ(down(12ms, 0), 0);   // arrives at 14 ms: the old address still receives
  EXPECT_EQ(down(13ms, 0), -1);  // arrives at 15 ms: dead
  EXPECT_EQ(up(13ms), 1);
  EXPECT_EQ(down(15ms, 1), 1);
  const PathCounters& counters = network.counters(0, Direction::kDown);
  EXPECT_EQ(counters.of(Outcome::kOldAddress), 1U);
  EXPECT_EQ(counters.in_flight(), 0U);
  EXPECT_EQ(counters.out, 3U);
}

TEST(Addresses, RouteRepliesToTheAddressUsedLast) {
  Network network{1};
  network.add_link({.initial = {}, .rebinds = {{10ms, {1ms}}}}, 0);
  Buffer buffer;
  const auto answered = [&](Duration at) {
    network.send(Time{at}, 0, Direction::kDown, datagram(1));
    return network.poll(Time{at}, 0, Direction::kDown, buffer).has_value();
  };
  EXPECT_TRUE(answered(5ms));
  EXPECT_FALSE(answered(12ms));  // the client moved and sent nothing: its address is unknown
  network.send(Time{13ms}, 0, Direction::kUp, datagram(1));
  EXPECT_FALSE(answered(13ms));  // not received yet
  ASSERT_TRUE(network.poll(Time{13ms}, 0, Direction::kUp, buffer));
  EXPECT_TRUE(answered(13ms));
}

TEST(Addresses, ChangeAtRuntimeAsInTheSchedule) {
  const auto run = [](bool live) {
    Network network{1};
    LinkSchedule schedule{.initial = both(everything())};
    if (!live) schedule.rebinds = {{1s, {50ms}}};
    network.add_link(schedule, 0);
    DecisionLog log{50'000};
    network.log_to(&log);
    Buffer buffer;
    for (int i = 0; i < 3'000; ++i) {
      const Time now{i * 1ms};
      if (live && i == 1'000) {
        EXPECT_TRUE(network.rebind(now, 0, {50ms}));
      }
      for (const Direction direction : {Direction::kUp, Direction::kDown}) network.send(now, 0, direction, datagram(1));
      while (network.poll_any(now, buffer)) {
      }
    }
    return log.sorted();
  };
  const auto live = run(true);
  EXPECT_EQ(difference(live, run(false)), "");
  EXPECT_GT(std::ranges::count(live, Outcome::kOldAddress, &Decision::outcome), 0);
  Network network{1};
  EXPECT_FALSE(network.rebind(Time{}, 3, {}));
}

// ---- The proxy's core

TEST(ProxyChange, IsLikeAnEventAndTakesNoHeapOnThePacketPath) {
  const LinkSpec before = both(everything());
  const LinkSpec after = link_from({.delay = 30ms, .jitter = 4ms, .loss = 0.05});
  const auto run = [&](bool live) {
    std::vector<NetworkEvent> events{{.at = 2s, .outage = OutageSpec{.length = 200ms}}};
    if (!live) events.push_back({.at = 1s, .link = after});
    ProxyCore core{before, 3, events};
    DecisionLog log{50'000};
    core.log_to(&log);
    for (int i = 0; i < 2; ++i) EXPECT_TRUE(core.add_client());
    const std::uint64_t numbers[] = {*core.clients().number(0), *core.clients().number(1)};
    LinkChange change = core.links().prepare_change(after, numbers, true);
    const auto bytes = datagram(1);
    const tandem::test::AllocGuard guard;
    for (int i = 0; i < 3'000; ++i) {
      const Time now{i * 1ms};
      if (live && i == 1'000) core.change(now, change);
      for (const std::uint32_t client : {0U, 1U}) core.ingress(now, client, static_cast<Direction>(i % 2), bytes);
      while (const auto egress = core.take(now)) core.done(*egress);
    }
    EXPECT_EQ(guard.count(), 0U);
    return log.sorted();
  };
  const auto live = run(true);
  EXPECT_EQ(difference(live, run(false)), "");
  // The outage of the events outlived the change.
  EXPECT_GT(std::ranges::count(live, Outcome::kOutage, &Decision::outcome), 200);
}

TEST(ProxyChange, AppliesToOneClientOrToAllPresentAndFutureOnes) {
  ProxyCore core{link_from({.delay = 1ms}), 1};
  ASSERT_EQ(core.add_client(), 0U);
  ASSERT_EQ(core.add_client(), 1U);
  const auto delay = [&core](std::uint32_t client, Duration at) {
    core.ingress(Time{at}, client, Direction::kUp, datagram(1));
    const auto due = core.next_due();
    EXPECT_TRUE(due);
    const auto egress = core.take(*due);
    EXPECT_TRUE(egress);
    core.done(*egress);
    return *due - Time{at};
  };
  const std::uint64_t second[] = {1};
  LinkChange one = core.links().prepare_change(link_from({.delay = 5ms}), second, false);
  core.change(Time{10ms}, one);
  EXPECT_EQ(delay(0, 10ms), 1ms);
  EXPECT_EQ(delay(1, 20ms), 5ms);
  ASSERT_EQ(core.add_client(), 2U);
  EXPECT_EQ(delay(2, 30ms), 1ms);

  const std::uint64_t known[] = {0, 1};
  LinkChange all = core.links().prepare_change(link_from({.delay = 9ms}), known, true);  // the third joined since
  core.change(Time{40ms}, all);
  for (const std::uint32_t client : {0U, 1U, 2U}) EXPECT_EQ(delay(client, 50ms + client * 20ms), 9ms) << client;
  ASSERT_EQ(core.add_client(), 3U);
  EXPECT_EQ(delay(3, 150ms), 9ms);
  EXPECT_THROW(static_cast<void>(core.links().prepare_change(both({.floor = 61s}), known, true)),
               std::invalid_argument);
}

TEST(ProxyChange, ChangesTheAddressOfTheClientOnly) {
  ProxyCore core{link_from({.delay = 2ms}), 1, {{.at = 10ms, .clients = {"2"}, .rebind = Rebind{5ms}}}};
  ASSERT_EQ(core.add_client(), 0U);
  ASSERT_EQ(core.add_client(), 1U);
  const auto through = [&core](std::uint32_t client, Direction direction, Duration at, std::uint32_t address) {
    core.ingress(Time{at}, client, direction, datagram(1), address);
    const auto egress = core.take(Time{at + 2ms});
    if (!egress) return -1;
    const int to = static_cast<int>(egress->address);
    core.done(*egress);
    return to;
  };
  EXPECT_EQ(through(0, Direction::kUp, 12ms, 7), 0);
  EXPECT_EQ(through(1, Direction::kUp, 12ms, 7), 1);
  EXPECT_EQ(core.address(Time{12ms}, 1), 1U);
  EXPECT_FALSE(core.clients().dead(Time{14ms}, 1, 0));
  EXPECT_EQ(through(1, Direction::kDown, 12ms, 0), 0);
  EXPECT_EQ(through(1, Direction::kDown, 13ms, 0), -1);
  EXPECT_TRUE(core.clients().dead(Time{15ms}, 1, 0));
  EXPECT_EQ(through(1, Direction::kDown, 13ms, 1), 1);
  EXPECT_TRUE(core.rebind(Time{20ms}, 0, {1ms}));
  EXPECT_FALSE(core.rebind(Time{20ms}, 9, {1ms}));
  EXPECT_EQ(through(0, Direction::kUp, 20ms, 0), 1);
  EXPECT_EQ(core.counters(1, Direction::kDown).of(Outcome::kOldAddress), 1U);
}

TEST(ProxyChange, ClosesTheLogOfAClientThatLeaves) {
  ProxyCore core{link_from({.delay = 50ms, .duplicate = 0.5}), 1};
  DecisionLog log{1'000};
  core.log_to(&log);
  ASSERT_EQ(core.add_client(), 0U);
  for (int i = 0; i < 100; ++i) core.ingress(Time{i * 1ms}, 0, Direction::kUp, datagram(1));
  while (const auto egress = core.take(Time{99ms})) core.done(*egress);
  core.remove_client(0);
  core.log_in_flight();
  const PathCounters total = core.total(Direction::kUp);
  EXPECT_EQ(log.rows().size(), total.in + total.copies);
  EXPECT_EQ(total.of(Outcome::kClientGone),
            static_cast<std::uint64_t>(std::ranges::count(log.rows(), Outcome::kClientGone, &Decision::outcome)));
  EXPECT_GT(total.of(Outcome::kClientGone), 40U);
  EXPECT_FALSE(core.take(Time{1h}));
}

}  // namespace
}  // namespace tandem::netsim
