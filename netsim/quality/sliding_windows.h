#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/quality/bands.h"
#include "netsim/quality/delay_histogram.h"
#include "netsim/quality/link_summary.h"

/// Sliding windows of 100 ms, 1 s and 10 s, advanced in steps of kWindowStep. Step k is the time interval [k, k + 1) *
/// kWindowStep.
namespace tandem::netsim {

/// Returns the number of the step that contains `at`; negative before Time{}.
[[nodiscard]] constexpr std::int64_t step_of(Time at) noexcept {
  const std::int64_t ns = at.time_since_epoch().count(), width = kWindowStep.count();
  return ns >= 0 ? ns / width : (ns - width + 1) / width;
}
/// Returns the exclusive end of a step.
[[nodiscard]] constexpr Time end_of_step(std::int64_t step) noexcept { return Time{kWindowStep * (step + 1)}; }

/// Number of steps by which closing lags behind, because the two ends of a link need not report in time order.
inline constexpr std::int64_t kStepsOpen = 20;
/// Number of steps in memory: the longest window, the open steps, and one that leaves.
inline constexpr std::size_t kStepsKept = 1024;
static_assert(kStepsKept > kWindowSteps.back() + kStepsOpen + 1);

/// Range of open steps. Time only advances; late events count in the oldest open step.
class StepClock {
 public:
  /// Calls `close(step)` for every step that becomes final at `now`, in ascending order. After a long silence, only the
  /// steps in memory are closed.
  template <typename Close>
  void advance(Time now, Close&& close) noexcept {
    const std::int64_t step = step_of(now);
    if (!started_) {
      started_ = true;
      first_ = oldest_ = step;
    }
    close_until(step - kStepsOpen, close);
  }
  /// Closes all steps up to and including that of `last`.
  template <typename Close>
  void finish(Time last, Close&& close) noexcept {
    if (started_) close_until(step_of(last) + 1, close);
  }
  /// Returns the step in which an event at `at` counts.
  [[nodiscard]] std::int64_t place(Time at) const noexcept { return std::max(step_of(at), oldest_); }
  /// Returns whether the window of `steps` steps that ends with `step` is full.
  [[nodiscard]] bool full(std::int64_t step, std::size_t steps) const noexcept {
    return step - first_ + 1 >= static_cast<std::int64_t>(steps);
  }

 private:
  template <typename Close>
  void close_until(std::int64_t end, Close&& close) noexcept {
    const auto all = static_cast<std::int64_t>(kStepsKept) + kStepsOpen;
    if (end - oldest_ > 2 * all) {  // a long silence: skipped steps and their windows are empty
      for (const std::int64_t stop = oldest_ + all; oldest_ < stop; ++oldest_) close(oldest_);
      oldest_ = end - all;
    }
    for (; oldest_ < end; ++oldest_) close(oldest_);
  }

  bool started_ = false;
  std::int64_t first_ = 0, oldest_ = 0;
};

/// Maximum over a fixed number of recent steps.
class SlidingMax {
 public:
  explicit SlidingMax(std::size_t steps) : steps_(static_cast<std::int64_t>(steps)), ring_(steps + 1) {}
  /// Adds the value of a step and returns the maximum.
  /// @param step  ascending from call to call
  Duration add(std::int64_t step, Duration value) noexcept TANDEM_REALTIME;

 private:
  struct Entry {
    std::int64_t step = 0;
    Duration value{};
  };
  std::int64_t steps_;
  std::vector<Entry> ring_;  ///< values decrease from the oldest to the newest
  std::size_t begin_ = 0, size_ = 0;
};

/// Quantiles of delays over each window, and over the whole time.
class SlidingDelays {
 public:
  /// Maximum number of delays in a window; only the newest are kept.
  static constexpr std::size_t kSamples = 32'768;

  SlidingDelays();
  /// @param step  an open step, non-decreasing over calls
  void add(std::int64_t step, Duration delay) noexcept TANDEM_REALTIME;
  /// Moves the end of all windows to this step. Steps ascend by 1; gaps are allowed if the skipped steps are empty.
  void close(std::int64_t step) noexcept TANDEM_REALTIME;

  [[nodiscard]] const DelayHistogram<std::uint32_t>& window(std::size_t w) const noexcept { return windows_[w].counts; }
  [[nodiscard]] DelaySummary summary() const noexcept;

 private:
  struct Window {
    std::uint64_t tail = 0;  ///< position of the first sample in the window
    DelayHistogram<std::uint32_t> counts;
  };
  struct Step {
    std::uint64_t samples = 0;  ///< number of samples in this step
    std::uint64_t end = 0;      ///< number of samples up to the end of the step, set when it closes
  };
  void drop_until(Window& window, std::uint64_t position) noexcept;

  std::vector<std::uint16_t> samples_;  ///< bin numbers, indexed by position modulo kSamples
  std::uint64_t pushed_ = 0;            ///< position after the newest sample
  std::uint64_t entered_ = 0;           ///< position after the newest sample in the windows
  std::vector<Step> steps_;             ///< indexed by step modulo kStepsKept
  std::array<Window, kWindows> windows_;
  DelayHistogram<std::uint64_t> all_;
  double sum_s_ = 0;
  Duration max_{};
};

/// Adds a window's value of one measure to the summary.
/// @return `band`
Band note(MeasureSummary& summary, Band band, double value, Time end) noexcept TANDEM_REALTIME;

}  // namespace tandem::netsim
