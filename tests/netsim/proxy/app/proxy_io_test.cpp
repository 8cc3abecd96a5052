// Live proxy with real sockets on loopback. Tests assert counts, order and states, never times.
#include <gtest/gtest.h>

#include <cstdio>
#include <map>
#include <memory>
#include <numeric>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "common/base/heap_count.h"
#include "netsim/proxy/app/proxy.h"
#include "tests/netsim/proxy/app/running_proxy.h"
#include "tests/netsim/proxy/app/udp_peer.h"
#include "tests/netsim/support.h"

namespace tandem::netsim {
namespace {

using namespace test;

TEST(Proxy, ForwardsBothDirectionsPerClient) {
  UdpPeer server, a, b;
  Running proxy{server.address(), {}};
  a.connect(proxy->listening());
  b.connect(proxy->listening());
  for (int i = 0; i < 200; ++i) {
    const std::string number = std::to_string(i);
    ASSERT_TRUE(a.send("a" + number));
    ASSERT_TRUE(b.send("b" + number));
    std::set<std::uint16_t> ports;
    for (int k = 0; k < 2; ++k) {
      const auto got = server.receive();
      ASSERT_TRUE(got);
      ports.insert(got->from.port());
      ASSERT_TRUE(server.send_to(got->from, "re:" + got->bytes));
    }
    EXPECT_EQ(ports.size(), 2U);  // a separate socket for each
    EXPECT_EQ(a.receive()->bytes, "re:a" + number);
    EXPECT_EQ(b.receive()->bytes, "re:b" + number);
  }
  proxy.end();
  const ProxyStatus status = proxy->final_status();
  EXPECT_EQ(status.clients_seen, 2U);
  for (const PathCounters& direction : status.total) {
    EXPECT_EQ(direction.in, 400U);
    EXPECT_EQ(direction.out, 400U);
    EXPECT_EQ(direction.dropped(), 0U);
  }
  EXPECT_EQ(proxy->sender().lateness().count(), 800U);
  EXPECT_EQ(proxy->client_reports().size(), 2U);
}

TEST(Proxy, KeepsTheNumberOfAReconnectingClient) {
  UdpPeer server, first, other, again, third;
  Running proxy{server.address(), {}};
  first.connect(proxy->listening());
  other.connect(proxy->listening());
  ASSERT_TRUE(first.send("first"));
  const auto before = server.receive();
  ASSERT_TRUE(before);
  for (int i = 0; i < 25; ++i) {  // the other client keeps sending
    ASSERT_TRUE(other.send("other"));
    ASSERT_TRUE(server.receive());
    EXPECT_FALSE(first.receive(100)) << "nothing is sent to it";
  }
  again.connect(proxy->listening());
  ASSERT_TRUE(again.send("again"));
  const auto back = server.receive();
  ASSERT_TRUE(back);
  EXPECT_EQ(back->bytes, "again");
  EXPECT_EQ(back->from.port(), before->from.port()) << "the same client towards the server";
  ASSERT_TRUE(server.send_to(back->from, "welcome"));
  EXPECT_EQ(again.receive()->bytes, "welcome");
  ASSERT_TRUE(other.send("other"));
  ASSERT_TRUE(server.receive());
  third.connect(proxy->listening());
  ASSERT_TRUE(third.send("third"));
  ASSERT_TRUE(server.receive());
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.clients == 3; }));
  proxy.end();
  const ProxyStatus status = proxy->final_status();
  EXPECT_EQ(status.clients_seen, 3U);
  std::set<std::uint64_t> numbers;
  for (std::size_t i = 0; i < status.clients; ++i) numbers.insert(status.client[i].number);
  EXPECT_EQ(numbers, (std::set<std::uint64_t>{1, 2, 3}));
}

TEST(Proxy, KeepsOrderThroughJitter) {
  UdpPeer server, client;
  Running proxy{server.address(), link_from({.delay = 2ms, .jitter = 10ms})};
  client.connect(proxy->listening());
  // 100 at a time: the kernel's default buffers hold fewer than 300.
  for (int i = 0; i < 500; ++i) {
    ASSERT_TRUE(client.send(std::to_string(i)));
    if (i % 100 != 99) continue;
    for (int expected = i - 99; expected <= i; ++expected) {
      const auto got = server.receive();
      ASSERT_TRUE(got) << expected;
      ASSERT_EQ(got->bytes, std::to_string(expected));
    }
  }
}

