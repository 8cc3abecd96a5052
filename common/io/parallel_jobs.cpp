#include "common/io/parallel_jobs.h"

#include <fcntl.h>
#include <poll.h>
#include <sched.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <expected>
#include <limits>
#include <system_error>

#include "common/io/fd.h"

namespace tandem::io {
namespace {

constexpr int kWatchMs = 250;
constexpr std::size_t kLastWords = 2000;  // kept of the job's standard error [bytes]
constexpr int kThrew = 70;                // exit code of a job that threw; the pipe carries the message

/// One float per job, visible to parent and children.
class SharedShares {
 public:
  explicit SharedShares(std::size_t count) : bytes_(std::max<std::size_t>(1, count) * sizeof(float)) {
    void* const memory = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) throw std::system_error(errno, std::generic_category(), "shared memory for progress");
    slots_ = static_cast<float*>(memory);
  }
  ~SharedShares() { munmap(slots_, bytes_); }
  SharedShares(const SharedShares&) = delete;
  SharedShares& operator=(const SharedShares&) = delete;
  [[nodiscard]] float* slot(std::size_t i) const noexcept { return slots_ + i; }
  [[nodiscard]] double of(std::size_t i) const noexcept {
    return static_cast<double>(std::atomic_ref(slots_[i]).load(std::memory_order_relaxed));
  }

