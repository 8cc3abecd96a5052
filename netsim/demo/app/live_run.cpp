#include "netsim/demo/app/live_run.h"

#include <chrono>
#include <csignal>
#include <sstream>
#include <thread>
#include <utility>

#include "netsim/demo/app/child_process.h"
#include "netsim/demo/app/network_series.h"
#include "netsim/demo/app/progress.h"
#include "netsim/demo/app/repeat_commands.h"
#include "netsim/profiles/decision_csv.h"

namespace tandem::netsim::demo {
namespace {

using namespace std::chrono_literals;

constexpr auto kRunPoll = 25ms;
constexpr double kStartPatience = 10;  // [s] until a program prints its address
constexpr double kEndPatience = 30;    // [s] beyond the session's length
constexpr std::size_t kLogLines = 12;

std::string last_lines(const std::string& text, std::size_t count) {
  std::size_t at = text.size();
  for (std::size_t n = 0; at > 0 && n <= count; --at) n += text[at - 1] == '\n' ? 1 : 0;
  std::string out;
  std::istringstream lines(text.substr(at > 0 ? at + 1 : 0));
  for (std::string line; std::getline(lines, line);) {
    if (const auto redrawn = line.rfind('\r'); redrawn != std::string::npos) line.erase(0, redrawn + 1);
    if (!line.empty()) out += "    " + line + "\n";
  }
  return out;
}

/// All processes of one run, which end together.
class LiveRunProcesses {
 public:
  LiveRunProcesses(const RunPlan& plan, const DemoPaths& places, const RunObserver& observer)
      : plan_(plan), places_(places), observer_(observer) {}

  std::expected<RawRun, std::string> play();

 private:
  std::string program(const char* name) const { return (places_.programs / name).string(); }
  std::string file(const std::string& ending) const {
    return (places_.output / (std::string(plan_.name) + ending)).string();
  }
  bool start(const std::string& name, const std::vector<std::string>& arguments);
  bool wait_for_address(std::size_t child, std::string& address);
  bool wait_for_end();
  bool set_error(ChildProcess& child, const std::string& what);
  static std::expected<std::string, std::string> contents(const std::string& path);

