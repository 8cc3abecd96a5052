#include "netsim/demo/app/child_process.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>
#include <thread>
#include <utility>

#include "common/base/command_hints.h"

namespace tandem::netsim::demo {
namespace {

using namespace std::chrono_literals;

constexpr auto kChildPoll = 20ms;
/// Signal and time limit of one step. The limit is long, because a session first ramps its forces to zero and ends its
/// connections.
struct Step {
  int signal;
  std::chrono::milliseconds timeout;
};
constexpr Step kSteps[] = {{SIGINT, 4000ms}, {SIGTERM, 2000ms}, {SIGKILL, 2000ms}};

/// Settings of posix_spawn, freed by the destructor.
struct SpawnSettings {
  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
  SpawnSettings() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  SpawnSettings(const SpawnSettings&) = delete;
  SpawnSettings& operator=(const SpawnSettings&) = delete;
  ~SpawnSettings() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
};

}  // namespace

std::expected<ChildProcess, std::string> ChildProcess::start(std::string name,
                                                             const std::vector<std::string>& arguments,
                                                             const std::string& log) {
  SpawnSettings settings;
  posix_spawn_file_actions_addopen(&settings.files, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&settings.files, STDOUT_FILENO, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_APPEND,
                                   0644);
  posix_spawn_file_actions_adddup2(&settings.files, STDOUT_FILENO, STDERR_FILENO);
  sigset_t none;
  sigemptyset(&none);
  sigset_t defaults = none;
  for (const int s : {SIGINT, SIGTERM, SIGPIPE}) sigaddset(&defaults, s);
  posix_spawnattr_setsigmask(&settings.attributes, &none);
  posix_spawnattr_setsigdefault(&settings.attributes, &defaults);
  posix_spawnattr_setpgroup(&settings.attributes, 0);
  posix_spawnattr_setflags(&settings.attributes,
                           static_cast<short>(POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF));
  std::vector<char*> argv;
  for (const std::string& a : arguments) argv.push_back(const_cast<char*>(a.c_str()));
  argv.push_back(nullptr);

  ChildProcess child;
  if (const int error = posix_spawn(&child.pid_, argv[0], &settings.files, &settings.attributes, argv.data(), environ);
      error != 0) {
    child.pid_ = -1;
    return std::unexpected(arguments[0] + " cannot be started: " + std::strerror(error));
  }
  child.name_ = std::move(name);
  child.log_ = log;
  return child;
}

ChildProcess::ChildProcess(ChildProcess&& other) noexcept
    : name_(std::move(other.name_)),
      log_(std::move(other.log_)),
      pid_(std::exchange(other.pid_, -1)),
      exit_code_(other.exit_code_) {}

ChildProcess& ChildProcess::operator=(ChildProcess&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(log_, other.log_);
  std::swap(pid_, other.pid_);
  std::swap(exit_code_, other.exit_code_);
  return *this;
}

ChildProcess::~ChildProcess() { end_all({this, 1}); }

bool ChildProcess::running() noexcept {
  if (pid_ < 0) return false;
  int status = 0;
  const pid_t got = waitpid(pid_, &status, WNOHANG);
  if (got == 0) return true;
  exit_code_ = got == pid_ ? (WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status)) : 1;
  pid_ = -1;  // the process is reaped; its id may belong to another process from now on
  return false;
}

void ChildProcess::signal(int number) noexcept {
  if (running()) ::kill(pid_, number);
}

std::string ChildProcess::output() const { return read_text(log_).value_or(""); }

std::optional<std::string> read_text(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return file ? std::optional(text.str()) : std::nullopt;
}

void end_all(std::span<ChildProcess> children) noexcept {
  const auto any = [&] {
    // Every process is queried, so that every ended one is reaped.
    return std::ranges::count_if(children, [](ChildProcess& c) { return c.running(); }) > 0;
  };
  for (const Step& step : kSteps) {
    if (!any()) return;
    for (ChildProcess& c : children) c.signal(step.signal);
    for (auto waited = 0ms; waited < step.timeout && any(); waited += kChildPoll)
      std::this_thread::sleep_for(kChildPoll);
  }
}

std::string command_text(const std::vector<std::string>& arguments) {
  std::string text;
  for (const std::string& a : arguments) text += (text.empty() ? "" : " ") + shell_quote(a);
  return text;
}

}  // namespace tandem::netsim::demo
