// The cost of a recording: processor time of its threads and bytes on the disk for eight hands on three tools at 1 kHz,
// each hand on its own motion through a simulated session.
#include <chrono>
#include <cstdio>
#include <ctime>
#include <filesystem>
#include <memory>
#include <string>
#include <thread>
#include <vector>

#include "common/io/clock.h"
#include "netsim/system/simulation.h"
#include "proto/text/scene_bytes.h"
#include "proto/text/scene_text.h"
#include "server/recording/io/recording_files.h"
#include "server/session/input_journal.h"
#include "tests/support/simulation_run.h"

namespace tandem::bench {
namespace {

constexpr int kSeats = 8, kTools = 3;
constexpr std::size_t kTicks = 30'000;

SceneSpec scene() {
  std::string text = "version: 1 tick_hz: 1000 dof: 3 duration_s: 60 gate { loop_age_max_ms: 2500 latch: false }\n";
  for (int i = 0; i < kSeats; ++i) {
    const std::string name = "hand" + std::to_string(i);
    text += "seat { name: \"" + name + "\" kind: MASTER role: " + (i == 0 ? "INSTRUCTOR" : "TRAINEE") +
            " required: true device { model: TOUCH friction_n: 0.1 } hand { model: LEADER trajectory { circle { "
            "radius_m: 0.03 frequency_hz: " +
            std::to_string(0.3 + 0.1 * i) + " normal: Y } } } }\n";
    text += "follow { seat: \"" + name + "\" tool: \"tool" + std::to_string(i % kTools) + "\" weight: 1 }\n";
  }
  for (int j = 0; j < kTools; ++j) {
    const std::string tool = "tool" + std::to_string(j);
    text += "tool { name: \"" + tool + "\" slave { environment { wall { axis: Z at_m: 0.02 k_n_m: 2000 } } } }\n";
    text += "authority { tool: \"" + tool + "\" seat: \"hand" + std::to_string(j) + "\" alpha: 1 }\n";
  }
  auto parsed = parse_scene(text, "recording_cost.textproto");
  if (!parsed) {
    std::fprintf(stderr, "%s\n", to_text(parsed.error()).c_str());
    std::exit(1);
  }
  return std::move(*parsed);
}

int measure() {
  const SceneSpec setup = scene();
  server::InputJournal journal{transport::HashKey{}};
  netsim::SimulationConfig config;
  config.scene = setup;
  config.network = netsim::link_from(test::delayed(1, 0.3));
  config.journal = &journal;
  const auto simulation = netsim::Simulation::make(config);
  if (!simulation) return 1;
  std::vector<server::TickRecord> records;
  std::vector<std::vector<std::byte>> inputs;  // of each record
  std::vector<std::byte> piece(1 << 16);
  while (records.size() < kTicks && (*simulation)->step()) {
    if (!(*simulation)->session().record().running) continue;
    records.push_back((*simulation)->session().record());
    const std::size_t size = journal.drain(piece);
    inputs.emplace_back(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(size));
  }
  if (records.empty() || journal.dropped() > 0) return 1;
  std::string folder = (std::filesystem::temp_directory_path() / "tandem-bench-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr) return 1;
  server::RecordingInfo info;
  info.session = "bench";
  info.scene_text = scene_file_text(setup);
  info.round_tools = true;
  Time now{std::chrono::hours(1)};
  auto files = server::RecordingFiles::open(folder + "/a.mcap", setup, info, {}, now);
  if (!files) return 1;
  (*files)->begin(0);
  const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
  for (std::size_t k = 0; k < records.size(); ++k) {
    (*files)->add(records[k]);
    (*files)->add_inputs(inputs[k]);
    if (k % 250 != 249) continue;
    now += std::chrono::milliseconds(250);
    (*files)->step(now);
    while (!(*files)->trouble().empty()) (*files)->step(now += std::chrono::milliseconds(1));
  }
  (*files)->begin_close();
  const Duration encoding = io::read_clock(CLOCK_THREAD_CPUTIME_ID) - before;
  while (!(*files)->closed()) std::this_thread::yield();
  const Duration disk = (*files)->disk_cpu();
  const double session_s = static_cast<double>(records.size()) / 1000;
  const double mb_min = static_cast<double>((*files)->bytes()) / 1e6 / kSeats / (session_s / 60);
  std::printf(
      "recording of %d seats and %d tools at 1 kHz, %.0f s: processor time %.1f %% of a core (encoding %.1f, disk "
      "%.1f; "
      "asked: at most 10); %.2f MB per minute and seat with inputs (asked: at most 8); %llu ticks, %llu lost\n",
      kSeats, kTools, session_s, 100 * seconds(encoding + disk) / session_s, 100 * seconds(encoding) / session_s,
      100 * seconds(disk) / session_s, mb_min, static_cast<unsigned long long>((*files)->recorded()),
      static_cast<unsigned long long>((*files)->lost()));
  files->reset();
  std::filesystem::remove_all(folder);
  return 0;
}

}  // namespace
}  // namespace tandem::bench

int main() { return tandem::bench::measure(); }
