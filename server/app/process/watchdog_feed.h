#pragma once

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <functional>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

#include "common/base/time.h"
#include "server/app/process/tick_watchdog.h"

namespace tandem::server {

/// Feeds the system's watchdog while all shards tick in time, on a thread of its own: the main loop may wait seconds
/// for a disk while all hands are served. A main loop that has not come round for kMainLoopMax is stuck, and the
/// watchdog is fed no more.
class WatchdogFeed {
 public:
  using Punctual = std::function<std::vector<std::optional<std::uint64_t>>()>;
  static constexpr std::chrono::milliseconds kInterval{250};
  static constexpr Duration kMainLoopMax = std::chrono::minutes(1);

  /// @param punctual  input of TickWatchdog; called by the thread  @param feed  tells the system; called by the thread
  /// @param clock     called by the thread and by `main_loop_ran`
  WatchdogFeed(Punctual punctual, std::function<void()> feed, std::function<Time()> clock)
      : punctual_(std::move(punctual)),
        feed_(std::move(feed)),
        clock_(std::move(clock)),
        main_loop_(clock_()),
        thread_([this](const std::stop_token& stop) { run(stop); }) {}

  /// Call it whenever the main loop comes round.
  void main_loop_ran() {
    const std::lock_guard lock(mutex_);
    main_loop_ = clock_();
  }

 private:
  void run(const std::stop_token& stop) {
    std::unique_lock lock(mutex_);
    while (!stop.stop_requested()) {
      if (ticks_.update(punctual_()) && clock_() - main_loop_ < kMainLoopMax) feed_();
      ended_.wait_for(lock, stop, kInterval, [] { return false; });
    }
  }

  Punctual punctual_;
  std::function<void()> feed_;
  std::function<Time()> clock_;
  TickWatchdog ticks_;
  std::mutex mutex_;
  std::condition_variable_any ended_;
  Time main_loop_;
  std::jthread thread_;  ///< last: it uses the others
};

}  // namespace tandem::server
