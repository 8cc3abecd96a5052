// Live proxy under load and under attack. Tests assert counts, never times: on any computer, only the simulated network
// may lose datagrams.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cstdio>
#include <memory>
#include <thread>

#include "netsim/engine/decision_log.h"
#include "netsim/engine/network.h"
#include "netsim/engine/schedule.h"
#include "netsim/profiles/profile_loader.h"
#include "tests/bench/udp_load.h"
#include "tests/common/base/counts.h"
#include "tests/netsim/proxy/app/running_proxy.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

constexpr std::size_t kTeam = 20;

void expect_whole(const PathCounters& c, const char* which) {
  EXPECT_EQ(c.in + c.copies, c.out + c.dropped() + c.in_flight()) << which;
  EXPECT_EQ(c.of(Outcome::kOverflow), 0U) << which;
}

void expect_no_trouble(const ProxyErrors& t) {
  EXPECT_EQ(t.kernel_drops, 0U);
  EXPECT_EQ(t.no_room, 0U);
  EXPECT_EQ(t.refused, 0U);
  EXPECT_EQ(t.too_many_clients, 0U);
  EXPECT_EQ(t.other, 0U);
}

/// Twenty clients at 1 kHz each way over `link`; every datagram that the network delivers must arrive.
void carry(const LinkSpec& link, Duration length) {
  bench::UdpLoad load{kTeam};
  Running proxy{load.server(), link};
  ASSERT_TRUE(load.meet(proxy->listening()));
  bench::UdpLoad::Counts counts = load.run(length, true);
  counts.sent += load.met().sent;
  counts.up += load.met().up;
  // The proxy has received all sent datagrams when its counters show them.
  EXPECT_TRUE(proxy.wait_until([&](const ProxyStatus& s) {
    load.drain(counts);
    return s.total[0].in + s.total[1].in == counts.sent && s.total[0].in_flight() + s.total[1].in_flight() == 0;
  }));
  proxy.end();
  load.drain(counts);
  const ProxyStatus end = proxy->final_status();
  expect_no_trouble(end.errors);
  expect_whole(end.total[0], "up");
  expect_whole(end.total[1], "down");
  EXPECT_EQ(end.total[0].in + end.total[1].in, counts.sent);
  EXPECT_EQ(counts.up, end.total[0].out);
  EXPECT_EQ(counts.down, end.total[1].out);
  EXPECT_EQ(end.released, end.total[0].out + end.total[1].out);
  EXPECT_EQ(proxy->sender().lateness().count(), end.released);
  std::printf("[   load   ] %llu datagrams in %.0f s, late p50 %.0f us, p99 %.0f us\n",
              static_cast<unsigned long long>(counts.sent), seconds(length),
              static_cast<double>(proxy->sender().lateness().quantile(0.5)) / 1e3,
              static_cast<double>(proxy->sender().lateness().quantile(0.99)) / 1e3);
}

Duration load_length() { return 1s * static_cast<std::int64_t>(std::min<std::uint64_t>(tandem::test::seeds(2), 60)); }

TEST(ProxyLoad, LosesNothingOfTwentyClientsAtOneKilohertz) {
  carry(link_from({.delay = 5ms, .jitter = 10ms}), load_length());
}

TEST(ProxyLoad, LosesNothingWithoutDelay) { carry({}, load_length()); }

TEST(ProxyLoad, LosesOnlyWhatTheBusyNetworkLoses) {
  const auto busy = shipped_profile("wifi-busy");
  ASSERT_TRUE(busy);
  carry(busy->link, load_length());
}

// The first client floods as fast as one core can. Its link drops everything, so that the far ends are not tested.
TEST(ProxyLoad, ConfinesAndCountsAFloodOfOneClient) {
  constexpr std::size_t kOthers = 5;
  const std::uint64_t flood_size = 100'000 * tandem::test::seeds(2);
  UdpPeer server, flooder;
  ProxyOptions options = Running::options(server.address(), link_from({.delay = 2ms}));
  NetworkEvent nothing_passes;
  nothing_passes.clients = {"1"};
  nothing_passes.link = link_from({.delay = 2ms, .loss = 1});
  options.events = {nothing_passes};
  Running proxy{options};
  flooder.connect(proxy->listening());
  ASSERT_TRUE(flooder.send("first"));
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.clients == 1; }));
  std::vector<std::unique_ptr<UdpPeer>> others;
  for (std::size_t i = 0; i < kOthers; ++i) {
    others.push_back(std::make_unique<UdpPeer>());
    others.back()->connect(proxy->listening());
    ASSERT_TRUE(others.back()->send("hello"));
    ASSERT_TRUE(server.receive());
  }

  std::uint64_t flooded = 1;
  std::thread flood([&] {
    const std::string bytes(64, 'x');
    for (std::uint64_t i = 0; i < flood_size; ++i) flooded += flooder.send(bytes) ? 1 : 0;
  });
  std::uint64_t each = 1;
  for (; each < 500; ++each) {
    for (const auto& other : others) ASSERT_TRUE(other->send("still here"));
    bench::UdpLoad::pause_until(io::read_clock(CLOCK_MONOTONIC) + 1ms);
    while (server.receive(0)) {
    }
  }
  flood.join();
  const auto of = [](const ProxyStatus& s, std::uint64_t number) {
    const auto end = s.client.begin() + static_cast<std::ptrdiff_t>(s.clients);
    const auto found = std::find_if(s.client.begin(), end, [&](const auto& c) { return c.number == number; });
    return found == end ? ProxyClientStatus{} : *found;
  };
  EXPECT_TRUE(proxy.wait_until([&](const ProxyStatus& s) {
    return of(s, 1).counters[0].in + of(s, 1).kernel_drops == flooded && s.total[0].in_flight() == 0;
  })) << flooded;
  proxy.end();
  const ProxyStatus end = proxy->final_status();
  EXPECT_EQ(of(end, 1).counters[0].of(Outcome::kLost), of(end, 1).counters[0].in);
  std::printf("[  flood   ] %llu sent, %llu taken in, %llu dropped by the kernel\n",
              static_cast<unsigned long long>(flooded), static_cast<unsigned long long>(of(end, 1).counters[0].in),
              static_cast<unsigned long long>(of(end, 1).kernel_drops));
  for (std::uint64_t number = 2; number < 2 + kOthers; ++number) {
    const ProxyClientStatus other = of(end, number);
    EXPECT_EQ(other.counters[0].in, each) << number;
    EXPECT_EQ(other.counters[0].out, each) << number;
    EXPECT_EQ(other.kernel_drops, 0U) << number;
  }
  EXPECT_EQ(end.errors.kernel_drops, of(end, 1).kernel_drops);
}

