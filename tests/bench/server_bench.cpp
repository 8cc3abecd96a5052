// Measures the server's cost of a sealed client-tick (open, decode, step, encode, seal; 3 axes). It counts user-space
// instructions with callgrind. It also compares the CPU time of the shard's thread with a bare recvmmsg/sendmmsg echo
// of the same datagrams in the same run.
#include <pthread.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/process/shard.h"
#include "tests/bench/bench_clients.h"
#include "tests/bench/instruction_count.h"
#include "tests/bench/served_sessions.h"
#include "tests/bench/udp_load.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Returns the instructions inside `function` per client-tick after all hands are engaged; nothing if callgrind did not
/// run.
std::optional<double> per_client_tick(const std::string& self, const std::string& scene, const std::string& function) {
  constexpr int kFew = 300, kMany = 1300;
  const auto run = [&](int ticks) {
    return count_instructions(self + " --serve " + scene + " " + std::to_string(ticks), function,
                              "server_bench." + std::to_string(getpid()) + ".callgrind");
  };
  const auto few = run(kFew), many = run(kMany);
  if (!few || !many) return std::nullopt;
  return (many->all - few->all) / (static_cast<double>(kSessions * test::shipped(scene).seats.size()) * (kMany - kFew));
}

void print_instructions(const std::string& self) {
  std::printf("user-space instructions per sealed client-tick (callgrind; asked: at most 7000)\n%-18s %8s %14s  %s\n",
              "scene", "seats", "instructions", "other work of the server");
  const struct {
    const char *scene, *besides;
  } cases[] = {{"contact_remote", "one tool, its slave is a client"},
               {"free_motion", "one tool"},
               {"two_by_two", "two tools"},
               {"eight_seats", "one tool, eight hands"}};
  for (const auto& c : cases) {
    const auto all = per_client_tick(self, c.scene, "*serve_one_tick*");
    if (!all) {
      std::printf("%-18s [ NOT RUN ] valgrind is missing or failed\n", c.scene);
      continue;
    }
    std::printf("%-18s %8zu %14.0f  %s\n", c.scene, test::shipped(c.scene).seats.size(), *all, c.besides);
  }
}

Duration cpu_of(pthread_t thread) {
  clockid_t clock{};
  pthread_getcpuclockid(thread, &clock);
  return io::read_clock(clock);
}

/// Answers each datagram with `size` bytes, in batches, once per millisecond: the minimum cost of any server.
class Echo {
 public:
  Echo(io::UdpSocket socket, std::size_t size) : socket_(std::move(socket)), size_(size) {}
  void run() {
    io::request_realtime(70);
    Time due = io::monotonic_now() + 1ms;
    while (!stop_.load()) {
      UdpLoad::pause_until(due.time_since_epoch());
      due += 1ms;
      int count = 0;
      while ((count = in_.receive(socket_.fd.get())) > 0) {
        for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
          to_[i].size = in_.from(i).ss_family == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in);
          std::memcpy(&to_[i].storage, &in_.from(i), to_[i].size);
          out_.add(std::span{bytes_}.first(size_), &to_[i], nullptr);
        }
        out_.send(socket_.fd.get());
        answered_ += static_cast<std::uint64_t>(count);
      }
    }
  }
  void stop() { stop_.store(true); }
  [[nodiscard]] std::uint64_t answered() const { return answered_.load(); }

 private:
  io::UdpSocket socket_;
  std::size_t size_;
  std::atomic<bool> stop_{false};
  std::atomic<std::uint64_t> answered_{0};
  io::ReceiveBatch in_;
  io::SendBatch out_;
  std::array<std::byte, transport::kDatagramMax> bytes_{};
  std::array<io::SocketAddress, io::ReceiveBatch::kMax> to_{};
};

/// Sockets of many clients. One thread drives them: all clients send at the start of each millisecond.
class Crowd {
 public:
  Crowd(std::size_t clients, const io::SocketAddress& to) {
    for (std::size_t i = 0; i < clients; ++i) sockets_.push_back(std::move(io::connect_udp(to)->fd));
  }
  template <class Fill, class Hear>
  void run(Duration length, Fill fill, Hear hear) {
    std::array<std::byte, 1500> buffer;
    const Time begin = io::monotonic_now();
    for (int ms = 1; ms <= length / 1ms; ++ms) {
      UdpLoad::pause_until((begin + ms * 1ms).time_since_epoch());
      for (std::size_t c = 0; c < sockets_.size(); ++c) {
        for (ssize_t size; (size = ::recv(sockets_[c].get(), buffer.data(), buffer.size(), MSG_DONTWAIT)) > 0;)
          hear(c, std::span{buffer}.first(static_cast<std::size_t>(size)));
        for (std::size_t size; (size = fill(c, buffer)) > 0;) [[maybe_unused]]
          const auto sent = ::send(sockets_[c].get(), buffer.data(), size, 0);
      }
    }
  }

 private:
  std::vector<io::Fd> sockets_;
};

constexpr wire::BodyLayout kThreeAxes{.axes = 3, .port = PortSpace::kTip};
constexpr std::size_t kStateBytes = wire::state_size(kThreeAxes, false) + 32, kForceBytes = wire::force_size(3) + 32;

