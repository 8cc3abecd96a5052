#pragma once

#include <atomic>
#include <cstdint>
#include <optional>

#include "common/base/time.h"

namespace tandem::server {

/// Drain of a server: whether new joins are rejected, and when all hands are to be released. One thread changes it.
class DrainSchedule {
 public:
  /// Rejects new joins from now on.
  void begin() noexcept { active_ = true; }
  /// Rejects new joins from now on; all hands are released at `due`, or at an earlier time that was requested.
  void schedule(Time due) noexcept {
    active_ = true;
    const std::int64_t wanted = due.time_since_epoch().count(), before = due_.load(std::memory_order_relaxed);
    if (before == 0 || wanted < before) due_.store(wanted, std::memory_order_relaxed);
  }
  /// A drain moves sessions to other servers of the service.
  void let_sessions_move() noexcept { sessions_move_ = true; }
  [[nodiscard]] bool sessions_move() const noexcept { return sessions_move_; }
  [[nodiscard]] bool active() const noexcept { return active_; }
  /// Time at which all hands are to be released; nullopt without a request. Thread-safe.
  [[nodiscard]] std::optional<Time> due() const noexcept {
    const std::int64_t due = due_.load(std::memory_order_relaxed);
    return due == 0 ? std::nullopt : std::optional(Time{Duration{due}});
  }

 private:
  bool active_ = false, sessions_move_ = false;
  std::atomic<std::int64_t> due_{0};  ///< [ns] of the monotonic clock; 0: not requested
};

}  // namespace tandem::server