// Datagrams in flight use memory allocated before; a flood into a slow network fills only its own share.
TEST(ProxyLoad, ConfinesAFloodIntoASlowNetwork) {
  UdpPeer server, flooder, other;
  Running proxy{server.address(), link_from({.delay = 60s})};
  flooder.connect(proxy->listening());
  const std::uint64_t wanted = ProxyCore::kPerDirectionMax + 1000;
  std::uint64_t sent = 0;
  while (sent < wanted) {
    for (int i = 0; i < 256; ++i) sent += flooder.send("flood") ? 1 : 0;
    ASSERT_TRUE(
        proxy.wait_until([&](const ProxyStatus& s) { return s.total[0].in + s.errors.kernel_drops + 1024 >= sent; }));
  }
  ASSERT_TRUE(proxy.wait_until([&](const ProxyStatus& s) { return s.total[0].in + s.errors.kernel_drops == sent; }));
  EXPECT_EQ(proxy->status().total[0].in_flight(), ProxyCore::kPerDirectionMax);
  other.connect(proxy->listening());
  ASSERT_TRUE(other.send("one more"));
  ASSERT_TRUE(
      proxy.wait_until([](const ProxyStatus& s) { return s.total[0].in_flight() == ProxyCore::kPerDirectionMax + 1; }));
}

// With real sockets and kernel times, the live proxy decides as the virtual network does for the same times. This holds
// also if a script changes the network.
TEST(ProxyLoad, DecidesLikeTheVirtualNetworkAtEqualTimes) {
  constexpr std::size_t kClients = 3;
  const auto busy = shipped_profile("wifi-busy");
  ASSERT_TRUE(busy);
  const LinkSpec start{everything(), everything()};
  NetworkEvent change, outage;
  change.at = 700ms;
  change.link = busy->link;
  change.clients = {"2"};
  outage.at = 300ms;
  outage.outage = OutageSpec{.start = 300ms, .length = 100ms};
  const std::vector<NetworkEvent> events{change, outage};
  DecisionLog live{1'000'000};
  {
    bench::UdpLoad load{kClients};
    ProxyOptions options = Running::options(load.server(), start);
    options.seed = 77;
    options.events = events;
    options.sink = &live;
    Running proxy{options};
    load.meet(proxy->listening());  // some datagrams may be lost; each client that arrived has a link
    static_cast<void>(load.run(1500ms, true));
    proxy.end();
    proxy->log_in_flight();
    ASSERT_EQ(live.missed(), 0U);
  }
  const std::vector<Decision> rows = live.sorted();
  ASSERT_GT(rows.size(), 3'000U);

  Network network{77};
  DecisionLog simulated{1'000'000};
  for (std::size_t i = 0; i < kClients; ++i) {
    network.add_link(schedule_for(start, events, std::to_string(i + 1)), i);
  }
  network.log_to(&simulated);
  std::array<std::byte, kSlotBytes> bytes{}, out{};
  for (const Decision& row : rows) {
    if (row.copy) continue;
    while (network.poll_any(row.in, out)) {
    }
    network.send(row.in, row.flow, row.direction, {bytes.data(), row.size});
  }
  while (network.poll_any(Time{} + 1h, out)) {
  }
  std::vector<Decision> twin = simulated.sorted();
  ASSERT_EQ(twin.size(), rows.size());
  std::size_t waiting = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    // Some datagrams were in flight at the end; those held back for reordering were undecided.
    if (rows[i].in_flight) {
      ++waiting;
      twin[i] = rows[i];
    }
    ASSERT_EQ(twin[i], rows[i]) << i;
  }
  EXPECT_LT(waiting, rows.size() / 4);
  std::printf("[  exact   ] %zu decisions, %zu of them under way at the end\n", rows.size(), waiting);
}

}  // namespace
}  // namespace tandem::netsim
