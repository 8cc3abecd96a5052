#pragma once

#include <atomic>
#include <cstdint>

#include "common/base/histogram.h"
#include "server/app/monitor/session_status.h"
#include "server/app/process/tick_histogram.h"
#include "server/policy/load_shedder.h"

namespace tandem::server {

/// Load of a shard's thread: lateness and length of its ticks, its share of a processor, and the shed level that
/// follows. The thread records each tick; any thread reads.
class ShardLoad {
 public:
  explicit ShardLoad(Duration period) noexcept : period_(period), shedder_(period) {}

  // ---- The shard's thread ----
  /// @param granted  the kernel granted real-time priority
  void set_realtime(bool granted) noexcept {
    machine_.started = true;
    machine_.realtime = granted;
  }
  /// A tick begins.
  /// @param late     time since it was due
  /// @param serving  the shard serves a session: late ticks count
  /// @return number of whole periods in `late`
  std::uint32_t begin_tick(Time now, Duration late, bool serving) noexcept;
  /// The tick has ended. @param before, after processor time of the thread at its begin and end
  void end_tick(Time now, Duration before, Duration after) noexcept;
  /// Timing and load for the sessions of this tick.
  [[nodiscard]] const MachineStatus& machine() const noexcept { return machine_; }

  // ---- Any thread ----
  /// Processor time of a tick / period, the 99th percentile of the last 1000 ticks [1]. Other processes do not count;
  /// they show as late ticks.
  [[nodiscard]] double tick_share() const noexcept { return tick_share_.load(std::memory_order_relaxed); }
  /// Processor time of the thread over the last second, as share of one processor [1].
  [[nodiscard]] double cpu_share() const noexcept { return cpu_share_.load(std::memory_order_relaxed); }
  /// Current shed level.
  [[nodiscard]] LoadState state() const noexcept {
    return {shed_level_.load(std::memory_order_relaxed), overloaded_.load(std::memory_order_relaxed)};
  }
  /// Histograms of the lateness and the length of ticks.
  [[nodiscard]] const TickHistogram& lateness() const noexcept { return lateness_; }
  [[nodiscard]] const TickHistogram& lengths() const noexcept { return lengths_; }
  /// Ticks so far that began more than 1 ms late.
  [[nodiscard]] std::uint64_t late_ticks() const noexcept { return late_ticks_.load(std::memory_order_relaxed); }
  /// Times at which ticks of a serving shard became so late that all hands were released.
  [[nodiscard]] std::uint64_t overloads() const noexcept { return overloads_.load(std::memory_order_relaxed); }
  /// Time at which the last tick began.
  [[nodiscard]] Time last_tick() const noexcept { return Time{Duration{last_tick_.load(std::memory_order_relaxed)}}; }

 private:
  Duration period_;
  LoadShedder shedder_;
  MachineStatus machine_;
  Duration used_{};    ///< processor time of the last tick
  Duration worked_{};  ///< of the thread from the end of the tick before until the end of the last one
  Duration worked_until_{};
  Histogram spent_;
  Time core_since_{};
  Duration core_used_{};
  TickHistogram lateness_, lengths_;
  std::atomic<std::uint64_t> late_ticks_{0}, overloads_{0};
  std::atomic<std::int64_t> last_tick_{0};
  std::atomic<double> tick_share_{0}, cpu_share_{0};
  std::atomic<ShedLevel> shed_level_{ShedLevel::kNone};
  std::atomic<bool> overloaded_{false};
};

}  // namespace tandem::server
