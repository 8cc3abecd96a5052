#include "netsim/proxy_core.h"

#include <gtest/gtest.h>

#include <memory>
#include <vector>

#include "netsim/decision_log.h"
#include "netsim/network.h"
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

// The heart of "one engine, two drivers".
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

// A busy machine reads datagrams long after they came. What is decided by later ones must wait for those that came in time
// and were not read yet.
TEST(ProxyCore, DecidesTheSameHoweverLateItReads) {
  LinkSpec head{everything(), everything()};
  for (PathSpec* path : {&head.up, &head.down}) path->rate = {.bits_per_s = 1'200'000, .queue_datagrams = 4, .drop = RateSpec::Drop::kHead};
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
        if (late && came > woken) {  // everything until `before` was read just now, and so late it is
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

TEST(ProxyCore, LetsOutWhatIsDueInTimeOrder) {
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

TEST(ProxyCore, HasPlaceForSixtyFourAndGivesPlacesAgain) {
  ProxyCore core{{}, 1};
  for (std::uint32_t i = 0; i < ProxyCore::kClientsMax; ++i) ASSERT_EQ(core.add_client(), i);
  EXPECT_EQ(core.add_client(), std::nullopt);
  core.remove_client(5);
  EXPECT_EQ(core.clients(), 63U);
  EXPECT_EQ(core.add_client(), 5U);
  EXPECT_EQ(core.clients_seen(), 65U);
}

TEST(ProxyCore, ANewClientNeverGetsWhatWasMeantForTheOneBefore) {
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

TEST(ProxyCore, OneFloodDoesNotTakeTheRoomOfOthers) {
  ProxyCore core{link_from({.delay = 60s}), 1};
  core.add_client();
  core.add_client();
  const auto bytes = datagram(1);
  for (int i = 0; i < 100'000; ++i) core.ingress(Time{}, 0, Direction::kUp, bytes);
  EXPECT_EQ(core.counters(0, Direction::kUp).of(Outcome::kOverflow), 100'000 - ProxyCore::kPerLaneMax);
  EXPECT_EQ(core.ingress(Time{}, 1, Direction::kUp, bytes), Outcome::kDeliver);
}

TEST(ProxyCore, UnknownClientsAreIgnored) {
  ProxyCore core{{}, 1};
  EXPECT_EQ(core.ingress(Time{}, 0, Direction::kUp, datagram(1)), Outcome::kOverflow);
  EXPECT_EQ(core.ingress(Time{}, 1000, Direction::kUp, datagram(1)), Outcome::kOverflow);
  core.remove_client(1000);
  EXPECT_FALSE(core.take(Time{1h}));
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