TEST(Proxy, DropsAndCopiesAsTheEngineDecides) {
  UdpPeer server, client;
  LinkSpec link = link_from({.loss = 0.3, .duplicate = 0.2});
  Running proxy{server.address(), link};
  client.connect(proxy->listening());
  // Loss and copies are drawn per datagram, not per time: equal to link 0 of a virtual network with this seed.
  Path path{link.up, Path::key_for(1, 0, Direction::kUp)};
  std::multiset<std::string> expected, got;
  for (int i = 0; i < 500; ++i) {
    const std::string bytes = std::to_string(i);
    const PathDecision v = path.send(Time{}, bytes.size());
    if (v.outcome == Outcome::kDeliver) expected.insert(bytes);
    if (v.copied) expected.insert(bytes);
    ASSERT_TRUE(client.send(bytes));
    while (i % 50 == 49 && got.size() < expected.size()) {
      const auto received = server.receive();
      ASSERT_TRUE(received) << got.size() << " of " << expected.size();
      got.insert(received->bytes);
    }
  }
  EXPECT_GT(expected.size(), 300U);
  EXPECT_EQ(got, expected);
}

TEST(Proxy, DeliversNothingAtFullLoss) {
  UdpPeer server, client;
  Running proxy{server.address(), link_from({.loss = 1})};
  client.connect(proxy->listening());
  for (int i = 0; i < 20; ++i) ASSERT_TRUE(client.send("x"));
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.total[0].of(Outcome::kLost) == 20; }));
  EXPECT_FALSE(server.receive(50));
}

TEST(Proxy, ToleratesAServerThatStartsLater) {
  // A port that was free before.
  io::SocketAddress to;
  {
    to = UdpPeer{}.address();
  }
  UdpPeer client;
  Running proxy{to, {}};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send("lost"));
  ASSERT_TRUE(client.send("home"));
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.errors.refused > 0; }));
  UdpPeer server{io::to_text(to)};
  ASSERT_TRUE(server.bound());
  // Datagrams sent to a closed port may cost one more datagram; then all pass.
  std::optional<UdpPeer::Received> got;
  for (int i = 0; i < 10 && !got; ++i) {
    ASSERT_TRUE(client.send("hello"));
    got = server.receive(500);
  }
  ASSERT_TRUE(got);
  ASSERT_TRUE(server.send_to(got->from, "welcome"));
  EXPECT_EQ(client.receive()->bytes, "welcome");
}

TEST(Proxy, ToleratesAClientThatDisappears) {
  UdpPeer server, other;
  Running proxy{server.address(), {}};
  io::SocketAddress upstream;
  {
    UdpPeer gone;
    gone.connect(proxy->listening());
    ASSERT_TRUE(gone.send("bye"));
    upstream = server.receive()->from;
  }
  for (int i = 0; i < 10; ++i) ASSERT_TRUE(server.send_to(upstream, "are you there"));
  other.connect(proxy->listening());
  ASSERT_TRUE(other.send("I am"));
  EXPECT_EQ(server.receive()->bytes, "I am");
}

TEST(Proxy, RemovesASilentClientAndAcceptsItAgain) {
  UdpPeer server, client;
  Running proxy{server.address(), {}, "127.0.0.1:0", 1ms};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send("1"));
  ASSERT_TRUE(server.receive());
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.clients_seen == 1 && s.clients == 0; }));
  ASSERT_TRUE(client.send("2"));
  EXPECT_EQ(server.receive()->bytes, "2");
  proxy.end();
  EXPECT_EQ(proxy->final_status().clients_seen, 2U);
  EXPECT_EQ(proxy->final_status().total[0].out, 2U);  // totals include clients that left
}

TEST(Proxy, AcceptsSixtyFourClients) {
  UdpPeer server;
  Running proxy{server.address(), {}};
  std::vector<std::unique_ptr<UdpPeer>> clients;
  for (int i = 0; i < 65; ++i) {
    clients.push_back(std::make_unique<UdpPeer>());
    clients.back()->connect(proxy->listening());
    ASSERT_TRUE(clients.back()->send("x"));
    ASSERT_TRUE(i == 64 || server.receive()) << i;
  }
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.errors.too_many_clients == 1; }));
  EXPECT_EQ(proxy->status().clients, 64U);
}

