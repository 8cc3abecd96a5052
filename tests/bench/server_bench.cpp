// Measures the server's cost of a sealed client-tick (open, decode, step, encode, seal; 3 axes). It counts user-space
// instructions with callgrind. It also compares the CPU time of the shard's thread with a bare recvmmsg/sendmmsg echo
// of the same datagrams in the same run.
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
#include <string_view>
#include <thread>
#include <vector>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "tests/bench/crowd.h"
#include "tests/bench/hosted_shard.h"
#include "tests/bench/instruction_count.h"
#include "tests/bench/served_sessions.h"
#include "tests/bench/udp_load.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

/// Kinds of work whose instructions are counted.
struct Work {
  std::string_view name;
  Load load;
};
constexpr Work kWorks[] = {{"rest", {}}, {"motion", {.swinging = true}}, {"recorded", {.recorded = true}}};

/// Returns the instructions of a tick per client after all hands are engaged; nothing if callgrind did not run.
std::optional<double> per_client_tick(const std::string& self, const std::string& scene, const Work& work) {
  constexpr int kFew = 300, kMany = 1300;
  const auto run = [&](int ticks) {
    return count_instructions(self + " --serve " + scene + " " + std::to_string(ticks) + " " + std::string(work.name),
                              "*serve_one_tick*", "server_bench." + std::to_string(getpid()) + ".callgrind");
  };
  const auto few = run(kFew), many = run(kMany);
  if (!few || !many) return std::nullopt;
  return (many->all - few->all) / (static_cast<double>(kSessions * test::shipped(scene).seats.size()) * (kMany - kFew));
}

void print_instructions(const std::string& self) {
  std::printf(
      "user-space instructions per sealed client-tick (callgrind; asked for contact_remote: at most 4500). Hands rest, "
      "or swing by 20 mm at 1.5 Hz; recorded: at rest, a report of every tick is written\n%-18s %8s",
      "scene", "seats");
  for (const Work& work : kWorks) std::printf(" %9s", std::string(work.name).c_str());
  std::printf("  other work of the server\n");
  const struct {
    const char *scene, *besides;
  } cases[] = {{"contact_remote", "one tool, its slave is a client"},
               {"free_motion", "one tool"},
               {"two_by_two", "two tools"},
               {"eight_seats", "one tool, eight hands"}};
  for (const auto& c : cases) {
    std::printf("%-18s %8zu", c.scene, test::shipped(c.scene).seats.size());
    for (const Work& work : kWorks) {
      const auto all = per_client_tick(self, c.scene, work);
      if (!all) {
        std::printf(" [ NOT RUN ] valgrind is missing or failed\n");
        return;
      }
      std::printf(" %9.0f", *all);
    }
    std::printf("  %s\n", c.besides);
  }
}

/// Serves sessions for callgrind. @return exit code
int serve_work(const char* scene, int ticks, std::string_view name) {
  for (const Work& work : kWorks)
    if (work.name == name) return serve(test::shipped(scene), work.load, ticks);
  return 2;
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
  HostedShard host{scene, sessions, true};
  host.run(500ms);
  const HostedShard::Spent spent = host.run(length);
  return host.settled() ? spent.ns_per_client_tick() : -1;
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
      "\nCPU of the server's thread, %zu clients of %zu sessions, all at the millisecond (asked: ratio at most 1.35)\n",
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
  if (argc == 5 && only == "--serve") return tandem::bench::serve_work(argv[2], std::atoi(argv[3]), argv[4]);
  if (only != "--cpu") tandem::bench::print_instructions(argv[0]);
  if (only != "--instructions") tandem::bench::compare_with_echo();
  return 0;
}
