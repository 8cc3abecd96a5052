// How many clients at 1 kHz one core serves, by the loop that the clients see: from sending a STATE to the arrival of
// the FORCE that answers it. The server's thread has one processor, the clients another. Their ticks are spread over
// the millisecond. The reference is a bare echo of the same datagrams, which answers each at once (recvmmsg, sendmmsg):
// its loop at the same number of clients, and its pairs per second when it is saturated.
#include <sched.h>
#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "client/seat/tick_phase.h"
#include "proto/wire/body_layout.h"
#include "tests/bench/answering_echo.h"
#include "tests/bench/crowd.h"
#include "tests/bench/phased_crowd.h"
#include "tests/bench/seated_shard.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr Duration kWarmUp = 700ms, kLength = 500ms;
constexpr double kShareAsked = 0.65, kBeyondAskedUs = 1000, kAnsweredMin = 0.995;

constexpr wire::BodyLayout kThreeAxes{.axes = 3, .port = PortSpace::kTip};
constexpr std::size_t kSealed = 32;  // header and tag of a sealed datagram [bytes]

/// Keeps the calling thread, and those that it starts later, on one processor.
void stay_on(int processor) {
  cpu_set_t set;
  CPU_ZERO(&set);
  CPU_SET(processor, &set);
  sched_setaffinity(0, sizeof set, &set);
}

/// Returns the processors that this program may use.
std::vector<int> processors() {
  cpu_set_t set;
  sched_getaffinity(0, sizeof set, &set);
  std::vector<int> ids;
  for (int p = 0; p < CPU_SETSIZE; ++p)
    if (CPU_ISSET(p, &set)) ids.push_back(p);
  return ids;
}

double quantile_us(std::vector<std::int64_t> values, double q) {
  if (values.empty()) return 0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::ranges::nth_element(values, at);
  return 1e-3 * static_cast<double>(*at);
}

double median(std::vector<double> v) {
  std::ranges::sort(v);
  return v[v.size() / 2];
}

/// One round, as its clients saw it.
struct Seen {
  double share = 0;         ///< processor time of the server's thread / length
  double p50 = 0, p99 = 0;  ///< of the loop [us]
  double answered = 0;      ///< answers / datagrams sent
  double late = 0;          ///< 99th percentile of the lateness with which the clients sent [us]
  double tick = 0;          ///< processor time of a tick of the server, p99 of 1000, as share of its period
};

constexpr std::size_t state_bytes() { return wire::state_size(kThreeAxes, false) + kSealed; }
constexpr std::size_t force_bytes() { return wire::force_size(3) + kSealed; }

/// Begins the thread of a server on the first processor, and leaves the clients on the second.
template <class Make>
auto beside(const std::vector<int>& on, const Make& make) {
  stay_on(on[0]);
  auto server = make();
  stay_on(on[1]);
  return server;
}

Seen see_echo(std::size_t clients, const std::vector<int>& on) {
  constexpr std::size_t kKept = 4096;
  const auto echo = beside(on, [] { return std::make_unique<AnsweringEcho>(force_bytes()); });
  PhasedCrowd crowd{clients, echo->address()};
  std::vector<std::uint32_t> number(clients);
  std::vector<Time> sent(clients * kKept);
  std::vector<bool> turn(clients);
  std::vector<std::int64_t> loops;
  std::uint64_t count = 0;
  const auto send = [&](std::size_t c, Time now, std::span<std::byte> buffer) -> std::size_t {
    turn[c] = !turn[c];
    if (!turn[c]) return 0;
    const std::uint32_t n = number[c]++;
    std::memcpy(buffer.data(), &n, sizeof n);
    sent[c * kKept + n % kKept] = now;
    ++count;
    return state_bytes();
  };
  const auto hear = [&](std::size_t c, Time arrived, std::span<const std::byte> bytes) {
    std::uint32_t n = 0;
    std::memcpy(&n, bytes.data(), sizeof n);
    if (number[c] - n < kKept) loops.push_back((arrived - sent[c * kKept + n % kKept]).count());
  };
  const auto stay = [](std::size_t) { return Duration{}; };
  crowd.run(kWarmUp, send, hear, stay);
  loops.clear(), count = 0, static_cast<void>(crowd.take_lateness());
  const Duration before = echo->cpu();
  crowd.run(kLength, send, hear, stay);
  const double share = seconds(echo->cpu() - before) / seconds(kLength);
  return {share, quantile_us(loops, 0.5), quantile_us(loops, 0.99),
          static_cast<double>(loops.size()) / static_cast<double>(count), quantile_us(crowd.take_lateness(), 0.99)};
}

