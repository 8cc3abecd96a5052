// How the server's cost grows: processor time of a tick thread per client-tick, kernel included, from 1 to 300 clients
// in 1 to 150 sessions and from 1 to 16 seats of one session; and memory per session. The rounds of all sizes alternate
// in one process, and only the ratios to the smallest cost are meaningful on a shared machine. Clients and shard tick
// at 500 Hz, so that one processor can play 300 clients.
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <list>
#include <memory>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "server/app/recording/kept_inputs.h"
#include "tests/bench/hosted_shard.h"
#include "tests/bench/scene_rows.h"

namespace tandem::bench {
namespace {

using namespace std::chrono_literals;

constexpr int kRounds = 5;
constexpr double kTickHz = 500;
constexpr double kRatioAsked = 1.15, kMegabytesAsked = 4;

SceneSpec scene_with(int seats) {
  SceneSpec scene = scene_of({"growth", "3 axes, contact", 3, seats, kWall});
  scene.tick_hz = kTickHz;
  return scene;
}

struct Size {
  std::size_t sessions = 0;
  int seats = 0;
  std::vector<double> ns{};      ///< per client-tick, all of the thread; one per round
  std::vector<double> beyond{};  ///< the same without the ticks of a thread whose session has no clients
  bool settled = true;
  [[nodiscard]] std::size_t clients() const { return sessions * static_cast<std::size_t>(seats); }
};

double median(std::vector<double> v) {
  std::ranges::sort(v);
  return v[v.size() / 2];
}

/// Returns the processor time of a tick of a shard whose only session waits for its clients [ns].
double empty_tick() {
  const SceneSpec scene = scene_with(2);
  HostedShard host{scene, 1, false};
  const Duration before = host.run_without_clients(50ms);
  const Duration spent = host.run_without_clients(500ms) - before;
  return static_cast<double>(spent.count()) / (0.5 * kTickHz);
}

void measure(Size& size, double empty) {
  HostedShard host{scene_with(size.seats), size.sessions, false};
  host.run(400ms);
  const HostedShard::Spent spent = host.run(600ms);
  size.settled = size.settled && host.settled();
  size.ns.push_back(spent.ns_per_client_tick());
  size.beyond.push_back(size.ns.back() - empty / static_cast<double>(size.clients()));
}

void print_curve(const char* what, std::vector<Size> sizes) {
  std::vector<double> empty;
  for (int round = 0; round < kRounds; ++round) {
    empty.push_back(empty_tick());
    for (Size& size : sizes) measure(size, empty.back());
  }
  double least = 1e18, least_beyond = 1e18;
  for (const Size& size : sizes) {
    least = std::min(least, median(size.ns));
    least_beyond = std::min(least_beyond, median(size.beyond));
  }
  std::printf(
      "%s, median of %d rounds; asked: at most %.2f of the smallest\n(beyond: without the %.1f us of a tick of a "
      "thread "
      "whose session has no clients)\n%8s %9s %6s %16s %6s %16s %6s\n",
      what, kRounds, kRatioAsked, 1e-3 * median(empty), "clients", "sessions", "seats", "ns/client-tick", "ratio",
      "beyond", "ratio");
  for (const Size& size : sizes)
    std::printf("%8zu %9zu %6d %16.0f %6.2f %16.0f %6.2f%s\n", size.clients(), size.sessions, size.seats,
                median(size.ns), median(size.ns) / least, median(size.beyond), median(size.beyond) / least_beyond,
                size.settled ? "" : "  [ INVALID ] not every hand was engaged");
}

/// Returns the resident memory of this process [bytes].
double resident() {
  std::ifstream file("/proc/self/statm");
  double total = 0, pages = 0;
  file >> total >> pages;
  return pages * static_cast<double>(::sysconf(_SC_PAGESIZE));
}

/// Fills the memory that the inputs of a session may take while none of its recordings runs: the journal's ring, and
/// what waits to be a block.
void fill(server::KeptInputs& inputs, std::size_t seats) {
  server::KeptBlockWriter writer;
  const std::vector<std::byte> plaintext(130, std::byte{5});
  std::size_t seat = 0;
  std::uint64_t counter = 0;
  const auto add = [&](std::size_t bytes) {
    for (std::size_t n = 0; n < bytes; n += plaintext.size()) {
      inputs.journal().datagram(Time{}, seat++ % seats, {}, {.counter = ++counter}, plaintext, nullptr);
      inputs.journal().tick(Time{}, 0, {});
      inputs.journal().end_tick();
    }
  };
  for (int k = 0; k < 100; ++k) {
    add(16384);
    inputs.drain();
    inputs.keep(writer);
  }
  add(server::KeptInputs::kBlockBytes / 2);  // less than a block waits
  inputs.drain();
}

/// Sessions as a server has them that may record them, with their queues of tick records full.
void print_memory() {
  std::printf("resident memory per session, queues full, all seats taken; asked: at most %.0f MB\n%8s %6s %8s\n",
              kMegabytesAsked, "sessions", "seats", "MB");
  // All rows stay until the end, so that none takes memory that an earlier one has freed.
  std::list<SceneSpec> scenes;
  std::vector<std::unique_ptr<server::TickQueue>> queues;
  std::vector<std::unique_ptr<server::LiveSession>> live;
  std::vector<std::shared_ptr<server::KeptInputs>> kept;
  for (const auto& [sessions, seats, inputs] :
       {std::tuple{150, 2, false}, {50, 8, false}, {50, 16, false}, {150, 2, true}, {50, 8, true}, {50, 16, true}}) {
    const SceneSpec& scene = scenes.emplace_back(scene_with(seats));
    const double before = resident();
    for (int s = 0; s < sessions; ++s) {
      const auto n = static_cast<std::size_t>(seats);
      queues.push_back(std::make_unique<server::TickQueue>(server::TickQueue::capacity_for(n, scene.tools.size()), n,
                                                           scene.tools.size()));
      live.push_back(std::make_unique<server::LiveSession>(scene, *server::make_local_slaves(scene, Time{}),
                                                           static_cast<std::uint8_t>(s), *queues.back()));
      for (std::size_t i = 0; i < n; ++i)
        if (!netsim::simulate_join(live.back()->session(), Time{}, i, caps_of(scene, i), RandomKey{7}, i))
          std::printf("[ INVALID ] a seat was refused\n");
      while (queues.back()->push({})) {
      }
      if (!inputs) continue;
      kept.push_back(
          server::KeptInputs::make(std::make_unique<server::InputJournal>(
                                       transport::HashKey{}, server::InputJournal::capacity_for(n, scene.tools.size())),
                                   std::filesystem::temp_directory_path().string(), std::uint64_t{1} << 30U));
      fill(*kept.back(), n);
      if (!kept.back()->problem().empty()) std::printf("[ INVALID ] %s\n", kept.back()->problem().c_str());
    }
    std::printf("%8d %6d %8.2f%s\n", sessions, seats, (resident() - before) / sessions / 1e6,
                inputs ? "  with the inputs kept for a recording" : "");
  }
  std::printf("\n");
}

}  // namespace
}  // namespace tandem::bench

int main(int argc, char** argv) {
  using namespace tandem::bench;
  const std::string only = argc > 1 ? argv[1] : "";
  if (only != "--clients" && only != "--seats") print_memory();  // first, before freed memory can be used again
  if (only != "--seats" && only != "--memory")
    print_curve("clients and sessions of two seats",
                {{1, 1}, {1, 2}, {2, 2}, {5, 2}, {15, 2}, {50, 2}, {100, 2}, {150, 2}});
  if (only != "--clients" && only != "--memory") {
    if (only.empty()) std::printf("\n");
    print_curve("seats of one session", {{1, 1}, {1, 2}, {1, 4}, {1, 8}, {1, 12}, {1, 16}});
  }
  return 0;
}
