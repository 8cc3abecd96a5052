#include "netsim/app/tradeoff_cost.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>

#include "common/control/channel_replica.h"
#include "common/control/tool_copy.h"
#include "common/io/exit_code.h"

namespace tandem::netsim {
namespace {

using control::ChannelParams;
using control::Numerics;
using control::ReplicaReference;
using control::ToolCopy;
using control::VirtualTool;

constexpr double kTick = 1e-3;
constexpr int kSteps = 100, kWarm = 50;  ///< counted steps of each choice, and steps before them
/// The same of models, of which there are many; they are counted while the hand moves.
constexpr int kModelSteps = 20;
constexpr double kModelFrom = 0.4;  ///< [s]

/// A tool, and a seat with a copy of it, that press on the surface.
struct Bodies {
  Bodies(const tradeoff::ToolTask& task, const Numerics& numerics)
      : tool(task.tool, task.axes, task.contacts, numerics),
        copy({.tool = task.tool,
              .axes = task.axes,
              .contacts = task.contacts,
              .k_c = task.k_c,
              .b_rel = task.b_rel,
              .numerics = numerics,
              .assist = {}}),
        end(channel(task)) {
    for (std::size_t a = 0; a < task.axes; ++a) {
      hand[a] = tradeoff::hand_at(task, 0.4).x[a];
      pulls[a].spring(task.k_c, hand[a]);
      pulls[a].damper(task.b_rel, 0);
    }
    tool.rest_at(hand);
    copy.rest_at(hand, hand);
    end.engage(hand, 0);
    in.authority = 0.5;
    in.rx.x = hand;
  }
  static ChannelParams channel(const tradeoff::ToolTask& task) {
    ChannelParams p;
    p.dof = task.axes;
    p.effort_max = 3.3;
    return p;
  }
  VirtualTool tool;
  ToolCopy copy;
  ReplicaReference end;
  VirtualTool::Pulls pulls{};
  AxisArray hand{};
  control::EndInput in;
};

}  // namespace

// Functions that callgrind finds by their names.
extern "C" {
[[gnu::noipa]] void tandem_tradeoff_next() {}
[[gnu::noipa]] void tandem_tradeoff_tool(Bodies* b) { b->tool.step(kTick, b->pulls); }
[[gnu::noipa]] void tandem_tradeoff_seat(Bodies* b) {
  for (std::size_t a = 0; a < b->copy.tool().axes(); ++a) {
    b->in.x[a] = b->copy.tool().x(a);
    b->in.dissipated[a] = b->copy.dissipated(a);
  }
  b->end.move(b->in);
  b->copy.delivered(b->copy.step(b->hand, b->in.authority, b->end));
}
[[gnu::noipa]] void tandem_tradeoff_model(tradeoff::ModelRun* run) { run->advance(); }
}

namespace {

using Step = void (*)(Bodies*);
constexpr std::array<Step, 2> kCounted{tandem_tradeoff_tool, tandem_tradeoff_seat};

/// Shortest mean time of a step over several loops [ns]. @param per_loop  steps, each after `prepare`, which is timed
/// alone and subtracted
template <class Step, class Prepare>
double time_of(int per_loop, Step&& step, Prepare&& prepare) {
  constexpr int kLoops = 15;
  const auto least_of = [&](auto&& body) {
    double least = std::numeric_limits<double>::infinity();
    for (int loop = 0; loop < kLoops; ++loop) {
      const auto begin = std::chrono::steady_clock::now();
      for (int i = 0; i < per_loop; ++i) body();
      const std::chrono::duration<double, std::nano> took = std::chrono::steady_clock::now() - begin;
      least = std::min(least, took.count() / per_loop);
    }
    return least;
  };
  const double both = least_of([&] {
    prepare();
    step();
  });
  return std::max(0.0, both - least_of(prepare));
}

double time_of(Bodies& bodies, Step step) {
  return time_of(200, [&] { step(&bodies); }, [] {});
}

/// A run in the middle of its motion: in contact if there is a surface.
tradeoff::ModelRun moving(const tradeoff::ModelChoice& choice) {
  tradeoff::ModelRun run(choice, kModelFrom);
  for (int i = 0; i < kModelSteps; ++i) {
    run.prepare();
    run.advance();  // the code of the counted function, but without its name
  }
  return run;
}

double time_of(const tradeoff::ModelChoice& choice) {
  tradeoff::ModelRun run = moving(choice);
  return time_of(kModelSteps, [&] { tandem_tradeoff_model(&run); }, [&] { run.prepare(); });
}

std::vector<Numerics> all_choices(const std::vector<std::uint8_t>& substeps) {
  std::vector<Numerics> out;
  for (std::size_t i = 0; i < control::kIntegrators; ++i)
    for (std::size_t p = 0; p < control::kPrecisionNames.size(); ++p)
      for (const std::uint8_t n : substeps)
        out.push_back({static_cast<control::Integrator>(i), static_cast<control::Precision>(p), n});
  return out;
}

/// Runs a program without input and output until it ends or `stop_fd` is readable.
/// @return its exit status; nothing if it could not run or was stopped
std::optional<int> run_quietly(std::vector<std::string> words, int stop_fd) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&files, STDERR_FILENO, "/dev/null", O_WRONLY, 0);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &files, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (error != 0) return std::nullopt;
  int status = 0;
  bool stopped = false;
  while (waitpid(child, &status, WNOHANG) == 0) {
    pollfd stop{.fd = stop_fd, .events = POLLIN, .revents = 0};
    if (poll(&stop, 1, 20) <= 0) continue;
    stopped = true;
    kill(child, SIGKILL);
    waitpid(child, &status, 0);
    break;
  }
  if (stopped || !WIFEXITED(status)) return std::nullopt;
  return WEXITSTATUS(status);
}

