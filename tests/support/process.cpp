#include "tests/support/process.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <utility>

extern char** environ;

namespace tandem::test {

using namespace std::chrono_literals;

namespace {

// Programs under a sanitizer take several times as long. 1: there is none.
#if defined(__SANITIZE_THREAD__) || defined(__SANITIZE_ADDRESS__)
constexpr int kTimesSlower = 4;
#else
constexpr int kTimesSlower = 1;
#endif

}  // namespace

Process::Process(std::vector<std::string> command) {
  std::vector<char*> argv;
  for (std::string& word : command) argv.push_back(word.data());
  argv.push_back(nullptr);
  std::array<int, 2> out{}, err{};
  if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) {
    ADD_FAILURE() << "no pipes";
    return;
  }
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, STDIN_FILENO, "/dev/null", O_RDONLY, 0);
  posix_spawn_file_actions_adddup2(&actions, out[1], STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&actions, err[1], STDERR_FILENO);
  EXPECT_EQ(posix_spawn(&pid_, argv[0], &actions, nullptr, argv.data(), environ), 0) << command.front();
  posix_spawn_file_actions_destroy(&actions);
  ::close(out[1]);
  ::close(err[1]);
  out_fd_ = io::Fd{out[0]};
  err_fd_ = io::Fd{err[0]};
}

Process::Process(Process&& other) noexcept
    : pid_(std::exchange(other.pid_, 0)),
      code_(other.code_),
      out_fd_(std::move(other.out_fd_)),
      err_fd_(std::move(other.err_fd_)),
      out_(std::move(other.out_)),
      err_(std::move(other.err_)),
      reported_(other.reported_) {}

Process& Process::operator=(Process&& other) noexcept {
  std::swap(pid_, other.pid_);
  std::swap(code_, other.code_);
  std::swap(out_fd_, other.out_fd_);
  std::swap(err_fd_, other.err_fd_);
  std::swap(out_, other.out_);
  std::swap(err_, other.err_);
  std::swap(reported_, other.reported_);
  return *this;
}

Process::~Process() {
  if (pid_ <= 0) return;
  ::kill(pid_, SIGKILL);
  waitpid(pid_, nullptr, 0);
  if (kTimesSlower == 1) return;
  // A child of the process may hold the pipes open.
  for (int i = 0; i < 100 && read_some(10ms); ++i) {
  }
  expect_no_report();
}

void Process::expect_no_report() {
  if (kTimesSlower == 1 || reported_) return;
  for (const char* mark : {"ThreadSanitizer: ", "AddressSanitizer: ", "LeakSanitizer: ", ": runtime error: "}) {
    if (err_.find(mark) == std::string::npos) continue;
    ADD_FAILURE() << "a program printed a report of a sanitizer:\n" << err_;
    reported_ = true;
    return;
  }
}

bool Process::read_some(std::chrono::milliseconds slice) {
  std::array<pollfd, 2> files{{{out_fd_.get(), POLLIN, 0}, {err_fd_.get(), POLLIN, 0}}};
  if (!out_fd_.open() && !err_fd_.open()) return false;
  poll(files.data(), files.size(), static_cast<int>(slice.count()));
  const auto take = [](io::Fd& fd, short events, std::string& text) {
    if (!fd.open() || events == 0) return;
    std::array<char, 4096> buffer;
    const auto count = ::read(fd.get(), buffer.data(), buffer.size());
    if (count > 0) {
      text.append(buffer.data(), static_cast<std::size_t>(count));
    } else {
      fd.reset();
    }
  };
  take(out_fd_, files[0].revents, out_);
  take(err_fd_, files[1].revents, err_);
  return true;
}

bool Process::wait_for(std::string_view text) {
  const auto found = [&] { return out_.find(text) != std::string::npos || err_.find(text) != std::string::npos; };
  const auto limit = std::chrono::steady_clock::now() + kTimesSlower * kTimeout;
  while (!found()) {
    if (std::chrono::steady_clock::now() > limit || !read_some(50ms)) return found();
  }
  return true;
}

std::optional<int> Process::wait() {
  const auto limit = std::chrono::steady_clock::now() + kTimesSlower * kTimeout;
  while (read_some(50ms)) {
    if (std::chrono::steady_clock::now() > limit) return std::nullopt;
  }
  if (code_ || pid_ <= 0) return code_;
  int status = 0;
  waitpid(pid_, &status, 0);
  pid_ = 0;
  code_ = WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
  expect_no_report();
  return code_;
}

void Process::signal(int number) const {
  if (pid_ > 0) ::kill(pid_, number);
}

std::string Process::after(std::string_view mark) const {
  const auto at = out_.find(mark);
  if (at == std::string::npos) return {};
  const auto begin = at + mark.size();
  return out_.substr(begin, out_.find('\n', begin) - begin);
}

}  // namespace tandem::test
