// Measures the effect of 50 000 junk datagrams per second on the loop of one client. The result is the age of the
// newest datagram that returned from the server, sampled at 1 kHz. The reference is a bare echo at the same rate under
// the same flood in the same run. Required: 0 % loss; p99.9 is printed beside that of the echo.
#include <array>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <string>
#include <thread>
#include <vector>

#include "common/base/histogram.h"
#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/process/shard.h"
#include "tests/bench/bench_clients.h"
#include "tests/bench/udp_load.h"
#include "tests/io/junk.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kJunkPerMs = 50;
constexpr int kPairs = 3;

struct Outcome {
  Histogram age;  ///< [ns]
  std::uint64_t sent = 0, lost = 0, replies_to_junk = 0;
};

/// Runs a client at 1 kHz. @param step  receives and sends; returns the age of the loop
template <class Step>
void keep_time(Duration length, Outcome& out, Step step) {
  io::request_realtime(60);
  const Time begin = io::monotonic_now();
  for (int ms = 1; ms <= length / 1ms; ++ms) {
    UdpLoad::pause_until((begin + ms * 1ms).time_since_epoch());
    const Duration age = step();
    if (ms > 500) out.age.add(age.count());
  }
}

/// Runs `body`. If `flooded`, another thread sends junk to `to` at the same time.
template <class Body>
void beside_junk(const io::SocketAddress& to, Duration length, bool flooded, Outcome& out, Body body) {
  std::thread flood;
  if (flooded) flood = std::thread{[&] { out.replies_to_junk = test::send_junk(to, length, kJunkPerMs).replies; }};
  body();
  if (flood.joinable()) flood.join();
}

/// Reference: an echo server that returns each datagram to its sender, once per millisecond as the server ticks. It
/// also reads junk, and drops it by its size and first byte.
Outcome echo(Duration length, bool flooded) {
  auto socket = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
  const io::SocketAddress at = socket->local;
  std::atomic<bool> stop{false};
  std::thread server{[&] {
    io::request_realtime(70);
    io::ReceiveBatch in;
    Time due = io::monotonic_now() + 1ms;
    for (; !stop.load(); due += 1ms) {
      UdpLoad::pause_until(due.time_since_epoch());
      for (int count = 0; (count = in.receive(socket->fd.get())) > 0;)
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i)
          if (in.bytes(i).size() == 64 && in.bytes(i)[0] == std::byte{'T'})
            ::sendto(socket->fd.get(), in.bytes(i).data(), 64, 0, reinterpret_cast<const sockaddr*>(&in.from(i)),
                     sizeof(sockaddr_in));
    }
  }};
  auto client = io::connect_udp(at);
  Outcome out;
  std::uint64_t back = 0;
  Time newest = io::monotonic_now();
  beside_junk(at, length, flooded, out, [&] {
    keep_time(length, out, [&] {
      std::array<std::byte, 64> bytes{std::byte{'T'}};
      for (; ::recv(client->fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) > 0; ++back)
        std::memcpy(&newest, &bytes[8], sizeof newest);
      const Time now = io::monotonic_now();
      bytes[0] = std::byte{'T'};
      std::memcpy(&bytes[8], &now, sizeof now);
      ::send(client->fd.get(), bytes.data(), bytes.size(), 0);
      ++out.sent;
      return now - newest;
    });
  });
  UdpLoad::pause_until((io::monotonic_now() + 50ms).time_since_epoch());
  for (std::array<std::byte, 64> bytes; ::recv(client->fd.get(), bytes.data(), bytes.size(), MSG_DONTWAIT) > 0;) ++back;
  stop.store(true);
  server.join();
  out.lost = out.sent - back;
  return out;
}

Outcome session(const SceneSpec& scene, Duration length, bool flooded) {
  auto socket = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
  const io::SocketAddress at = socket->local;
  auto shard = std::make_unique<server::Shard>(std::move(*socket), scene.tick_hz);
  server::TickQueue queue{64};  // full soon: rows that are not recorded cost nothing
  server::LiveSession hosted{scene, *server::make_local_slaves(scene, Time{}), 0, queue};
  BareClient hand{*netsim::simulate_join(hosted.session(), io::monotonic_now(), 0, caps_of(scene, 0), RandomKey{1}, 0)};
  shard->add_session(hosted);
  std::thread server{[&] { shard->run(); }};
  auto client = io::connect_udp(at);
  Outcome out;
  std::uint32_t tick = 0;
  beside_junk(at, length, flooded, out, [&] {
    keep_time(length, out, [&] {
      std::array<std::byte, 1500> buffer;
      for (ssize_t n; (n = ::recv(client->fd.get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
        hand.hear(io::monotonic_now(), std::span{buffer}.first(static_cast<std::size_t>(n)));
      for (bool more = true; more;) {
        more = hand.answers();
        const std::size_t size = hand.send(io::monotonic_now(), ++tick, buffer);
        if (size > 0) ::send(client->fd.get(), buffer.data(), size, 0);
      }
      const Time now = io::monotonic_now();
      return hand.link().timing().heard() ? hand.link().timing().loop_age(now) : Duration{0};
    });
  });
  shard->stop();
  server.join();
  out.sent = hand.link().stats().sent;
  out.lost = hosted.session().seat(0).link() != nullptr ? hosted.session().seat(0).link()->stats().lost() : 0;
  return out;
}

void print(const char* what, const Outcome& o) {
  const auto us = [&](double q) { return static_cast<double>(o.age.quantile(q)) * 1e-3; };
  std::printf("%-22s %9.0f %9.0f %9.0f %12llu %8llu %8llu\n", what, us(0.5), us(0.99), us(0.999),
              static_cast<unsigned long long>(o.sent), static_cast<unsigned long long>(o.lost),
              static_cast<unsigned long long>(o.replies_to_junk));
}

}  // namespace
}  // namespace tandem::bench

int main() {
  using namespace tandem;
  using namespace tandem::bench;
  const SceneSpec scene = test::shipped("one_axis");
  std::printf(
      "age of the loop at the client [us], 1 kHz; flood: %zu datagrams/ms of junk; %d interleaved runs of 3 s\n",
      kJunkPerMs, kPairs);
  std::printf("%-22s %9s %9s %9s %12s %8s %8s\n", "", "p50", "p99", "p99.9", "sent", "lost", "replies");
  for (int i = 0; i < kPairs; ++i) {
    print("echo, quiet", echo(3s, false));
    print("session, quiet", session(scene, 3s, false));
    print("echo, flooded", echo(3s, true));
    print("session, flooded", session(scene, 3s, true));
  }
  return 0;
}
