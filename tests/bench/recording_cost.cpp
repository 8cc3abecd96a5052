// The cost of a recording: processor time of its threads and bytes on the disk for eight hands on three tools at 1 kHz,
// each hand on its own motion through a simulated session. Before it, the cost of keeping the inputs of that session
// for a recording that begins later, and of adding them to it.
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
#include "server/app/recording/kept_inputs.h"
#include "server/recording/input_packer.h"
#include "server/recording/io/input_spool.h"
#include "server/recording/io/recording_files.h"
#include "server/recording/kept_block.h"
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

/// The session in memory, tick by tick.
struct Recorded {
  std::vector<server::TickRecord> records;
  std::vector<std::vector<std::byte>> inputs;  ///< of each record
};

double percent(Duration spent, std::size_t ticks) { return 100 * seconds(spent) / (static_cast<double>(ticks) / 1000); }

/// Keeps the inputs, block after block, and reads them again.
void print_keeper(const Recorded& session) {
  const std::size_t ticks = session.records.size();
  server::InputPacker packer{SceneSpec{}};
  server::KeptBlockWriter writer;
  auto spool = server::InputSpool::create(std::filesystem::temp_directory_path().string());
  if (!spool) return std::puts("[ INVALID ] no spool"), void();
  std::string block, entry;
  std::size_t raw = 0, blocks = 0;
  const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
  for (const auto& inputs : session.inputs) {
    static_cast<void>(packer.add(inputs));
    raw += inputs.size() - server::InputJournal::kPieceHeader;
    if (packer.size() < server::KeptInputs::kBlockBytes) continue;
    packer.take(block, false);
    writer.write(block, entry);
    if (!spool->append(entry).empty()) return std::puts("[ INVALID ] the disk failed"), void();
    ++blocks;
  }
  const Duration spent = io::read_clock(CLOCK_THREAD_CPUTIME_ID) - before;
  std::printf(
      "inputs kept for a recording that begins later: %.2f %% of a core; %.2f MB per minute and seat of %.2f in the "
      "journal; %zu blocks, 1024 MiB last for %.0f min\n",
      percent(spent, ticks), static_cast<double>(spool->size()) * 2e-3 * 30 / kSeats / static_cast<double>(ticks),
      static_cast<double>(raw) * 2e-3 * 30 / kSeats / static_cast<double>(ticks), blocks,
      1024.0 * (1 << 20) / static_cast<double>(spool->size()) * static_cast<double>(ticks) / 60'000);
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
  Recorded recorded;
  auto& [records, inputs] = recorded;
  std::vector<std::byte> piece(1 << 16);
  while (records.size() < kTicks && (*simulation)->step()) {
    if (!(*simulation)->session().record().running) continue;
    records.push_back((*simulation)->session().record());
    const std::size_t size = journal.drain(piece);
    inputs.emplace_back(piece.begin(), piece.begin() + static_cast<std::ptrdiff_t>(size));
  }
  if (records.empty() || journal.dropped() > 0) return 1;
  print_keeper(recorded);
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
