// Parts of the live proxy that need neither socket nor clock.
#include <gtest/gtest.h>
#include <poll.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include "common/base/rng.h"
#include "netsim/proxy/app/live_delay_histogram.h"
#include "netsim/proxy/app/proxy_events.h"
#include "netsim/proxy/app/proxy_inbox.h"
#include "netsim/proxy/app/proxy_status_view.h"
#include "netsim/proxy/app/reading_interval.h"
#include "netsim/proxy/app/send_queue.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;

TEST(ProxyEvents, ReportAppliedNoTargetAndNotReached) {
  const auto outage = [](Duration at, std::vector<std::string> clients, Duration length = 100ms) {
    return NetworkEvent{.at = at, .clients = std::move(clients), .outage = OutageSpec{.length = length}};
  };
  ProxyOptions options;
  options.events = {outage(9s, {}),
                    outage(1s, {}),
                    outage(1s, {"2"}),
                    outage(2s, {"3"}),
                    outage(3s, {"1"}, 10s),
                    {.at = 1500ms, .clients = {"2"}, .link = LinkSpec{}, .network = "lan"},
                    {.at = 1500ms, .clients = {"2"}, .rebind = Rebind{}}};
  std::vector<ProxyClientStatus> clients(2);
  clients[0].number = 1;
  clients[0].arrived = 500ms;
  clients[1].number = 2;
  clients[1].arrived = 1800ms;
  const auto all = proxy_events(options, clients, 2, 5s);
  ASSERT_EQ(all.size(), 7u);
  using Fate = ProxyEvent::Fate;
  EXPECT_EQ(all[0].fate, Fate::kApplied);
  EXPECT_EQ(all[1].fate, Fate::kNoTarget);
  EXPECT_EQ(all[1].reason, "client 2 connected later, at 1.800 s");
  EXPECT_EQ(all[2].fate, Fate::kApplied) << "a network stays for later clients";
  EXPECT_EQ(all[3].fate, Fate::kNoTarget) << "a new address does not";
  EXPECT_EQ(all[4].reason, "client 3 never connected");
  EXPECT_EQ(all[5].fate, Fate::kStillActive);
  EXPECT_EQ(all[6].fate, Fate::kNotReached);
  EXPECT_EQ(events_text(std::span(all).first(2)),
            "  event at 1.000 s: outage of 100 ms: applied\n"
            "  event at 1.000 s: outage of 100 ms, for client 2: no-target; client 2 connected later, at 1.800 s\n");
  EXPECT_EQ(events_text(std::span(all).last(1)),
            "  event at 9.000 s: outage of 100 ms: not-reached; the proxy ended before it, at 5.000 s\n");
}

TEST(ReadingInterval, IsHalfOfTheLeastDelayWithinItsRange) {
  const auto interval = [](std::initializer_list<LinkSpec> links) {
    ReadingInterval reading;
    for (const LinkSpec& link : links) reading.add(link);
    return reading.value();
  };
  EXPECT_EQ(interval({link_from({.delay = 3ms})}), 1500us);
  EXPECT_EQ(interval({link_from({.delay = 80ms})}), 2ms) << "the kernel's buffers limit it";
  EXPECT_EQ(interval({link_from({.delay = 150us})}), 0ms) << "not worth a separate wake-up";
  EXPECT_EQ(interval({link_from({.delay = 2ms}), link_from({.delay = 80ms})}), 1ms);
  LinkSpec shared = link_from({.delay = 80ms});
  shared.shared = true;
  EXPECT_EQ(interval({shared, link_from({.delay = 80ms})}), 0ms);
  EXPECT_EQ(interval({link_from({.delay = 80ms, .reorder = 0.1})}), 0ms);
}

TEST(ClientDelays, ClearsThePlaceOfOneClient) {
  ClientDelays delays;
  delays.of(3, Direction::kUp).add(1ms);
  delays.of(4, Direction::kUp).add(1ms);
  delays.clear(3);
  const auto count = [&](std::uint32_t place) {
    const auto snapshot = std::make_unique<LiveDelayHistogram::Snapshot>();
    delays.of(place, Direction::kUp).read(*snapshot);
    return snapshot->count;
  };
  EXPECT_EQ(count(3), 0u);
  EXPECT_EQ(count(4), 1u);
}