/// A shard on a thread of its own.
struct Served {
  Served(const SceneSpec& scene, std::size_t sessions)
      : seated(scene, sessions, false), thread([this] { seated.shard().run(); }) {}
  ~Served() {
    seated.shard().stop();
    thread.join();
  }
  Served(const Served&) = delete;
  Served& operator=(const Served&) = delete;
  SeatedShard seated;
  std::thread thread;
};

/// @param aligned  the clients shift their ticks, as `tandem-client` does; otherwise their phases are arbitrary
std::optional<Seen> see_shard(const SceneSpec& scene, std::size_t sessions, const std::vector<int>& on, bool aligned) {
  const auto served = beside(on, [&] { return std::make_unique<Served>(scene, sessions); });
  auto& clients = served->seated.clients();
  PhasedCrowd crowd{clients.size(), served->seated.address()};
  std::vector<bool> turn(clients.size());
  std::vector<std::int64_t> loops;
  std::uint64_t count = 0;
  std::uint32_t tick = 0;
  std::vector<client::TickPhase> phases(clients.size(), client::TickPhase{1ms});
  const auto send = [&](std::size_t c, Time now, std::span<std::byte> buffer) -> std::size_t {
    const bool answers = clients[c]->answers();
    if (!answers) turn[c] = !turn[c];
    if (!answers && !turn[c]) return 0;
    ++count;
    return clients[c]->send(now, ++tick, buffer);
  };
  const auto hear = [&](std::size_t c, Time arrived, std::span<const std::byte> bytes) {
    const std::uint64_t before = clients[c]->forces();
    clients[c]->hear(arrived, bytes);
    if (clients[c]->forces() == before) return;
    const transport::LinkTiming& timing = clients[c]->link().timing();
    loops.push_back(timing.loop_age(arrived).count());
    phases[c].record(timing.peer_silence(), timing.loop_age(arrived));
  };
  const auto stay = [&](std::size_t c) { return aligned ? phases[c].next_shift() : Duration{}; };
  crowd.run(kWarmUp, send, hear, stay);
  if (!std::ranges::all_of(clients, [](const auto& c) { return c->settled(); })) return std::nullopt;
  loops.clear(), count = 0, static_cast<void>(crowd.take_lateness());
  const Duration before = cpu_of(served->thread.native_handle());
  crowd.run(kLength, send, hear, stay);
  const double share = seconds(cpu_of(served->thread.native_handle()) - before) / seconds(kLength);
  return Seen{share,
              quantile_us(loops, 0.5),
              quantile_us(loops, 0.99),
              static_cast<double>(loops.size()) / static_cast<double>(count),
              quantile_us(crowd.take_lateness(), 0.99),
              served->seated.shard().load().tick_share()};
}

/// Returns the pairs per second that the echo's thread answers while more datagrams arrive than it can answer.
double saturated_echo(const std::vector<int>& on) {
  const auto echo = beside(on, [] { return std::make_unique<AnsweringEcho>(force_bytes()); });
  std::vector<io::Fd> sockets;
  for (int i = 0; i < 64; ++i) sockets.push_back(std::move(io::connect_udp(echo->address())->fd));
  const std::vector<std::byte> bytes(state_bytes());
  const auto flood = [&](Duration length) {
    for (const Time end = io::monotonic_now() + length; io::monotonic_now() < end;) {
      for (const io::Fd& socket : sockets) {
        io::SendBatch batch;
        for (int i = 0; i < 16; ++i) batch.add(bytes, nullptr, nullptr);
        batch.send(socket.get());
      }
    }
  };
  flood(100ms);
  const std::uint64_t before = echo->answered();
  const Duration cpu = echo->cpu();
  flood(kLength);
  return static_cast<double>(echo->answered() - before) / seconds(echo->cpu() - cpu);
}