TEST(Proxy, TakesDatagramsOfAnySize) {
  UdpPeer server, client;
  Running proxy{server.address(), {}};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send(std::string(65'507, 'x')));
  ASSERT_TRUE(client.send(std::string(1501, 'x')));
  ASSERT_TRUE(client.send(std::string(1500, 'y')));
  ASSERT_TRUE(client.send(""));
  EXPECT_EQ(server.receive()->bytes, std::string(1500, 'y'));
  EXPECT_EQ(server.receive()->bytes, "");
  ASSERT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.errors.too_long == 2; }));
}

TEST(Proxy, SupportsIpv6) {
  UdpPeer server{"[::1]:0"}, client{"[::1]:0"};
  if (!server.bound()) GTEST_SKIP() << "this computer has no IPv6 loopback";
  Running proxy{server.address(), {}, "[::1]:0"};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send("six"));
  const auto got = server.receive();
  ASSERT_TRUE(got);
  ASSERT_TRUE(server.send_to(got->from, "six too"));
  EXPECT_EQ(client.receive()->bytes, "six too");
}

// Bound to "any": a reply must come from the address to which the client sent, or a connected client ignores it.
TEST(Proxy, RepliesFromTheAddressTheClientUsed) {
  UdpPeer server, client;
  Running proxy{server.address(), {}, "0.0.0.0:0"};
  const auto second = io::parse_address("127.0.0.2:" + std::to_string(proxy->listening().port()), 1);
  ASSERT_TRUE(second);
  client.connect(*second);
  ASSERT_TRUE(client.send("hello"));
  const auto got = server.receive();
  ASSERT_TRUE(got);
  ASSERT_TRUE(server.send_to(got->from, "hello too"));
  const auto answer = client.receive();
  ASSERT_TRUE(answer);
  EXPECT_EQ(answer->bytes, "hello too");
}

TEST(Proxy, NamesTheRemedyForAPortInUse) {
  UdpPeer taken;
  ProxyOptions options;
  options.listen = taken.address();
  options.to = taken.address();
  const auto proxy = Proxy::open(options);
  ASSERT_FALSE(proxy);
  EXPECT_NE(proxy.error().find("in use"), std::string::npos);
  EXPECT_NE(proxy.error().find("choose another port"), std::string::npos);
}

// Clients have sockets on the listening port, which is shareable only while they are created.
TEST(Proxy, RejectsASecondProxyOnItsPort) {
  UdpPeer server, client;
  Running proxy{server.address(), {}};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send("hello"));
  ASSERT_TRUE(server.receive());
  ProxyOptions options;
  options.listen = proxy->listening();
  options.to = server.address();
  const auto second = Proxy::open(options);
  ASSERT_FALSE(second);
  EXPECT_NE(second.error().find("in use"), std::string::npos);
}

TEST(Proxy, AcceptsBothAddressesUntilTheOldOneExpires) {
  UdpPeer server, client;
  Running proxy{server.address(), {}};
  client.connect(proxy->listening());
  ASSERT_TRUE(client.send("1"));
  const auto before = server.receive();
  ASSERT_TRUE(before);
  ProxyRequest order;
  order.rebinds = {0};
  order.rebind.dead_after = 1h;
  ASSERT_TRUE(proxy.carry_out(order));
  ASSERT_TRUE(order.succeeded);
  ASSERT_TRUE(client.send("2"));
  const auto after = server.receive();
  ASSERT_TRUE(after);
  EXPECT_NE(after->from.port(), before->from.port());
  ASSERT_TRUE(server.send_to(before->from, "to the old one"));
  EXPECT_EQ(client.receive()->bytes, "to the old one");
  ASSERT_TRUE(server.send_to(after->from, "to the new one"));
  EXPECT_EQ(client.receive()->bytes, "to the new one");

  ProxyRequest again;
  again.rebinds = {0};
  ASSERT_TRUE(proxy.carry_out(again));  // dead at once
  ASSERT_TRUE(server.send_to(after->from, "to the old address"));
  ASSERT_TRUE(client.send("3"));
  const auto third = server.receive();
  ASSERT_TRUE(third);
  EXPECT_NE(third->from.port(), after->from.port());
  ASSERT_TRUE(server.send_to(third->from, "to the third"));
  EXPECT_EQ(client.receive()->bytes, "to the third");
  proxy.end();
  EXPECT_EQ(proxy->final_status().total[1].of(Outcome::kOldAddress), 1U);
  EXPECT_EQ(proxy->final_status().clients_seen, 1U);
}

