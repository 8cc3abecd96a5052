// Parts of the live proxy on real sockets, without its thread: registry, receiver, sender.
#include <gtest/gtest.h>

#include <expected>
#include <memory>
#include <string>

#include "common/io/clock.h"
#include "netsim/proxy/app/client_registry.h"
#include "netsim/proxy/app/proxy_clock.h"
#include "netsim/proxy/app/proxy_receiver.h"
#include "netsim/proxy/app/proxy_sender.h"
#include "tests/netsim/proxy/app/running_proxy.h"
#include "tests/netsim/proxy/app/udp_peer.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;
using test::Running;
using test::UdpPeer;

/// All parts of a proxy except its thread. The network delays by 1 ms.
struct Parts {
  Parts() { clock.start(); }

  /// Reads the listening socket until `count` datagrams arrived.
  void read_new(std::size_t count) {
    for (int i = 0; i < UdpPeer::kPatienceMs && count > 0; ++i) {
      clock.update_wall_clock();
      count -= std::min(count, receiver.read({ProxySource::Kind::kListen, 0}, clock.now()));
      if (count > 0) ::poll(nullptr, 0, 1);
    }
    EXPECT_EQ(count, 0u);
  }
  /// Sends all datagrams that are due by `late` after now.
  void send(Duration late) {
    const Time due{clock.now() + late};
    while (const auto egress = core.take(due)) sender.add(*egress);
    sender.flush();
  }

  UdpPeer server;
  ProxyOptions options = Running::options(server.address(), link_from({.delay = 1ms}));
  ProxyErrors errors;
  std::expected<ProxyClients, std::string> opened = ProxyClients::open(options.listen, options.to);
  ProxyClients& clients = opened.value();
  ProxyCore core{options.link, 1};
  ProxyClock clock;
  ClientDelays delays;
  ClientRegistry registry{core, clients, delays, errors, options};
  ProxyReceiver receiver{core, clients, registry, clock, errors};
  ProxySender sender{core, clients, clock, delays, errors, 100us};
};

TEST(ProxyParts, CarryADatagramFromANewClientToTheServer) {
  const auto parts = std::make_unique<Parts>();
  UdpPeer client;
  client.connect(parts->clients.listening());
  ASSERT_TRUE(client.send("hello"));
  parts->read_new(1);
  EXPECT_EQ(parts->core.clients().size(), 1u);
  EXPECT_EQ(parts->core.counters(0, Direction::kUp).in, 1u);
  parts->send(10ms);
  const auto got = parts->server.receive();
  ASSERT_TRUE(got);
  EXPECT_EQ(got->bytes, "hello");
  EXPECT_EQ(parts->sender.released(), 1u);
  EXPECT_EQ(parts->sender.lateness().count(), 1u);
  EXPECT_GT(parts->sender.last_sent(), 0s);
  LiveDelayHistogram::Snapshot up;
  parts->delays.of(0, Direction::kUp).read(up);
  EXPECT_EQ(up.count, 1u);
  EXPECT_EQ(parts->errors.other + parts->errors.refused, 0u);
}

TEST(ProxyParts, DelayADatagramThatCameWhileTheThreadPausedBeforeReading) {
  const auto parts = std::make_unique<Parts>();
  UdpPeer client;
  client.connect(parts->clients.listening());
  for (const auto kind : {ProxySource::Kind::kListen, ProxySource::Kind::kDownside}) {  // a new client, and a known one
    parts->clock.update_wall_clock();
    const Duration before_pause = parts->clock.now();
    ::poll(nullptr, 0, 20);
    const Duration sent = parts->clock.now();
    ASSERT_TRUE(client.send("late"));
    std::size_t read = 0;
    for (int i = 0; i < UdpPeer::kPatienceMs && read == 0; ++i) {
      read = parts->receiver.read({kind, 0}, before_pause);
      if (read == 0) ::poll(nullptr, 0, 1);
    }
    ASSERT_EQ(read, 1u);
    ASSERT_TRUE(parts->core.next_due());
    EXPECT_GE(*parts->core.next_due(), Time{sent} + 1ms);
    parts->send(1s);
    ASSERT_TRUE(parts->server.receive());
  }
}

TEST(ClientRegistry, RecognisesClientsAndKeepsTheReportsOfThoseThatLeft) {
  const auto parts = std::make_unique<Parts>();
  const io::SocketAddress one = *io::parse_address("127.0.0.1:40001", 1),
                          two = *io::parse_address("127.0.0.2:40001", 1),
                          one_again = *io::parse_address("127.0.0.1:40002", 1);
  ClientRegistry& registry = parts->registry;
  EXPECT_EQ(registry.identify(one.storage, {}, 1s), 0u);
  EXPECT_EQ(registry.identify(two.storage, {}, 1s), 1u);
  EXPECT_EQ(registry.identify(one.storage, {}, 2s), 0u);
  EXPECT_EQ(parts->core.clients().seen(), 2u);
  EXPECT_EQ(registry.identify(one_again.storage, {}, 3s), 2u) << "the host's other client is not silent";
  EXPECT_EQ(registry.identify(one.storage, {}, 3s), 0u);
  EXPECT_EQ(registry.qualities().size(), 3u);
  registry.maintain(61s);
  ProxyStatus status;
  registry.fill(status, 61s);
  EXPECT_EQ(status.clients, 2u) << "idle for 60 s: the second client";
  EXPECT_EQ(status.clients_seen, 3u);
  const auto reports = registry.reports(61s);
  ASSERT_EQ(reports.size(), 3u);
  EXPECT_EQ(reports[0].number, 2u);
  EXPECT_FALSE(reports[0].present);
  EXPECT_TRUE(reports[1].present);
}

TEST(ClientRegistry, MovesASilentClientToItsNewPort) {
  const auto parts = std::make_unique<Parts>();
  const io::SocketAddress before = *io::parse_address("127.0.0.1:40003", 1),
                          after = *io::parse_address("127.0.0.1:40004", 1);
  EXPECT_EQ(parts->registry.identify(before.storage, {}, 1s), 0u);
  EXPECT_EQ(parts->registry.identify(after.storage, {}, 3s), 0u);
  EXPECT_EQ(parts->core.clients().seen(), 1u);
}

TEST(ProxyClock, ConvertsStampsWithinTheLastSecond) {
  ProxyClock clock;
  clock.start();
  clock.update_wall_clock();
  const Duration wall = io::read_clock(CLOCK_REALTIME);
  const Duration now = clock.now();
  EXPECT_EQ(clock.arrival({}, now), Time{now}) << "no stamp";
  EXPECT_NEAR(seconds(clock.arrival(wall, now) - Time{now}), 0, 0.05);
  EXPECT_EQ(clock.arrival(wall - 24h, 10s), Time{9s}) << "at most one second old";
  EXPECT_EQ(clock.arrival(wall - 24h, 10ms), Time{}) << "not before the start";
  EXPECT_EQ(clock.arrival(wall + 24h, 10s), Time{10s}) << "not after it was read";
}

TEST(ProxyClock, WaitsUntilTheMoment) {
  ProxyClock clock;
  clock.start();
  for (const Duration spin : {0us, 500us}) {
    const Duration moment = clock.now() + 2ms;
    clock.wait_until(moment, spin);
    EXPECT_GE(clock.now(), moment);
  }
}

}  // namespace
}  // namespace tandem::netsim
