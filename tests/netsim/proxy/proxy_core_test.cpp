#include "netsim/proxy/proxy_core.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "tests/netsim/support.h"
#include "tests/support/alloc_guard.h"

namespace tandem::netsim {
namespace {

using namespace test;

struct Event {
  std::uint32_t link;
  Direction direction;
  std::uint64_t index;
  Time at;
  std::size_t size;
  bool operator==(const Event&) const = default;
};

// Virtual network and live proxy use one engine.
TEST(ProxyCore, DecidesLikeTheVirtualNetwork) {
  const LinkSpec link{everything(), everything()};
  const auto proxy = std::make_unique<ProxyCore>(link, 77);
  Network network{77};
  for (std::uint32_t i = 0; i < 3; ++i) {
    network.add_link(link);
    ASSERT_EQ(proxy->add_client(), i);
  }
  RandomStream random{6};
  std::array<std::byte, kSlotBytes> buffer;
  std::array<std::vector<Event>, 6> live, simulated;
  const auto lane = [](std::uint32_t client, Direction d) { return client * 2 + static_cast<std::size_t>(d); };
  const auto drain = [&](Time now) {
    while (const auto e = proxy->take(now)) {
      live[lane(e->client, e->direction)].push_back(
          {e->client, e->direction, e->item.index, e->item.at, e->bytes.size()});
      proxy->done(*e);
    }
    while (const auto d = network.poll_any(now, buffer)) {
      simulated[lane(d->link, d->direction)].push_back({d->link, d->direction, d->index, d->at, d->size});
    }
  };
  Time now{};
  for (int i = 0; i < 60'000; ++i) {
    now += Duration{static_cast<std::int64_t>(random.below(400'000))};
    const auto client = static_cast<std::uint32_t>(random.below(3));
    const auto direction = static_cast<Direction>(random.below(2));
    const auto bytes = datagram(random.bits(), random.below(400));
    ASSERT_EQ(proxy->ingress(now, client, direction, bytes), network.send(now, client, direction, bytes)) << i;
    if (random.below(4) == 0) drain(now);
  }
  drain(now + 10s);
  for (std::size_t i = 0; i < live.size(); ++i) {
    EXPECT_GT(live[i].size(), 5'000U);
    EXPECT_EQ(live[i], simulated[i]) << i;
  }
}

// A busy machine reads datagrams long after their arrival. Verdicts that depend on later datagrams wait for those that
// arrived in time but were not read yet.
TEST(ProxyCore, DecidesIndependentlyOfTheReadDelay) {
  LinkSpec head{everything(), everything()};
  for (PathSpec* path : {&head.up, &head.down})
    path->rate = {.bits_per_s = 1'200'000, .queue_datagrams = 4, .drop = RateSpec::Drop::kHead};
  for (const LinkSpec& link : {LinkSpec{everything(), everything()}, head}) {
    std::array<std::vector<Decision>, 2> logs;
    for (const bool late : {false, true}) {
      DecisionLog log{100'000};
      const auto core = std::make_unique<ProxyCore>(link, 77);
      core->log_to(&log);
      ASSERT_EQ(core->add_client(), 0U);
      RandomStream arrivals{6}, pauses{7};
      const auto bytes = datagram(1);
      Time came{}, woken{};
      for (int i = 0; i < 20'000; ++i) {
        const Time before = came;
        came += Duration{static_cast<std::int64_t>(arrivals.below(1'200'000))};
        if (late && came > woken) {  // all datagrams until `before` were read only now
          while (const auto e = core->take(before + 80ms, before)) core->done(*e);
          woken = came + Duration{static_cast<std::int64_t>(pauses.below(30'000'000))};
        } else if (!late) {
          while (const auto e = core->take(came)) core->done(*e);
        }
        core->ingress(came, 0, Direction::kUp, bytes);
      }
      while (const auto e = core->take(came + 10s)) core->done(*e);
      logs[late ? 1 : 0] = log.sorted();
    }
    ASSERT_GT(logs[0].size(), 20'000U);
    EXPECT_EQ(logs[1], logs[0]);
  }
}

TEST(ProxyCore, DeliversDueDatagramsInTimeOrder) {
  ProxyCore core{link_from({.jitter = 20ms}), 1};
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(core.add_client());
  for (int i = 0; i < 1'000; ++i) {
    core.ingress(Time{i * 1ms}, static_cast<std::uint32_t>(i % 4), Direction::kUp, datagram(1));
  }
  Time last{};
  std::size_t out = 0;
  while (const auto due = core.next_due()) {
    EXPECT_FALSE(core.take(*due - 1ns));
    const auto e = core.take(*due);
    ASSERT_TRUE(e);
    EXPECT_EQ(e->item.at, *due);
    EXPECT_GE(e->item.at, last);
    last = e->item.at;
    core.done(*e);
    ++out;
  }
  EXPECT_EQ(out, 1'000U);
}

TEST(ProxyCore, AcceptsSixtyFourClientsAndReusesSlots) {
  ProxyCore core{{}, 1};
  for (std::uint32_t i = 0; i < ProxyCore::kClientsMax; ++i) ASSERT_EQ(core.add_client(), i);
  EXPECT_EQ(core.add_client(), std::nullopt);
  core.remove_client(5);
  EXPECT_EQ(core.clients().size(), 63U);
  EXPECT_EQ(core.add_client(), 5U);
  EXPECT_EQ(core.clients().seen(), 65U);
}

// Two clients join, the second after a change. With prepared resources no memory is allocated, and decisions equal
// those without preparation.
TEST(ProxyCore, AddsAPreparedClientWithoutHeapOnTheSameLink) {
  for (const bool shared : {false, true}) {
    SCOPED_TRACE(shared ? "shared" : "own");
    LinkSpec link{everything(), everything()}, other = link_from({.delay = 3ms, .loss = 0.2});
    link.shared = other.shared = shared;
    const auto bytes = datagram(1);
    const auto run = [&](bool beforehand) {
      ProxyCore core{link, 9};
      std::optional<PreparedLink> first = core.links().prepare_client(link, 0, 0),
                                  outdated = core.links().prepare_client(link, 0, 1),
                                  second = core.links().prepare_client(other, 1, 1);
      LinkChange change = core.links().prepare_change(other, {}, true);
      std::vector<std::pair<Time, std::uint64_t>> out;
      std::size_t taken = 0;
      const auto join = [&](std::optional<PreparedLink>& made) {
        EXPECT_TRUE(core.fits(*made));
        const tandem::test::AllocGuard guard;
        EXPECT_TRUE(core.add_client(beforehand ? &*made : nullptr));
        taken += guard.count();
      };
      join(first);
      for (int i = 0; i < 4000; ++i) {
        const Time now{i * 1ms};
        if (i == 1000) {
          EXPECT_TRUE(core.fits(*outdated));
          core.change(now, change);
          EXPECT_FALSE(core.fits(*outdated)) << "made for the network that was";
          join(second);
        }
        for (std::uint32_t c = 0; c < core.clients().size(); ++c) core.ingress(now, c, Direction::kUp, bytes);
        while (const auto e = core.take(now)) {
          out.emplace_back(e->item.at, e->item.index);
          core.done(*e);
        }
      }
      if (beforehand) {
        EXPECT_EQ(taken, 0U);
      } else {
        EXPECT_GT(taken, 0U) << "or this test proves nothing";
      }
      return out;
    };
    EXPECT_EQ(run(true), run(false));
  }
}

TEST(ProxyCore, DeliversNothingOfAFormerClientToANewOne) {
  ProxyCore core{link_from({.delay = 50ms}), 1};
  core.add_client();
  core.ingress(Time{}, 0, Direction::kDown, datagram(1));
  core.remove_client(0);
  ASSERT_EQ(core.add_client(), 0U);
  core.ingress(Time{10ms}, 0, Direction::kDown, datagram(2));
  const auto e = core.take(Time{1s});
  ASSERT_TRUE(e);
  EXPECT_EQ(e->item.sent, Time{10ms});
  core.done(*e);
  EXPECT_FALSE(core.take(Time{1s}));
  const PathCounters total = core.total(Direction::kDown);
  EXPECT_EQ(total.in, 2U);
  EXPECT_EQ(total.out, 1U);
  EXPECT_EQ(total.in_flight(), 0U);
}

TEST(ProxyCore, ConfinesAFloodOfOneClient) {
  ProxyCore core{link_from({.delay = 60s}), 1};
  core.add_client();
  core.add_client();
  const auto bytes = datagram(1);
  for (int i = 0; i < 100'000; ++i) core.ingress(Time{}, 0, Direction::kUp, bytes);
  EXPECT_EQ(core.counters(0, Direction::kUp).of(Outcome::kOverflow), 100'000 - ProxyCore::kPerDirectionMax);
  EXPECT_EQ(core.ingress(Time{}, 1, Direction::kUp, bytes), Outcome::kDeliver);
}

TEST(ProxyCore, IgnoresUnknownClients) {
  ProxyCore core{{}, 1};
  EXPECT_EQ(core.ingress(Time{}, 0, Direction::kUp, datagram(1)), Outcome::kOverflow);
  EXPECT_EQ(core.ingress(Time{}, 1000, Direction::kUp, datagram(1)), Outcome::kOverflow);
  core.remove_client(1000);
  EXPECT_FALSE(core.take(Time{1h}));
}

// 97 bytes and 28 of overhead are 1000 bits: 1 ms each at 1 Mbit/s.
TEST(ProxyCore, ReportsTheWaitInTheRateQueue) {
  const std::vector<std::byte> bytes(97);
  for (const auto drop : {RateSpec::Drop::kTail, RateSpec::Drop::kHead}) {
    for (const bool shared : {false, true}) {
      SCOPED_TRACE(shared ? "shared" : "own");
      LinkSpec link;
      link.up.rate.bits_per_s = 1'000'000;
      link.up.rate.queue_datagrams = 100;
      link.up.rate.drop = drop;
      link.up.floor = 50ms;  // datagrams in flight are not in the queue
      link.shared = shared;
      ProxyCore core{link, 1};
      ASSERT_EQ(core.add_client(), 0u);
      ASSERT_EQ(core.add_client(), 1u);
      for (int i = 0; i < 10; ++i) core.ingress(Time{1s}, 0, Direction::kUp, bytes);
      EXPECT_EQ(core.queue_wait(Time{1s}, 0, Direction::kUp), 10ms);
      EXPECT_EQ(core.queue_wait(Time{1s}, 1, Direction::kUp), shared ? 10ms : 0ms);
      EXPECT_FALSE(core.take(Time{1s + 4ms})) << "a datagram that left the queue arrives 50 ms later";
      EXPECT_EQ(core.queue_wait(Time{1s + 4ms}, 0, Direction::kUp), 6ms);
      EXPECT_FALSE(core.take(Time{1s + 10ms}));
      EXPECT_EQ(core.queue_wait(Time{1s + 10ms}, 0, Direction::kUp), 0ms);
      EXPECT_EQ(core.counters(0, Direction::kUp).in_flight(), 10u) << "all of them are still under way";
      EXPECT_EQ(core.queue_wait(Time{1s}, 0, Direction::kDown), 0ms) << "no rate, no queue";
      EXPECT_EQ(core.queue_wait(Time{1s}, 7, Direction::kUp), 0ms) << "no such client";
    }
  }
}

TEST(ProxyCore, ChangesNoDecisionWhenTheQueueIsQueried) {
  for (const auto drop : {RateSpec::Drop::kTail, RateSpec::Drop::kHead}) {
    const auto decided = [&](bool ask) {
      LinkSpec link{everything(), everything()};
      link.up.rate = {.bits_per_s = 500'000, .queue_bytes = 5000, .drop = drop};
      ProxyCore core{link, 5};
      core.add_client();
      std::vector<std::pair<Time, std::uint64_t>> out;
      RandomStream random{3};
      for (Time now{}; now < Time{2s}; now += Duration{static_cast<std::int64_t>(random.below(2'000'000))}) {
        if (ask) static_cast<void>(core.queue_wait(now + 3ms, 0, Direction::kUp));
        core.ingress(now, 0, Direction::kUp, datagram(1));
        while (const auto e = core.take(now)) {
          out.emplace_back(e->item.at, e->item.index);
          core.done(*e);
        }
      }
      return out;
    };
    EXPECT_EQ(decided(true), decided(false));
    EXPECT_GT(decided(false).size(), 100u);
  }
}

TEST(ProxyCore, TakesNoHeapOnThePacketPath) {
  ProxyCore core{{everything(), everything()}, 1};
  core.add_client();
  const auto bytes = datagram(1);
  const tandem::test::AllocGuard guard;
  for (int i = 0; i < 20'000; ++i) {
    const Time now{i * 500us};
    core.ingress(now, 0, i % 2 == 0 ? Direction::kUp : Direction::kDown, bytes);
    while (const auto e = core.take(now)) core.done(*e);
  }
  EXPECT_EQ(guard.count(), 0U);
}

}  // namespace
}  // namespace tandem::netsim