TEST(LiveDelayHistogram, ReportsMeanAndQuantilesSinceTheLastReading) {
  const auto delays = std::make_unique<LiveDelayHistogram>();
  auto before = std::make_unique<LiveDelayHistogram::Snapshot>(),
       now = std::make_unique<LiveDelayHistogram::Snapshot>();
  for (int i = 0; i < 1000; ++i) delays->add(500ms);
  delays->read(*before);
  for (int i = 1; i <= 100; ++i) delays->add(i * 1ms);
  delays->read(*now);
  EXPECT_EQ(now->mean_since(*before), 50'500us);
  EXPECT_NEAR(seconds(now->quantile_since(*before, 0.5)), 0.050, 0.050 / 32);
  EXPECT_NEAR(seconds(now->quantile_since(*before, 0.99)), 0.099, 0.099 / 32);
  EXPECT_EQ(now->mean_since(*now), 0ns);
  EXPECT_EQ(now->quantile_since(*now, 0.99), 0ns);
}

TEST(LiveDelayHistogram, ResolvesAnyDelayWithinOneThirtySecond) {
  RandomStream random{5};
  for (int i = 0; i < 2'000; ++i) {
    const auto delays = std::make_unique<LiveDelayHistogram>();
    LiveDelayHistogram::Snapshot before{}, now{};
    const Duration delay{static_cast<std::int64_t>(std::exp2(10 + random.uniform() * 31))};
    delays->add(delay);
    delays->read(now);
    const Duration got = now.quantile_since(before, 0.99);
    EXPECT_GE(got, delay);
    EXPECT_LE(seconds(got), seconds(delay) * (1 + 1.0 / 32) + 1.1e-6) << delay.count();
  }
  LiveDelayHistogram delays;
  delays.add(-1s);
  delays.add(Duration::max());  // in the last bin
  LiveDelayHistogram::Snapshot now{};
  delays.read(now);
  EXPECT_EQ(now.count, 2U);
}

TEST(SendQueue, GroupsBySocketAndKeepsTheOrderOfEach) {
  using Kind = ProxySource::Kind;
  RandomStream random{9};
  SendQueue box;
  for (int round = 0; round < 200; ++round) {
    const std::uint64_t count = random.below(SendQueue::kMax + 1);
    for (std::uint64_t i = 0; i < count; ++i) {
      ProxyCore::Egress egress;
      egress.client = static_cast<std::uint32_t>(random.below(random.below(2) == 0 ? 2 : ProxyClients::kMax));
      egress.item.index = i;
      const Kind kind = std::array{Kind::kDownside, Kind::kUpside, Kind::kFormer}[random.below(3)];
      box.add(egress, {kind, egress.client});
    }
    EXPECT_EQ(box.full(), count == SendQueue::kMax);
    std::uint64_t seen = 0;
    std::vector<std::uint64_t> sockets;
    box.flush([&](const SendQueue::Group& group) {
      const std::uint64_t socket = group.through.as_number();
      EXPECT_EQ(std::ranges::count(sockets, socket), 0) << "one call per socket";
      sockets.push_back(socket);
      std::optional<std::uint64_t> last;
      group.for_each([&](const ProxyCore::Egress& egress) {
        EXPECT_EQ(egress.client, group.through.place);
        EXPECT_TRUE(!last || egress.item.index > *last);
        last = egress.item.index;
        ++seen;
      });
    });
    EXPECT_EQ(seen, count);
    EXPECT_EQ(box.size(), 0U);
  }
}

// A flood with replies fills two directions; other clients must still find space.
TEST(ProxyCore, ConfinesAFloodInBothDirections) {
  ProxyCore core{link_from({.delay = 60s}), 1};
  core.add_client();
  core.add_client();
  const std::array<std::byte, 8> bytes{};
  for (std::uint64_t i = 0; i < 2 * ProxyCore::kPerDirectionMax; ++i) {
    core.ingress(Time{}, 0, Direction::kUp, bytes);
    core.ingress(Time{}, 0, Direction::kDown, bytes);
  }
  EXPECT_GT(core.counters(0, Direction::kUp).of(Outcome::kOverflow), 0U);
  for (std::uint64_t i = 0; i < 10'000; ++i) {
    ASSERT_EQ(core.ingress(Time{}, 1, Direction::kUp, bytes), Outcome::kDeliver) << i;
    ASSERT_EQ(core.ingress(Time{}, 1, Direction::kDown, bytes), Outcome::kDeliver) << i;
  }
}

TEST(ProxySource, RoundTripsAsANumber) {
  for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
    for (std::size_t kind = 0; kind < ProxySource::kKinds; ++kind) {
      const ProxySource source{static_cast<ProxySource::Kind>(kind), place};
      const ProxySource again = ProxySource::of(source.as_number());
      EXPECT_EQ(again.kind, source.kind);
      EXPECT_EQ(again.place, source.place);
    }
  }
}

TEST(ProxyInbox, KeepsRequestsInOrderAndRejectsThoseBeyondItsCapacity) {
  ProxyInbox inbox;
  ASSERT_TRUE(inbox.open());
  EXPECT_TRUE(inbox.empty());
  std::vector<std::unique_ptr<ProxyRequest>> requests;
  for (std::size_t i = 0; i < ProxyInbox::kRequestsMax; ++i)
    ASSERT_TRUE(inbox.post(*requests.emplace_back(std::make_unique<ProxyRequest>())));
  ProxyRequest late;
  EXPECT_FALSE(inbox.post(late));
  EXPECT_EQ(&inbox.take(), requests[0].get());
  EXPECT_TRUE(inbox.post(late));
  for (std::size_t i = 1; i < requests.size(); ++i) EXPECT_EQ(&inbox.take(), requests[i].get());
  EXPECT_EQ(&inbox.take(), &late);
  EXPECT_TRUE(inbox.empty());
}

TEST(ProxyInbox, WakesThePacketThreadForEachMessage) {
  ProxyInbox inbox;
  const auto readable = [&inbox] {
    pollfd ready{inbox.fd(), POLLIN, 0};
    return ::poll(&ready, 1, 0) == 1;
  };
  EXPECT_FALSE(readable());
  ProxyRequest request;
  ASSERT_TRUE(inbox.post(request));
  EXPECT_TRUE(readable());
  inbox.clear();
  EXPECT_FALSE(readable());
  EXPECT_FALSE(inbox.stopping());
  inbox.stop();
  EXPECT_TRUE(inbox.stopping());
  EXPECT_TRUE(readable());
}

}  // namespace
}  // namespace tandem::netsim