struct Row {
  std::size_t sessions = 0;
  std::vector<double> share{}, p50{}, p99{}, any_p50{}, any_p99{}, echo_p50{}, echo_p99{}, beyond{}, answered{}, late{},
      tick{};
  bool settled = true;
};

void measure(Row& row, const SceneSpec& scene, const std::vector<int>& on) {
  const std::size_t clients = row.sessions * scene.seats.size();
  const Seen echo = see_echo(clients, on);
  const auto any = see_shard(scene, row.sessions, on, false);
  const auto shard = see_shard(scene, row.sessions, on, true);
  row.settled = row.settled && shard && any;
  if (!row.settled) return;
  row.any_p50.push_back(any->p50), row.any_p99.push_back(any->p99);
  row.share.push_back(shard->share);
  row.p50.push_back(shard->p50), row.p99.push_back(shard->p99);
  row.echo_p50.push_back(echo.p50), row.echo_p99.push_back(echo.p99);
  row.beyond.push_back(shard->p99 - echo.p99);
  row.answered.push_back(shard->answered), row.late.push_back(shard->late);
  row.tick.push_back(shard->tick);
}

bool good(const Row& row) {
  return row.settled && median(row.beyond) <= kBeyondAskedUs && median(row.answered) >= kAnsweredMin;
}

void find_limit(const SceneSpec& scene, const std::vector<int>& on, int rounds,
                const std::vector<std::size_t>& sessions) {
  std::vector<Row> rows;
  for (const std::size_t s : sessions) rows.push_back({.sessions = s});
  prctl(PR_SET_TIMERSLACK, 1UL);
  setpriority(PRIO_PROCESS, 0, -20);  // not SCHED_FIFO: the kernel would throttle a thread that waits actively
  std::vector<double> pairs;
  for (int round = 0; round < rounds; ++round) {
    pairs.push_back(saturated_echo(on));
    for (Row& row : rows) measure(row, scene, on);
    std::fprintf(stderr, "round %d of %d\n", round + 1, rounds);
  }
  std::printf("%7s %7s %8s %20s %20s %20s %10s %9s %10s\n", "clients", "core", "tick p99", "loop p50 / p99 [us]",
              "any phase", "echo", "p99 beyond", "answered", "late p99");
  std::size_t most = 0;
  bool all = true;
  for (const Row& row : rows) {
    const std::size_t clients = row.sessions * scene.seats.size();
    all = all && good(row);
    if (all) most = clients;
    if (!row.settled) {
      std::printf("%7zu  not every hand was engaged\n", clients);
      continue;
    }
    std::printf("%7zu %7.2f %8.2f %11.0f / %6.0f %11.0f / %6.0f %11.0f / %6.0f %10.0f %7.1f %% %10.0f\n", clients,
                median(row.share), median(row.tick), median(row.p50), median(row.p99), median(row.any_p50),
                median(row.any_p99), median(row.echo_p50), median(row.echo_p99), median(row.beyond),
                100 * median(row.answered), median(row.late));
  }
  std::printf(
      "clients with a p99 of at most %.0f us beyond the echo's: %zu; echo, saturated: %.0f pairs/s of a core; share "
      "%.2f, asked at least %.2f\n",
      kBeyondAskedUs, most, median(pairs), static_cast<double>(most) * 1e3 / median(pairs), kShareAsked);
}

}  // namespace
}  // namespace tandem::bench

/// Arguments: rounds; numbers of sessions, ascending.
int main(int argc, char** argv) {
  using namespace tandem;
  const auto on = bench::processors();
  if (on.size() < 2) {
    std::printf("[ NOT RUN ] the server and its clients need a processor each\n");
    return 0;
  }
  const int rounds = argc > 1 ? std::atoi(argv[1]) : 5;
  std::vector<std::size_t> sessions;
  for (int i = 2; i < argc; ++i) sessions.push_back(static_cast<std::size_t>(std::atoi(argv[i])));
  if (sessions.empty()) sessions = {20, 40, 50, 55, 60, 65, 70, 75, 80};
  bench::find_limit(test::shipped("contact_remote"), on, rounds, sessions);
  return 0;
}