// The packet thread allocates nothing while clients join and send, also after a change of the network.
TEST(Proxy, AcceptsClientsWithoutHeap) {
  UdpPeer server;
  ProxyOptions options = Running::options(server.address(), {everything(), everything()});
  options.coalesce = Duration{};
  auto proxy = std::move(*Proxy::open(options));
  std::uint64_t taken = 0;
  std::thread packets([&] {
    const std::uint64_t before = heap_allocations();
    proxy->run();
    taken = heap_allocations() - before;
  });
  const auto seen = [&](std::uint64_t clients) {
    for (int i = 0; i < UdpPeer::kPatienceMs / 10 && proxy->status().clients_seen < clients; ++i)
      ::poll(nullptr, 0, 10);
    return proxy->status().clients_seen == clients;
  };
  std::vector<std::unique_ptr<UdpPeer>> clients;
  const auto join = [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) {
      clients.push_back(std::make_unique<UdpPeer>());
      clients.back()->connect(proxy->listening());
      EXPECT_TRUE(clients.back()->send("x"));
    }
    EXPECT_TRUE(seen(clients.size()));
    proxy->pool().refill();
  };
  join(ClientPool::kReady);  // all at once
  join(10);                  // prepared again after the first ones
  std::vector<std::uint64_t> present(clients.size());
  std::iota(present.begin(), present.end(), std::uint64_t{0});
  ProxyRequest order;
  order.changes.push_back(proxy->links().prepare_change(link_from({.delay = 2ms}), present, true));
  EXPECT_TRUE(proxy->post(order));
  for (int i = 0; i < UdpPeer::kPatienceMs / 10 && !order.done.load(); ++i) ::poll(nullptr, 0, 10);
  proxy->pool().refill();
  join(10);  // with the present network
  proxy->stop();
  packets.join();
  EXPECT_EQ(proxy->pool().misses(), 0U);
  EXPECT_EQ(taken, 0U);
}

TEST(Proxy, AcceptsAndCountsClientsBeyondThePool) {
  UdpPeer server;
  Running proxy{server.address(), {}};
  std::vector<std::unique_ptr<UdpPeer>> clients;
  for (std::size_t i = 0; i < ClientPool::kReady + 3; ++i) {  // without refill
    clients.push_back(std::make_unique<UdpPeer>());
    clients.back()->connect(proxy->listening());
    ASSERT_TRUE(clients.back()->send("x"));
  }
  EXPECT_TRUE(proxy.wait_until([](const ProxyStatus& s) { return s.total[0].out == ClientPool::kReady + 3; }));
  EXPECT_EQ(proxy->pool().misses(), 3U);
}

TEST(Proxy, ReportsACommandForAnAbsentClient) {
  UdpPeer server;
  Running proxy{server.address(), {}};
  ProxyRequest order;
  order.rebinds = {7};
  ASSERT_TRUE(proxy.carry_out(order));
  EXPECT_FALSE(order.succeeded);
}

TEST(SocketAddress, ParsesAndFormatsTypedAddresses) {
  EXPECT_EQ(io::to_text(*io::parse_address("127.0.0.1:7000", 1)), "127.0.0.1:7000");
  EXPECT_EQ(io::to_text(*io::parse_address("[::1]:7000", 1)), "[::1]:7000");
  EXPECT_EQ(io::to_text(*io::parse_address("localhost:80", 1)), "127.0.0.1:80");
  for (const char* wrong : {"", "127.0.0.1", "127.0.0.1:", "127.0.0.1:0", "127.0.0.1:65536", "127.0.0.1:-1", "::1:7000",
                            ":7000", "127.0.0.1:7000x", "no.such.host.invalid:1"}) {
    EXPECT_FALSE(io::parse_address(wrong, 1)) << wrong;
  }
}

}  // namespace
}  // namespace tandem::netsim
