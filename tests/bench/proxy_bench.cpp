// Compares the CPU time per datagram of the live proxy with that of a bare forwarder: same sockets and load, rounds
// interleaved. On a shared machine only the ratios within one run are meaningful; absolute times are not.
#include <pthread.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "netsim/profiles/profile_loader.h"
#include "netsim/proxy/app/proxy.h"
#include "tests/bench/bare_forwarder.h"
#include "tests/bench/udp_load.h"

namespace {

using namespace tandem;
using namespace std::chrono_literals;

constexpr std::size_t kClients = 20;
constexpr double kRatioAsked = 1.5;

struct Measured {
  double cpu_ns = 0;  ///< per datagram sent into the forwarder
  double share = 0;   ///< of one core
  bench::UdpLoad::Counts counts;
};

/// Measures the CPU time of the thread that runs `forwarder` under `load`.
template <class Forwarder>
Measured measure(Forwarder& forwarder, bench::UdpLoad& load, Duration length, bool spread, Duration delay_max,
                 const char* name) {
  std::thread thread([&] {
    prctl(PR_SET_TIMERSLACK, 1UL);
    prctl(PR_SET_NAME, name);
    forwarder.run();
  });
  clockid_t cpu{};
  pthread_getcpuclockid(thread.native_handle(), &cpu);
  Measured measured;
  if (!load.meet(forwarder.listening())) std::printf("not all clients got through\n");
  bench::UdpLoad::Counts rest;
  load.run(200ms, spread);  // until the forwarder serves all clients
  bench::UdpLoad::pause_until(io::read_clock(CLOCK_MONOTONIC) + delay_max + 50ms);
  load.drain(rest);
  const Duration begin = io::read_clock(CLOCK_MONOTONIC);
  const Duration before = io::read_clock(cpu);
  measured.counts = load.run(length, spread);
  bench::UdpLoad::pause_until(io::read_clock(CLOCK_MONOTONIC) + delay_max + 50ms);
  const Duration used = io::read_clock(cpu) - before;
  const Duration taken = io::read_clock(CLOCK_MONOTONIC) - begin;
  load.drain(measured.counts);
  forwarder.stop();
  thread.join();
  measured.cpu_ns = static_cast<double>(used.count()) / static_cast<double>(measured.counts.sent);
  measured.share = static_cast<double>(used.count()) / static_cast<double>(taken.count());
  return measured;
}

struct Case {
  std::string name;
  netsim::LinkSpec link;
  Duration delay_max{};
  bool spread = false;
  bool lossless = true;
};

struct Row {
  std::vector<double> bare, ours, ratio;
  double share = 0;
  Histogram late;
  std::uint64_t missing = 0, bare_missing = 0, drops = 0;
};

double median(std::vector<double> values) {
  std::ranges::sort(values);
  return values[values.size() / 2];
}

void one_round(const Case& c, Row& row, Duration length) {
  bench::UdpLoad load{kClients};
  bench::BareForwarder bare{load.server()};
  const Measured reference = measure(bare, load, length, c.spread, {}, "bare");
  netsim::ProxyOptions options;
  options.listen = *io::parse_address("127.0.0.1:0", 0);
  options.to = load.server();
  options.link = c.link;
  auto proxy = netsim::Proxy::open(options);
  if (!proxy) std::printf("%s\n", proxy.error().c_str()), std::exit(1);
  const Measured ours = measure(**proxy, load, length, c.spread, c.delay_max, "proxy");
  const netsim::ProxyStatus end = (*proxy)->final_status();
  row.bare.push_back(reference.cpu_ns);
  row.ours.push_back(ours.cpu_ns);
  row.ratio.push_back(ours.cpu_ns / reference.cpu_ns);
  row.share = std::max(row.share, ours.share);
  row.late.merge((*proxy)->sender().lateness());
  row.bare_missing += reference.counts.sent - reference.counts.up - reference.counts.down;
  if (c.lossless) row.missing += ours.counts.sent - ours.counts.up - ours.counts.down;
  row.drops += end.errors.kernel_drops + end.errors.no_room + end.errors.refused + end.errors.other;
}

}  // namespace

/// Arguments, for profiling: seconds per round, number of rounds, part of a case's name.
int main(int argc, char** argv) {
  const Duration length = from_seconds(argc > 1 ? std::atof(argv[1]) : 1.0);
  const int rounds = argc > 2 ? std::atoi(argv[2]) : 5;
  const char* only = argc > 3 ? argv[3] : "";
  const auto busy = netsim::shipped_profile("wifi-busy");
  std::vector<Case> cases;
  for (const bool spread : {false, true}) {
    const std::string arrivals = spread ? ", spread" : ", together";
    cases.push_back({"no delay" + arrivals, {}, 0ms, spread});
    cases.push_back({"5 ms" + arrivals, netsim::link_from({.delay = 5ms}), 5ms, spread});
    cases.push_back({"5 to 15 ms" + arrivals, netsim::link_from({.delay = 5ms, .jitter = 10ms}), 15ms, spread, true});
    cases.push_back({"wifi-busy" + arrivals, busy->link, 500ms, spread, false});
  }
  std::erase_if(cases, [&](const Case& c) { return c.name.find(only) == std::string::npos; });
  std::vector<Row> rows(cases.size());
  for (int round = 0; round < rounds; ++round) {
    for (std::size_t i = 0; i < cases.size(); ++i) one_round(cases[i], rows[i], length);
  }
  std::printf("%zu clients, 1 kHz each way, %zu bytes, loopback; medians of %d rounds of %.1f s each\n", kClients,
              bench::UdpLoad::kBytes, rounds, seconds(length));
  std::printf("%-22s %9s %9s %6s (%4s..%4s) %5s %9s %9s %8s %6s\n", "network, arrivals", "bare ns", "proxy ns", "ratio",
              "min", "max", "core", "late p50", "late p99", "missing", "drops");
  bool kept = true;
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const Row& row = rows[i];
    const double ratio = median(row.ratio);
    kept = kept && ratio <= kRatioAsked;
    std::printf("%-22s %9.0f %9.0f %6.2f (%4.2f..%4.2f) %5.2f %6.1f us %6.1f us %8llu %6llu%s\n", cases[i].name.c_str(),
                median(row.bare), median(row.ours), ratio, std::ranges::min(row.ratio), std::ranges::max(row.ratio),
                row.share, static_cast<double>(row.late.quantile(0.5)) / 1e3,
                static_cast<double>(row.late.quantile(0.99)) / 1e3,
                static_cast<unsigned long long>(row.missing + row.bare_missing),
                static_cast<unsigned long long>(row.drops), ratio <= kRatioAsked ? "" : " *");
  }
  std::printf(
      "* above what is asked. Where all clients send in one instant and the network spreads them, the bare forwarder "
      "wakes\n"
      "  up once per millisecond, and who keeps each one's moment cannot.\n");
  std::printf("asked: at most %.1f: %s\n", kRatioAsked, kept ? "kept" : "NOT KEPT");
  return 0;  // a measurement, not a test: shared machines are noisy
}
