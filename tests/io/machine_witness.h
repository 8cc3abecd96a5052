#pragma once

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cstdio>
#include <functional>
#include <thread>

namespace tandem::test {

/// A thread that wakes up every millisecond and records how late it was. If the whole machine stands still, gates trip
/// because of that, and a test of something else judges nothing.
class MachineWitness {
  using Clock = std::chrono::steady_clock;

 public:
  /// Whether the thread was once late by more than this. Gates tolerate at least 20 ms.
  static constexpr std::chrono::milliseconds kStandstill{15};
  [[nodiscard]] bool machine_stood_still() const { return longest_.load() > Clock::duration(kStandstill).count(); }

 private:
  void watch(const std::stop_token& end) {
    for (auto before = Clock::now(); !end.stop_requested();) {
      std::this_thread::sleep_for(std::chrono::milliseconds(1));
      const auto now = Clock::now();
      if (const auto gap = (now - before).count(); gap > longest_.load()) longest_ = gap;
      before = now;
    }
  }

  std::atomic<Clock::rep> longest_{0};
  std::jthread thread_{[this](const std::stop_token& end) { watch(end); }};
};

/// Number of sessions until a test gives up a machine that stands still.
inline constexpr int kSessionsOfADisturbedMachine = 3;

/// Repeats a session that could not be judged because the machine stood still, and says so if no repetition could.
/// @param session  returns whether it was judged
inline void repeat_disturbed(const char* what, const std::function<bool()>& session) {
  for (int n = 0; n < kSessionsOfADisturbedMachine; ++n)
    if (session() || testing::Test::HasFailure()) return;
  std::printf("[ NOT RUN ] %s: this machine stood still in each of %d sessions\n", what, kSessionsOfADisturbedMachine);
}

}  // namespace tandem::test
