// Properties of the packet thread that depend on kernel sockets and on its sleep.
#include <gtest/gtest.h>

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "tests/netsim/proxy/app/running_proxy.h"
#include "tests/netsim/proxy/app/udp_peer.h"

namespace tandem::netsim {
namespace {

using namespace std::chrono_literals;
using test::Running;
using test::UdpPeer;

// New clients get sockets while others wait in the listening socket: no datagram may be lost or overtaken.
TEST(Proxy, KeepsDatagramsAndOrderOfManySimultaneousClients) {
  constexpr int kHouses = 5, kClients = 40, kEach = 5;  // no more than the server's buffer holds
  for (int house = 0; house < kHouses; ++house) {
    UdpPeer server;
    Running proxy{server.address(), {}};
    std::vector<std::unique_ptr<UdpPeer>> clients;
    for (int i = 0; i < kClients; ++i) {
      clients.push_back(std::make_unique<UdpPeer>());
      clients.back()->connect(proxy->listening());
    }
    for (int k = 0; k < kEach; ++k) {
      for (std::size_t i = 0; i < clients.size(); ++i)
        ASSERT_TRUE(clients[i]->send(std::to_string(i) + ":" + std::to_string(k)));
    }
    std::map<std::string, int> next;
    for (int n = 0; n < kClients * kEach; ++n) {
      const auto got = server.receive();
      ASSERT_TRUE(got) << n;
      const auto colon = got->bytes.find(':');
      ASSERT_EQ(std::stoi(got->bytes.substr(colon + 1)), next[got->bytes.substr(0, colon)]++) << got->bytes;
    }
    EXPECT_EQ(next.size(), clients.size());
  }
}

// A waiting datagram is due before a read has shown that no newer one arrived. The packet thread must read then;
// sleeping until the next regular read would leave it overdue forever.
TEST(Proxy, ContinuesAfterAHoldLastOutage) {
  UdpPeer server, client;
  ProxyOptions options = Running::options(server.address(), {});
  options.link.up.floor = options.link.down.floor = 3ms;
  for (const Duration at : {50ms, 150ms, 250ms, 350ms, 450ms, 550ms}) {
    NetworkEvent outage;
    outage.at = at;
    outage.outage = OutageSpec{.start = at, .length = 50ms, .mode = OutageSpec::Mode::kHoldLast};
    options.events.push_back(outage);
  }
  Running proxy{options};
  client.connect(proxy->listening());
  int arrived = 0;
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(client.send(std::to_string(i)));
    if (server.receive(1)) ++arrived;
  }
  while (server.receive(500)) ++arrived;
  proxy.end();
  const PathCounters up = proxy->final_status().total[0];
  EXPECT_EQ(up.in, 500U);
  EXPECT_EQ(up.in_flight(), 0U);
  EXPECT_EQ(static_cast<std::uint64_t>(arrived), up.out);
}

}  // namespace
}  // namespace tandem::netsim