/// Instructions of one dump of callgrind, from its line "totals: N" or "summary: N".
std::optional<double> instructions_in(const std::filesystem::path& file) {
  std::ifstream in(file);
  for (std::string line; std::getline(in, line);)
    for (const std::string word : {"totals: ", "summary: "})
      if (line.starts_with(word)) return std::atof(line.c_str() + word.size());
  return std::nullopt;
}

/// A folder of its own for the dumps; removed at the end.
class ScratchFolder {
 public:
  ScratchFolder() {
    std::error_code error;
    std::string name = (std::filesystem::temp_directory_path(error) / "tandem-tradeoff-XXXXXX").string();
    if (!error && mkdtemp(name.data()) != nullptr) path_ = name;
  }
  ~ScratchFolder() {
    std::error_code error;
    if (!path_.empty()) std::filesystem::remove_all(path_, error);
  }
  ScratchFolder(const ScratchFolder&) = delete;
  ScratchFolder& operator=(const ScratchFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const noexcept { return path_; }

 private:
  std::filesystem::path path_;
};

}  // namespace

int run_cost_worker(const CostSubjects& subjects) {
  for (const Numerics& numerics : subjects.tool ? all_choices(subjects.substeps) : std::vector<Numerics>{}) {
    Bodies bodies(*subjects.tool, numerics);
    for (int i = 0; i < kWarm; ++i) {  // by the code of the counted functions, but without their names
      bodies.tool.step(kTick, bodies.pulls);
      bodies.end.move(bodies.in);
      bodies.copy.delivered(bodies.copy.step(bodies.hand, bodies.in.authority, bodies.end));
    }
    for (const Step step : kCounted) {
      for (int i = 0; i < kSteps; ++i) step(&bodies);
      tandem_tradeoff_next();  // callgrind writes the counts and begins again at zero
    }
  }
  for (const tradeoff::ModelChoice& choice : subjects.models) {
    tradeoff::ModelRun run = moving(choice);
    for (int i = 0; i < kModelSteps; ++i) {
      run.prepare();
      tandem_tradeoff_model(&run);
    }
    tandem_tradeoff_next();
  }
  return io::kExitDone;
}

CostTable::CostTable(CostSubjects subjects, bool times)
    : subjects_(std::move(subjects)),
      choices_(subjects_.tool ? all_choices(subjects_.substeps) : std::vector<Numerics>{}),
      costs_(choices_.size()),
      model_costs_(subjects_.models.size()) {
  if (!times) return;
  for (std::size_t i = 0; i < choices_.size(); ++i) {
    Bodies bodies(*subjects_.tool, choices_[i]);
    costs_[i].tool_ns = time_of(bodies, tandem_tradeoff_tool);
    costs_[i].seat_ns = time_of(bodies, tandem_tradeoff_seat);
  }
  for (std::size_t i = 0; i < model_costs_.size(); ++i) model_costs_[i].ns = time_of(subjects_.models[i]);
}

std::string CostTable::count_instructions(const std::vector<std::string>& arguments, int stop_fd) {
  std::error_code error;
  const std::filesystem::path self = std::filesystem::read_symlink("/proc/self/exe", error);
  const ScratchFolder folder;
  if (error || folder.path().empty()) return "no scratch folder";
  const std::filesystem::path out = folder.path() / "dump";
  std::vector<std::string> words{"valgrind",
                                 "--tool=callgrind",
                                 "--callgrind-out-file=" + out.string(),
                                 "--dump-before=tandem_tradeoff_next",
                                 "--toggle-collect=tandem_tradeoff_tool",
                                 "--toggle-collect=tandem_tradeoff_seat",
                                 "--toggle-collect=tandem_tradeoff_model",
                                 self.string(),
                                 "tradeoff",
                                 "--under-callgrind"};
  words.insert(words.end(), arguments.begin(), arguments.end());
  const std::optional<int> status = run_quietly(std::move(words), stop_fd);
  if (!status) return "stopped, or valgrind is not installed";
  if (*status == 127) return "valgrind is not installed";
  if (*status != 0) return "callgrind failed";
  std::size_t dump = 0;
  bool found = true;
  const auto next = [&](int steps) {
    const auto counted = instructions_in(out.string() + "." + std::to_string(++dump));
    found = found && counted && *counted > 0;
    return counted ? std::optional(*counted / steps) : std::nullopt;
  };
  for (tradeoff::Cost& cost : costs_) {
    cost.tool_instructions = next(kSteps);
    cost.seat_instructions = next(kSteps);
  }
  for (tradeoff::ModelCost& cost : model_costs_) cost.instructions = next(kModelSteps);
  if (found) {
    counted_ = true;
    return {};
  }
  for (tradeoff::Cost& cost : costs_) cost.tool_instructions = cost.seat_instructions = std::nullopt;
  for (tradeoff::ModelCost& cost : model_costs_) cost.instructions = std::nullopt;
  return "callgrind does not find this program's functions; is it stripped?";
}

tradeoff::Cost CostTable::of(const Numerics& numerics) const {
  const auto it = std::ranges::find_if(choices_, [&](const Numerics& one) {
    return one.integrator == numerics.integrator && one.precision == numerics.precision &&
           one.substeps == numerics.substeps;
  });
  return it == choices_.end() ? tradeoff::Cost{} : costs_[static_cast<std::size_t>(it - choices_.begin())];
}

}  // namespace tandem::netsim
