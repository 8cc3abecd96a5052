// Measures one package: the processor time of its server's process per client-tick, and the loop as clients see it.
// Prints one line for `peers`. Arguments: CLIENTS SECONDS plain|sealed
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <exception>
#include <string_view>

#include "common/io/clock.h"
#include "proto/wire/body_layout.h"
#include "tests/bench/peers/peer.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr auto kWarmUp = 700ms;  // connections, and ramps of Tandem's hands
constexpr int kCannotEncrypt = 3;

/// The server's process. It ends with this object.
class ServerProcess {
 public:
  explicit ServerProcess(Peer& peer) {
    int ends[2];
    if (pipe(ends) != 0) throw std::runtime_error("no pipe");
    pid_ = fork();
    if (pid_ == 0) {
      prctl(PR_SET_PDEATHSIG, SIGKILL);
      close(ends[0]);
      try {
        peer.serve([&](std::uint16_t port) {
          if (write(ends[1], &port, sizeof port) != sizeof port) _exit(1);
        });
      } catch (const std::exception& e) {
        std::fprintf(stderr, "server: %s\n", e.what());
      }
      _exit(1);
    }
    close(ends[1]);
    const bool told = read(ends[0], &port_, sizeof port_) == sizeof port_;
    close(ends[0]);
    if (pid_ < 0 || !told) throw std::runtime_error("the server did not start");
    clock_getcpuclockid(pid_, &clock_);
  }
  ~ServerProcess() {
    kill(pid_, SIGKILL);
    waitpid(pid_, nullptr, 0);
  }
  ServerProcess(const ServerProcess&) = delete;
  ServerProcess& operator=(const ServerProcess&) = delete;

  [[nodiscard]] std::uint16_t port() const { return port_; }
  [[nodiscard]] Duration cpu() const { return io::read_clock(clock_); }  ///< of all its threads, user and system

 private:
  pid_t pid_ = -1;
  clockid_t clock_{};
  std::uint16_t port_ = 0;
};

struct Loops {
  std::vector<std::int64_t> loop, path;  ///< [ns]; path: without the wait for a tick
};

/// All clients send at each millisecond for `length`. @return number of messages sent
std::uint64_t exchange_messages(PeerClients& clients, std::size_t count, Duration length, Loops& loops) {
  const Heard heard = [&](Duration loop, Duration held) {
    loops.loop.push_back(loop.count());
    loops.path.push_back((loop - held).count());
  };
  const Time begin = io::monotonic_now();
  const auto ticks = length / 1ms;
  for (std::int64_t tick = 0; tick < ticks; ++tick) {
    for (std::size_t c = 0; c < count; ++c) clients.send(c);
    clients.flush();
    clients.receive(begin + (tick + 1) * 1ms, heard);
  }
  return static_cast<std::uint64_t>(ticks) * count;
}

double quantile_us(std::vector<std::int64_t>& values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return static_cast<double>(*at) / 1e3;
}

int measure(const Exchange& exchange, Duration length) {
  const auto peer = make_peer(exchange);
  if (!peer) return kCannotEncrypt;
  const ServerProcess server(*peer);
  const auto clients = peer->connect(server.port());
  Loops loops;
  const auto reserve = static_cast<std::size_t>((kWarmUp + 2 * length) / 1ms) * exchange.clients;
  loops.loop.reserve(reserve), loops.path.reserve(reserve);
  exchange_messages(*clients, exchange.clients, kWarmUp, loops);
  loops.loop.clear(), loops.path.clear();
  const Duration before = server.cpu();
  const std::uint64_t sent = exchange_messages(*clients, exchange.clients, length, loops);
  const Duration spent = server.cpu() - before;
  const auto answered = static_cast<double>(loops.loop.size());
  std::printf("cpu_ns=%.0f loop_p50_us=%.1f loop_p99_us=%.1f path_p50_us=%.1f answered=%.4f\n",
              answered > 0 ? static_cast<double>(spent.count()) / answered : 0, quantile_us(loops.loop, 0.5),
              quantile_us(loops.loop, 0.99), quantile_us(loops.path, 0.5), answered / static_cast<double>(sent));
  std::fflush(stdout);
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem;
  const int clients = argc == 4 ? std::atoi(argv[1]) : 0;
  const double length = argc == 4 ? std::atof(argv[2]) : 0;
  const std::string_view how = argc == 4 ? argv[3] : "";
  if (clients < 1 || clients > 300 || !(length > 0 && length <= 60) || (how != "plain" && how != "sealed")) {
    std::fprintf(stderr, "usage: %s CLIENTS SECONDS plain|sealed   (1 to 300 clients, up to 60 s)\n", argv[0]);
    return 2;
  }
  prctl(PR_SET_TIMERSLACK, 1UL);
  constexpr wire::BodyLayout kThreeAxes{.axes = 3, .port = PortSpace::kTip};
  const bench::Exchange exchange{.clients = static_cast<std::size_t>(clients),
                                 .up = wire::state_size(kThreeAxes, false),
                                 .down = wire::force_size(kThreeAxes),
                                 .sealed = how == "sealed"};
  int code = 1;
  try {
    code = bench::measure(exchange, from_seconds(length));
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
  return code;
}