 private:
  std::size_t bytes_;
  float* slots_ = nullptr;
};

struct Piece {
  std::size_t index = 0;
  pid_t pid = 0;
  Fd result, words;
  std::string text, last_words;
};

void write_all(int fd, std::string_view text) noexcept {
  while (!text.empty()) {
    const auto n = ::write(fd, text.data(), text.size());
    if (n < 0 && errno == EINTR) continue;
    if (n <= 0) return;
    text.remove_prefix(static_cast<std::size_t>(n));
  }
}

[[noreturn]] void be_child(const std::function<std::string(std::size_t, JobProgressReporter)>& work, std::size_t index,
                           JobProgressReporter share, int result, int words, pid_t parent) noexcept {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // never outlive the parent
  if (getppid() != parent) _exit(1);
  dup2(words, STDERR_FILENO);
  int code = 0;
  std::string text;
  try {
    text = work(index, share);
  } catch (const std::exception& e) {
    text = e.what();
    code = kThrew;
  } catch (...) {
    text = "an unknown exception";
    code = kThrew;
  }
  write_all(result, text);
  _exit(code);
}

/// @return the running job, or why it could not be started
std::expected<Piece, std::string> begin(const std::function<std::string(std::size_t, JobProgressReporter)>& work,
                                        std::size_t index, JobProgressReporter share) {
  std::array<int, 2> result{-1, -1}, words{-1, -1};
  if (pipe2(result.data(), O_CLOEXEC) != 0) return std::unexpected(std::generic_category().message(errno));
  Fd result_in{result[0]}, result_out{result[1]};
  if (pipe2(words.data(), O_CLOEXEC) != 0) return std::unexpected(std::generic_category().message(errno));
  Fd words_in{words[0]}, words_out{words[1]};
  std::fflush(nullptr);  // else the child would own a copy of the buffered output
  const pid_t parent = getpid();
  const pid_t pid = fork();
  if (pid < 0) return std::unexpected(std::generic_category().message(errno));
  if (pid == 0) be_child(work, index, share, result_out.get(), words_out.get(), parent);
  Piece piece;
  piece.index = index;
  piece.pid = pid;
  piece.result = std::move(result_in);
  piece.words = std::move(words_in);
  return piece;
}

/// Reads available data. Closes the file at its end.
void read_some(Fd& fd, std::string& into) {
  std::array<char, 65536> buffer;
  const auto n = ::read(fd.get(), buffer.data(), buffer.size());
  if (n > 0) {
    into.append(buffer.data(), static_cast<std::size_t>(n));
  } else if (n == 0 || errno != EINTR) {
    fd.reset();
  }
}

std::string trimmed(std::string text) {
  while (!text.empty() && (text.back() == '\n' || text.back() == ' ')) text.pop_back();
  return text;
}

JobResult result_of(Piece& piece) {
  int status = 0;
  while (waitpid(piece.pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) {
    if (!piece.last_words.empty()) write_all(STDERR_FILENO, piece.last_words);  // output of a successful job: for users
    return {JobResult::State::kDone, std::move(piece.text), {}};
  }
  std::string reason;
  if (WIFSIGNALED(status)) {
    reason = "ended by signal " + std::to_string(WTERMSIG(status)) + " (" + sigdescr_np(WTERMSIG(status)) + ")";
  } else if (WEXITSTATUS(status) == kThrew) {
    reason = "threw: " + piece.text;
  } else {
    reason = "ended with code " + std::to_string(WEXITSTATUS(status));
  }
  if (const std::string words = trimmed(piece.last_words); !words.empty()) reason += ": " + words;
  return {JobResult::State::kCrashed, {}, reason};
}

}  // namespace

void JobProgressReporter::set(double share) const noexcept {
  std::atomic_ref(*slot_).store(static_cast<float>(std::clamp(share, 0.0, 1.0)), std::memory_order_relaxed);
}

std::size_t cores() {
  cpu_set_t set;
  if (sched_getaffinity(0, sizeof set, &set) != 0) return 1;
  return static_cast<std::size_t>(std::max(1, CPU_COUNT(&set)));
}

std::vector<JobResult> run_jobs(std::size_t count,
                                const std::function<std::string(std::size_t, JobProgressReporter)>& work,
                                const JobOptions& options) {
  using Clock = std::chrono::steady_clock;
  std::vector<JobResult> results(count);
  const SharedShares shares(count);
  std::vector<Piece> running;
  const std::size_t jobs = options.jobs == 0 ? cores() : options.jobs;
  const auto begun = Clock::now();
  std::size_t next = 0, wanted = count, done = 0;
  bool stopped = false;

  const auto finish = [&](std::size_t index, JobResult result) {
    ++done;
    *shares.slot(index) = 1;
    if (options.keep_going && !options.keep_going(index, result)) wanted = std::min(wanted, index + 1);
    results[index] = std::move(result);
  };
  const auto tell = [&] {
    if (!options.watch) return;
    double sum = 0;
    for (std::size_t i = 0; i < next; ++i) sum += shares.of(i);
    const double share = count == 0 ? 1 : sum / static_cast<double>(count);
    const double elapsed = std::chrono::duration<double>(Clock::now() - begun).count();
    const double left = share > 0 ? elapsed * (1 - share) / share : std::numeric_limits<double>::quiet_NaN();
    options.watch({count, done, running.size(), share, elapsed, left});
  };
  const auto end = [](Piece& piece) {
    ::kill(piece.pid, SIGKILL);
    int status = 0;
    while (waitpid(piece.pid, &status, 0) < 0 && errno == EINTR) {
    }
  };

  auto told = begun;
  while (!stopped && (next < wanted || !running.empty())) {
    while (next < wanted && running.size() < jobs) {
      auto piece = begin(work, next, JobProgressReporter{shares.slot(next)});
      if (piece) {
        running.push_back(std::move(*piece));
      } else if (running.empty()) {
        finish(next, {JobResult::State::kCrashed, {}, "could not be started: " + piece.error()});
      } else {
        break;  // the system lacks resources: run fewer at a time
      }
      ++next;
    }
    std::vector<pollfd> files;
    for (const Piece& piece : running) {
      files.push_back({piece.result.get(), POLLIN, 0});  // poll ignores negative numbers
      files.push_back({piece.words.get(), POLLIN, 0});
    }
    files.push_back({options.stop_fd, POLLIN, 0});
    if (poll(files.data(), files.size(), kWatchMs) < 0 && errno != EINTR)
      throw std::system_error(errno, std::generic_category(), "poll");
    stopped = options.stop_fd >= 0 && files.back().revents != 0;
    for (std::size_t i = 0; i < running.size(); ++i) {
      Piece& piece = running[i];
      if (files[2 * i].revents != 0) read_some(piece.result, piece.text);
      if (files[2 * i + 1].revents != 0) read_some(piece.words, piece.last_words);
      if (piece.last_words.size() > kLastWords) piece.last_words.erase(0, piece.last_words.size() - kLastWords);
    }
    for (std::size_t i = 0; i < running.size();) {
      Piece& piece = running[i];
      const bool over = !piece.result.open() && !piece.words.open();
      if (over) finish(piece.index, result_of(piece));
      const bool unwanted = !over && piece.index >= wanted;
      if (unwanted) end(piece);
      if (over || unwanted) {
        running.erase(running.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        ++i;
      }
    }
    if (const auto now = Clock::now(); now - told >= std::chrono::milliseconds(kWatchMs)) {
      told = now;
      tell();
    }
  }
  for (Piece& piece : running) end(piece);
  running.clear();
  for (std::size_t i = wanted; i < count; ++i) results[i] = {};
  tell();
  return results;
}

}  // namespace tandem::io