  const RunPlan& plan_;
  const DemoPaths& places_;
  const RunObserver& observer_;
  std::vector<ChildProcess> children_;  // server, netsim, trainer, trainee
  std::string trouble_;
};

bool LiveRunProcesses::start(const std::string& name, const std::vector<std::string>& arguments) {
  auto child = ChildProcess::start(name, arguments, file("-" + name + ".log"));
  if (!child) {
    trouble_ = child.error();
    return false;
  }
  children_.push_back(std::move(*child));
  return true;
}

bool LiveRunProcesses::set_error(ChildProcess& child, const std::string& what) {
  trouble_ = child.name() + " " + what + ". The end of its log (" + child.log() + "):\n" +
             last_lines(child.output(), kLogLines);
  return false;
}

bool LiveRunProcesses::wait_for_address(std::size_t index, std::string& address) {
  const double begin = monotonic_seconds();
  ChildProcess& child = children_[index];
  while (true) {
    address = listening_address(child.output());
    if (!address.empty()) return true;
    if (observer_.stop->load()) return trouble_ = kInterrupted, false;
    if (!child.running())
      return set_error(
          child, "ended with exit code " + std::to_string(child.exit_code().value_or(-1)) + " before it listened");
    if (monotonic_seconds() - begin > kStartPatience) return set_error(child, "did not print its address within 10 s");
    std::this_thread::sleep_for(kRunPoll);
  }
}

/// Waits until the server has ended the session. A client or network simulator that ends earlier is the cause of a
/// failure.
bool LiveRunProcesses::wait_for_end() {
  const double begin = monotonic_seconds();
  ChildProcess& server = children_.front();
  while (server.running()) {
    const double elapsed = monotonic_seconds() - begin;
    if (observer_.stop->load()) return trouble_ = kInterrupted, false;
    for (std::size_t k = 1; k < children_.size(); ++k) {
      ChildProcess& child = children_[k];
      if (child.running() || (child.exit_code() == 0 && elapsed > plan_.duration_s)) continue;
      // Clients end a moment before the server does; that is no failure.
      std::this_thread::sleep_for(1s);
      if (!server.running() && child.exit_code() == 0) return true;
      return set_error(
          child, "ended with exit code " + std::to_string(child.exit_code().value_or(-1)) + " while the session ran");
    }
    if (elapsed > plan_.duration_s + kEndPatience) return set_error(server, "did not end the session in time");
    observer_.progress(elapsed);
    std::this_thread::sleep_for(kRunPoll);
  }
  return true;
}

std::expected<std::string, std::string> LiveRunProcesses::contents(const std::string& path) {
  auto text = read_text(path);
  if (!text) return std::unexpected(path + " cannot be read");
  return std::move(*text);
}

std::expected<RawRun, std::string> LiveRunProcesses::play() {
  const std::string json = file(".json"), trace = file(".csv");
  std::error_code ignored;
  for (const char* ending :
       {".json", ".csv", "-trainer.csv", "-trainee.csv", "-trainer.json", "-trainee.json", "-network.csv"})
    std::filesystem::remove(file(ending), ignored);

  std::string server, network;
  bool fine = start("server", {program("tandem-server"), "run", std::string(plan_.scene), "--listen", observer_.listen,
                               "--json", json, "--trace", trace, "--start-timeout", "20"}) &&
              wait_for_address(0, server);
  if (fine && observer_.listening) observer_.listening(server);
  std::vector<std::string> proxy{program("tandem-netsim"), "proxy", "--listen", "127.0.0.1:0", "--to", server};
  const std::vector<std::string> impairment = impairment_options(plan_.setting);
  proxy.insert(proxy.end(), impairment.begin(), impairment.end());
  if (plan_.setting == Setting::kBadNetwork) proxy.insert(proxy.end(), {"--log", file("-network.csv")});
  // A limit for the proxy, in case the demo itself is killed.
  proxy.insert(proxy.end(), {"--duration", "120"});
  fine = fine && start("netsim", proxy) && wait_for_address(1, network);
  for (const char* seat : {"trainer", "trainee"})
    fine = fine && start(seat, {program("tandem-client"), "join", "--server", network, "--seat", seat, "--device",
                                "sim", "--trace", file(std::string("-") + seat + ".csv"), "--json",
                                file(std::string("-") + seat + ".json")});
  fine = fine && wait_for_end();
  if (fine) {
    // The clients have received the end of the session. They need the network until they exit.
    for (int n = 0; n < 80 && (children_[2].running() || children_[3].running()); ++n)
      std::this_thread::sleep_for(kRunPoll);
  }
  end_all(children_);
  if (!fine) return std::unexpected(trouble_);

  const auto report = contents(json), rows = contents(trace);
  if (!report || report->empty() || !rows) {
    set_error(children_.front(), "ended with exit code " + std::to_string(children_.front().exit_code().value_or(-1)) +
                                     " without a report");
    return std::unexpected(trouble_);
  }
  RawRun run{*report, *rows, {}, {}, {}, {}, {}};
  for (const auto& [ending, into] :
       {std::pair{"-trainer.csv", &run.trainer}, std::pair{"-trainee.csv", &run.trainee},
        std::pair{"-trainer.json", &run.trainer_json}, std::pair{"-trainee.json", &run.trainee_json}}) {
    auto text = contents(file(ending));
    if (!text) return std::unexpected(text.error());
    *into = std::move(*text);
  }
  if (plan_.setting == Setting::kBadNetwork) {
    const auto text = contents(file("-network.csv"));
    if (!text) return std::unexpected(text.error());
    const auto decisions = parse_decision_csv(*text, file("-network.csv"));
    if (!decisions) return std::unexpected(to_text(decisions.error()));
    run.network = network_series(*decisions, begin_of_session(*decisions, plan_.duration_s), plan_.duration_s);
  }
  return run;
}

}  // namespace

std::string listening_address(const std::string& output) {
  constexpr std::string_view kWords = "listening on ";
  std::size_t at = output.find(kWords);
  while (at != std::string::npos && at != 0 && output[at - 1] != '\n') at = output.find(kWords, at + 1);
  if (at == std::string::npos) return {};
  const std::size_t begin = at + kWords.size(), end = output.find('\n', begin);
  if (end == std::string::npos) return {};
  const std::string rest = output.substr(begin, end - begin);
  return rest.substr(0, rest.find_first_of(" ,;\r"));
}

std::string missing_programs(const DemoPaths& places) {
  std::string missing;
  for (const char* name : {"tandem-server", "tandem-client", "tandem-netsim"}) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(places.programs / name, ignored))
      missing += (missing.empty() ? "" : ", ") + (places.programs / name).string();
  }
  return missing;
}

std::expected<RawRun, std::string> live_run(const RunPlan& plan, const DemoPaths& places, const RunObserver& observer) {
  return LiveRunProcesses(plan, places, observer).play();
}

}  // namespace tandem::netsim::demo
