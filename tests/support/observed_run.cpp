// observed_run FILE COMMAND [ARGUMENT]...: runs a command, and meanwhile wakes up a thousand times per second. Writes
// to FILE whether the computer let it: "kept", or "paused" with figures. ./test runs tests of real time with it, so
// that a pause of the computer is not taken for a fault of Tandem, nor a fault for a pause.
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <ctime>

#include "common/base/time.h"
#include "common/io/clock.h"

namespace {

using tandem::Duration;

constexpr Duration kPeriod{1'000'000};
/// Half of the silence after which a gate ends its force, and a wake-up that a tick of 1 kHz misses.
constexpr Duration kPause{10'000'000}, kLate{2'000'000};
constexpr double kLateShare = 0.02;

/// How late this process woke up.
struct Wakeups {
  void add(Duration late_by) {
    ++count;
    if (late_by > kLate) ++late;
    longest = std::max(longest, late_by);
  }
  [[nodiscard]] double late_share() const {
    return static_cast<double>(late) / static_cast<double>(std::max(count, 1L));
  }
  [[nodiscard]] bool paused() const { return longest >= kPause || late_share() > kLateShare; }

  long count = 0, late = 0;
  Duration longest{};
};

Wakeups observe_until_end(pid_t child, int& status) {
  Wakeups wakeups;
  Duration due = tandem::io::read_clock(CLOCK_MONOTONIC);
  while (::waitpid(child, &status, WNOHANG) == 0) {
    due += kPeriod;
    const timespec until = tandem::io::to_timespec(due);
    while (::clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &until, nullptr) == EINTR) {
    }
    const Duration now = tandem::io::read_clock(CLOCK_MONOTONIC);
    wakeups.add(now - due);
    due = std::max(due, now - kPeriod);  // a pause is counted once
  }
  return wakeups;
}

}  // namespace

int main(int count, char** words) {
  if (count < 3) {
    std::fprintf(stderr, "Usage: observed_run FILE COMMAND [ARGUMENT]...\n");
    return 2;
  }
  pid_t child = 0;
  if (const int error = ::posix_spawnp(&child, words[2], nullptr, nullptr, words + 2, environ); error != 0) {
    std::fprintf(stderr, "observed_run: %s: %s\n", words[2], std::strerror(error));
    return 127;
  }
  // Ctrl-C ends the command, which gets it too; this process reports and ends after it.
  ::signal(SIGINT, SIG_IGN);
  ::signal(SIGTERM, SIG_IGN);
  int status = 0;
  const Wakeups wakeups = observe_until_end(child, status);
  std::FILE* const report = std::fopen(words[1], "w");
  if (report == nullptr) {
    std::fprintf(stderr, "observed_run: %s: %s\n", words[1], std::strerror(errno));
    return 126;
  }
  if (wakeups.paused())
    std::fprintf(report, "paused for up to %.0f ms, %.1f %% of wake-ups late\n", 1e3 * tandem::seconds(wakeups.longest),
                 100 * wakeups.late_share());
  else
    std::fprintf(report, "kept\n");
  std::fclose(report);
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}
