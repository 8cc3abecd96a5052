#include "common/io/child_program.h"

#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <cstdlib>
#include <cstring>
#include <sstream>
#include <utility>

#include "common/io/clock.h"

namespace tandem::io {
namespace {

using namespace std::chrono_literals;

constexpr Duration kGentleEnd = 5s;  // time between SIGTERM and SIGKILL; a server first releases all seats
constexpr Duration kLook = 20ms;
constexpr std::size_t kLastLines = 3;
constexpr off_t kLastBytes = 4096;

/// Runs in the child between fork and exec; only async-signal-safe calls.
[[noreturn]] void become(const std::vector<char*>& arguments, pid_t parent, int out, int err) {
  ::setpgid(0, 0);
  ::prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (::getppid() != parent) ::_exit(127);  // the parent died before prctl
  sigset_t none;
  sigemptyset(&none);
  ::sigprocmask(SIG_SETMASK, &none, nullptr);
  const int in = ::open("/dev/null", O_RDONLY);
  ::dup2(in, STDIN_FILENO);
  ::dup2(out, STDOUT_FILENO);
  ::dup2(err, STDERR_FILENO);
  ::execv(arguments.front(), arguments.data());
  ::_exit(127);
}

}  // namespace

std::expected<ChildProgram, std::string> ChildProgram::start(std::string name,
                                                             const std::vector<std::string>& command) {
  const auto trouble = [&](const char* what) {
    return std::unexpected(name + " cannot be started: " + what + ": " + std::strerror(errno));
  };
  std::array<int, 2> pipe{};
  if (::pipe2(pipe.data(), O_CLOEXEC) != 0) return trouble("pipe");
  ChildProgram child;
  child.out_ = Fd{pipe[0]};
  const Fd out{pipe[1]};
  child.err_ = Fd{::memfd_create("said", MFD_CLOEXEC)};
  if (!child.err_.open()) return trouble("memfd_create");
  std::vector<std::string> words = command;
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const pid_t parent = ::getpid();
  const pid_t pid = ::fork();
  if (pid < 0) return trouble("fork");
  if (pid == 0) become(arguments, parent, out.get(), child.err_.get());
  ::setpgid(pid, pid);  // in parent and child, so that the group exists before either continues
  child.pid_ = pid;
  child.name_ = std::move(name);
  return child;
}

ChildProgram::ChildProgram(ChildProgram&& other) noexcept
    : name_(std::move(other.name_)),
      pid_(std::exchange(other.pid_, 0)),
      status_(other.status_),
      out_(std::move(other.out_)),
      err_(std::move(other.err_)),
      said_(std::move(other.said_)) {}

ChildProgram& ChildProgram::operator=(ChildProgram&& other) noexcept {
  std::swap(name_, other.name_);
  std::swap(pid_, other.pid_);
  std::swap(status_, other.status_);
  std::swap(out_, other.out_);
  std::swap(err_, other.err_);
  std::swap(said_, other.said_);
  return *this;
}

ChildProgram::~ChildProgram() { stop(); }

std::optional<std::string> ChildProgram::wait_for_line(std::string_view mark, Duration limit, int interrupt) {
  const Time until = monotonic_now() + limit;
  while (true) {
    std::istringstream lines(said_);
    for (std::string line; std::getline(lines, line) && !lines.eof();)
      if (line.starts_with(mark)) return line.substr(mark.size());
    const Duration left = until - monotonic_now();
    if (left <= Duration::zero()) return std::nullopt;
    pollfd files[] = {{out_.get(), POLLIN, 0}, {interrupt, POLLIN, 0}};
    if (::poll(files, 2, static_cast<int>(left / 1ms) + 1) < 0 && errno != EINTR) return std::nullopt;
    if (files[1].revents != 0) return std::nullopt;
    if (files[0].revents == 0) continue;
    std::array<char, 4096> bytes;
    const ssize_t got = ::read(out_.get(), bytes.data(), bytes.size());
    if (got <= 0) return std::nullopt;
    said_.append(bytes.data(), static_cast<std::size_t>(got));
  }
}

bool ChildProgram::running() noexcept {
  if (pid_ > 0 && ::waitpid(pid_, &status_, WNOHANG) != 0) pid_ = 0;
  return pid_ > 0;
}

std::string ChildProgram::last_output() const {
  const off_t size = ::lseek(err_.get(), 0, SEEK_END), from = size > kLastBytes ? size - kLastBytes : 0;
  std::string text(static_cast<std::size_t>(size > 0 ? size - from : 0), '\0');
  const ssize_t got = ::pread(err_.get(), text.data(), text.size(), from);
  text.resize(got > 0 ? static_cast<std::size_t>(got) : 0);
  while (text.ends_with('\n')) text.pop_back();
  std::size_t begin = text.size();
  for (std::size_t n = 0; n < kLastLines && begin != std::string::npos && begin > 0; ++n)
    begin = text.rfind('\n', begin - 1);
  return begin == std::string::npos || begin == 0 ? text : text.substr(begin + 1);
}

void ChildProgram::stop() noexcept {
  if (!running()) return;
  ::kill(pid_, SIGTERM);
  const Time until = monotonic_now() + kGentleEnd;
  while (running()) {
    if (monotonic_now() > until) ::kill(pid_, SIGKILL);
    ::poll(nullptr, 0, static_cast<int>(kLook / 1ms));
  }
}

std::string program_path(const std::string& name) {
  std::array<char, PATH_MAX> own{};
  std::vector<std::string> folders;
  if (const ssize_t size = ::readlink("/proc/self/exe", own.data(), own.size() - 1); size > 0) {
    const std::string path(own.data(), static_cast<std::size_t>(size));
    folders.push_back(path.substr(0, path.rfind('/')));
  }
  if (const char* const path = std::getenv("PATH")) {
    std::istringstream list(path);
    for (std::string folder; std::getline(list, folder, ':');) folders.push_back(folder);
  }
  for (const std::string& folder : folders)
    if (const std::string path = folder + "/" + name; !folder.empty() && ::access(path.c_str(), X_OK) == 0) return path;
  return "";
}

}  // namespace tandem::io