/// Returns the CPU time of the echo's thread per datagram pair [ns].
double echo_cost(std::size_t clients, Duration length) {
  auto socket = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
  Crowd crowd{clients, socket->local};
  Echo echo{std::move(*socket), kForceBytes};
  std::thread thread{[&] { echo.run(); }};
  std::vector<bool> sent(clients, false);
  const auto fill = [&](std::size_t c, std::span<std::byte>) -> std::size_t {
    sent[c] = !sent[c];
    return sent[c] ? kStateBytes : 0;
  };
  crowd.run(200ms, fill, [](std::size_t, auto) {});
  const Duration cpu = cpu_of(thread.native_handle());
  const std::uint64_t before = echo.answered();
  crowd.run(length, fill, [](std::size_t, auto) {});
  const Duration spent = cpu_of(thread.native_handle()) - cpu;
  const auto pairs = static_cast<double>(echo.answered() - before);
  echo.stop();
  thread.join();
  return static_cast<double>(spent.count()) / pairs;
}

/// Returns the CPU time of the shard's thread per client-tick [ns]; negative if not every hand was engaged.
double shard_cost(const SceneSpec& scene, std::size_t sessions, Duration length) {
  auto socket = io::bind_udp(*io::parse_address("127.0.0.1:0", 0));
  const io::SocketAddress at = socket->local;
  auto shard = std::make_unique<server::Shard>(std::move(*socket), scene.tick_hz);
  std::vector<std::unique_ptr<server::TickQueue>> queues;
  std::vector<std::unique_ptr<server::LiveSession>> hosted;
  std::vector<std::unique_ptr<BareClient>> clients;
  std::vector<server::ShardRequest> orders(sessions);
  for (std::size_t s = 0; s < sessions; ++s) {
    queues.push_back(std::make_unique<server::TickQueue>(
        64));  // full soon: the shard drops and counts further rows, as with a late recorder
    hosted.push_back(std::make_unique<server::LiveSession>(scene, *server::make_local_slaves(scene, Time{}),
                                                           static_cast<std::uint8_t>(s), *queues.back()));
    for (std::size_t i = 0; i < scene.seats.size(); ++i)
      clients.push_back(std::make_unique<BareClient>(
          *netsim::simulate_join(hosted.back()->session(), io::monotonic_now(), i, caps_of(scene, i), RandomKey{s}, i,
                                 false, static_cast<std::uint8_t>(s))));
    orders[s].what = server::ShardRequest::What::kAddSession;
    orders[s].session = hosted.back().get();
    if (!shard->post(orders[s])) return -1;
  }
  Crowd crowd{clients.size(), at};
  std::thread thread{[&] { shard->run(); }};
  std::vector<bool> sent(clients.size(), false);
  std::uint32_t tick = 0;
  const auto fill = [&](std::size_t c, std::span<std::byte> buffer) -> std::size_t {
    const bool answers = clients[c]->answers();
    if (!answers) sent[c] = !sent[c];
    return answers || sent[c] ? clients[c]->send(io::monotonic_now(), ++tick, buffer) : 0;
  };
  const auto hear = [&](std::size_t c, std::span<const std::byte> bytes) {
    clients[c]->hear(io::monotonic_now(), bytes);
  };
  const auto forces = [&] {
    std::uint64_t sum = 0;
    for (const auto& c : clients) sum += c->forces();
    return sum;
  };
  crowd.run(500ms, fill, hear);
  const Duration cpu = cpu_of(thread.native_handle());
  const std::uint64_t before = forces();
  crowd.run(length, fill, hear);
  const Duration spent = cpu_of(thread.native_handle()) - cpu;
  const auto ticks = static_cast<double>(forces() - before);
  const bool all = std::ranges::all_of(clients, [](const auto& c) { return c->settled(); });
  shard->stop();
  thread.join();
  return all ? static_cast<double>(spent.count()) / ticks : -1;
}

void compare_with_echo() {
  constexpr int kPairs = 5;
  const SceneSpec scene = test::shipped("contact_remote");
  const std::size_t sessions = 100 / scene.seats.size(), clients = sessions * scene.seats.size();
  std::vector<double> echo, shard, ratio;
  for (int i = 0; i < kPairs; ++i) {  // interleaved, so that a disturbance affects both
    echo.push_back(echo_cost(clients, 1s));
    shard.push_back(shard_cost(scene, sessions, 1s));
    ratio.push_back(shard.back() / echo.back());
  }
  const auto median = [](std::vector<double> v) {
    std::ranges::sort(v);
    return v[v.size() / 2];
  };
  std::printf(
      "\nCPU of the server's thread, %zu clients of %zu sessions, all at the millisecond (asked: ratio at most 1.4)\n",
      clients, sessions);
  std::printf(
      "cpu_ns_per_client_tick=%.0f ref_echo_cpu_ns_per_pair=%.0f ratio=%.2f [%.2f..%.2f] median of %d interleaved "
      "pairs of 1 s\n",
      median(shard), median(echo), median(ratio), *std::ranges::min_element(ratio), *std::ranges::max_element(ratio),
      kPairs);
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  const std::string only = argc > 1 ? argv[1] : "";
  if (argc == 4 && only == "--serve")
    return tandem::bench::serve(tandem::test::shipped(argv[2]), true, std::nullopt, std::atoi(argv[3]));
  if (only != "--cpu") tandem::bench::print_instructions(argv[0]);
  if (only != "--instructions") tandem::bench::compare_with_echo();
  return 0;
}
