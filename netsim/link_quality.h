#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/age_meter.h"
#include "netsim/quality_summary.h"
#include "netsim/sliding_windows.h"

namespace tandem::netsim {

/// Which numbers came already, over the last 65 536; real-time safe.
class SeenNumbers {
 public:
  enum class Kind : std::uint8_t { kNewest, kReordered, kAgain };
  SeenNumbers() : words_(kNumbers / 64) {}
  /// Numbers older than all remembered count as reordered.
  Kind see(std::uint64_t number) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }

 private:
  static constexpr std::uint64_t kNumbers = 65'536;
  std::vector<std::uint64_t> words_;
  std::uint64_t newest_ = 0;
  bool any_ = false;
};

/// How good one direction of a link is for haptic teleoperation: bands over sliding windows, gaps, age of information,
/// delay, loss, order. Told of every datagram; takes 0.5 MB when made and nothing later; time comes with the calls.
///
/// Each measure counts where it happened: loss when it was sent, delay and gap when they came. A gap counts in every
/// window that it touches, and while it lasts; the sender's own pauses, longer than kPause, are none, and neither is its
/// silence at the end. Events may be told up to 200 ms out of order; what comes later counts 200 ms before the newest.
/// A loss known later than that counts then.
class LinkQuality {
 public:
  static constexpr Duration kPause = std::chrono::milliseconds(100);

  /// @param from  what was sent before is ignored, and what was sent before the first that is told of
  explicit LinkQuality(Time from = Time{});

  /// A datagram went in. @param index  numbers of one direction ascend
  void sent(Time at, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// One that went in will not come out.
  void lost(Time sent, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// One came out, or a copy of one.
  void arrived(Time sent, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;

  /// All so far; windows that end by the last event are in it. Works on a copy: not for the packet path.
  [[nodiscard]] DirectionSummary summary() const;

 private:
  struct Step {
    std::uint32_t sent = 0, lost = 0;
    bool talked = false, heard = false, resumed = false;
    Time last_sent, last_heard, resume;
    Duration gap{};  ///< the longest that ended in it
  };
  /// The sender talked again after a pause.
  struct Resume {
    Time at, last_before;
  };
  static constexpr std::size_t kResumesKept = 64;

  [[nodiscard]] Step& step_at(Time at) noexcept;
  [[nodiscard]] Time silent_since(Time sent) const noexcept;
  [[nodiscard]] const Resume* first_resume_in(Time after, Time until) const noexcept;
  [[nodiscard]] const Resume* last_resume_in(Time after, Time until) const noexcept;
  void count_gap(Time from, Time until) noexcept;
  void count_age(Time sent, Time at) noexcept;
  void close(std::int64_t step) noexcept;
  void judge(std::size_t window, std::int64_t step, Duration gap) noexcept;
  void finish() noexcept;

  struct Window {
    explicit Window(std::size_t steps) : gap(steps) {}
    std::uint64_t sent = 0, lost = 0;
    SlidingMax gap;
  };

  Time from_;
  DirectionSummary counts_;  ///< what is counted as it comes
  bool talked_ = false, heard_ = false;
  Time last_sent_, last_arrival_, newest_sent_, age_from_;
  Duration delay_min_{};
  std::array<Resume, kResumesKept> resumes_{};
  std::uint64_t resume_count_ = 0;
  SeenNumbers seen_;
  AgeMeter age_;
  SlidingDelays delays_;
  StepClock clock_;
  std::vector<Step> steps_;
  std::array<Window, kWindows> windows_;
  // As of the step closed last, which is behind what was told.
  bool silence_known_ = false;
  Time silence_from_, talked_until_;
  Time due_;  ///< when the first datagram after a pause could have come
};

}  // namespace tandem::netsim
