#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/delay_counts.h"
#include "netsim/quality_bands.h"
#include "netsim/quality_summary.h"

/// The last 100 ms, 1 s and 10 s, moved on in steps of kWindowStep. Step k is the time [k, k + 1) * kWindowStep.
namespace tandem::netsim {

[[nodiscard]] constexpr std::int64_t step_of(Time at) noexcept {
  const std::int64_t ns = at.time_since_epoch().count(), width = kWindowStep.count();
  return ns >= 0 ? ns / width : (ns - width + 1) / width;
}
[[nodiscard]] constexpr Time end_of_step(std::int64_t step) noexcept { return Time{kWindowStep * (step + 1)}; }

/// Steps are closed so many steps late: two ends of a link need not be asked in the order of their clocks.
inline constexpr std::int64_t kStepsOpen = 20;
/// Steps that are remembered: the longest window, those open, and one that leaves.
inline constexpr std::size_t kStepsKept = 1024;
static_assert(kStepsKept > kWindowSteps.back() + kStepsOpen + 1);

/// Which steps are open. Time only moves on; what comes late belongs to the oldest step still open.
class StepClock {
 public:
  /// Calls `close(step)` for every step that ends for good when the time is `now`; ascending. After a long silence only
  /// as many steps as are remembered.
  template <typename Close>
  void advance(Time now, Close&& close) noexcept {
    const std::int64_t step = step_of(now);
    if (!started_) {
      started_ = true;
      first_ = oldest_ = step;
    }
    close_until(step - kStepsOpen, close);
  }
  /// Closes everything up to and with the step of `last`.
  template <typename Close>
  void finish(Time last, Close&& close) noexcept {
    if (started_) close_until(step_of(last) + 1, close);
  }
  /// The step in which something of time `at` is counted.
  [[nodiscard]] std::int64_t place(Time at) const noexcept { return std::max(step_of(at), oldest_); }
  /// Whether the window of so many steps that ends with `step` is full.
  [[nodiscard]] bool full(std::int64_t step, std::size_t steps) const noexcept {
    return step - first_ + 1 >= static_cast<std::int64_t>(steps);
  }

 private:
  template <typename Close>
  void close_until(std::int64_t end, Close&& close) noexcept {
    const auto all = static_cast<std::int64_t>(kStepsKept) + kStepsOpen;
    if (end - oldest_ > 2 * all) {  // nothing happened in between: those steps are empty, and so are their windows
      for (const std::int64_t stop = oldest_ + all; oldest_ < stop; ++oldest_) close(oldest_);
      oldest_ = end - all;
    }
    for (; oldest_ < end; ++oldest_) close(oldest_);
  }

  bool started_ = false;
  std::int64_t first_ = 0, oldest_ = 0;
};

/// Greatest value of the last so many steps.
class SlidingMax {
 public:
  explicit SlidingMax(std::size_t steps) : steps_(static_cast<std::int64_t>(steps)), ring_(steps + 1) {}
  /// @param step  ascends from call to call
  Duration add(std::int64_t step, Duration value) noexcept TANDEM_REALTIME;

 private:
  struct Entry {
    std::int64_t step = 0;
    Duration value{};
  };
  std::int64_t steps_;
  std::vector<Entry> ring_;  ///< values fall from the oldest to the newest
  std::size_t begin_ = 0, size_ = 0;
};

/// Quantiles of delays over each window, and over everything.
class SlidingDelays {
 public:
  /// Delays a window can hold; of more only the newest count.
  static constexpr std::size_t kSamples = 32'768;

  SlidingDelays();
  /// @param step  open, and never less than in the call before
  void add(std::int64_t step, Duration delay) noexcept TANDEM_REALTIME;
  /// The windows now end with this step; ascending by 1, or by more when all steps since are empty.
  void close(std::int64_t step) noexcept TANDEM_REALTIME;

  [[nodiscard]] const DelayCounts<std::uint32_t>& window(std::size_t w) const noexcept { return windows_[w].counts; }
  [[nodiscard]] DelaySummary summary() const noexcept;

 private:
  struct Window {
    std::uint64_t tail = 0;  ///< the first sample in it
    DelayCounts<std::uint32_t> counts;
  };
  struct Step {
    std::uint64_t samples = 0;  ///< of this step
    std::uint64_t end = 0;      ///< samples up to its end, once closed
  };
  void drop_until(Window& window, std::uint64_t position) noexcept;

  std::vector<std::uint16_t> samples_;  ///< bins, by position modulo kSamples
  std::uint64_t pushed_ = 0;            ///< position after the newest
  std::uint64_t entered_ = 0;           ///< position after the newest that is in the windows
  std::vector<Step> steps_;             ///< by step modulo kStepsKept
  std::array<Window, kWindows> windows_;
  DelayCounts<std::uint64_t> all_;
  double sum_s_ = 0;
  Duration max_{};
};

/// Puts a window's value of one measure into the summary. @return its band
Band note(MeasureSummary& summary, Band band, double value, Time end) noexcept TANDEM_REALTIME;

}  // namespace tandem::netsim
