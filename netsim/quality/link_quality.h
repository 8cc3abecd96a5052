#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/quality/age_of_information.h"
#include "netsim/quality/link_summary.h"
#include "netsim/quality/sliding_windows.h"

namespace tandem::netsim {

/// Record of the indices seen among the last 65 536. Real-time safe.
class SeenNumbers {
 public:
  /// Relation of an index to those seen before.
  enum class Kind : std::uint8_t { kNewest, kReordered, kAgain };
  SeenNumbers() : words_(kNumbers / 64) {}
  /// Records a number and returns its kind. Numbers older than the record count as reordered.
  Kind insert(std::uint64_t number) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }

 private:
  static constexpr std::uint64_t kNumbers = 65'536;
  std::vector<std::uint64_t> words_;
  std::uint64_t newest_ = 0;
  bool any_ = false;
};

/// Quality of one direction of a link for haptic teleoperation: bands over sliding windows, gaps, age of information,
/// delay, loss and order. The caller reports every datagram and passes the time. The constructor allocates 0.5 MB;
/// later calls allocate nothing.
///
/// Loss counts at its time of sending; delay and gap count at the arrival. A gap counts in every window that it
/// overlaps, also while it lasts. Pauses of the sender longer than kPause, and its final silence, are not gaps. Events
/// may be reported up to 200 ms out of order; later reports count at 200 ms before the newest event. The same holds for
/// a loss that becomes known later.
class LinkQuality {
 public:
  static constexpr Duration kPause = std::chrono::milliseconds(100);

  /// @param from  datagrams sent before this time are ignored, as are those sent before the first reported one
  explicit LinkQuality(Time from = Time{});

  /// Reports a sent datagram.
  /// @param index  ascending within one direction
  void sent(Time at, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// Reports that a sent datagram will not arrive.
  void lost(Time sent, std::uint64_t index) noexcept TANDEM_REALTIME;
  /// Reports the arrival of a datagram or of a copy.
  void arrived(Time sent, Time at, std::uint64_t index) noexcept TANDEM_REALTIME;

  /// Returns the summary of all events so far, including windows that end by the last event. Works on a copy: not for
  /// the packet path.
  [[nodiscard]] DirectionSummary summary() const;

 private:
  struct Step {
    std::uint32_t sent = 0, lost = 0;
    bool talked = false, heard = false, resumed = false;
    Time last_sent, last_heard, resume;
    Duration gap{};  ///< longest gap that ended in this step
  };
  /// End of a pause of the sender.
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
  DirectionSummary counts_;  ///< counters updated at each event
  bool talked_ = false, heard_ = false;
  Time last_sent_, last_arrival_, newest_sent_, age_from_;
  Duration delay_min_{};
  std::array<Resume, kResumesKept> resumes_{};
  std::uint64_t resume_count_ = 0;
  SeenNumbers seen_;
  AgeOfInformation age_;
  SlidingDelays delays_;
  StepClock clock_;
  std::vector<Step> steps_;
  std::array<Window, kWindows> windows_;
  // State at the last closed step, which lags behind the reported events.
  bool silence_known_ = false;
  Time silence_from_, talked_until_;
  Time due_;  ///< earliest arrival of the first datagram after a pause
};

}  // namespace tandem::netsim
