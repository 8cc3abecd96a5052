#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <vector>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "netsim/quality/age_of_information.h"
#include "netsim/quality/gap_meter.h"
#include "netsim/quality/link_summary.h"
#include "netsim/quality/pause_tracker.h"
#include "netsim/quality/seen_numbers.h"
#include "netsim/quality/sliding_windows.h"

namespace tandem::netsim {

/// Quality of one direction of a link for haptic teleoperation: bands over sliding windows, gaps, age of information,
/// delay, loss and order. The caller reports every datagram and passes the time. The constructor allocates 0.5 MB;
/// later calls allocate nothing.
///
/// Loss counts at its time of sending; delay and gap count at the arrival. A gap counts in every window that it
/// overlaps, also while it lasts. Pauses of the sender (PauseTracker) and its final silence are not gaps. Events
/// may be reported up to 200 ms out of order; later reports count at 200 ms before the newest event. The same holds for
/// a loss that becomes known later.
class LinkQuality {
 public:
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
  struct Step : GapMeter::Step {
    std::uint32_t sent = 0, lost = 0;
  };

  [[nodiscard]] Step& step_at(Time at) noexcept;
  [[nodiscard]] Time silent_since(Time sent) const noexcept;
  [[nodiscard]] Time newest_arrived() const noexcept { return heard_ ? newest_sent_ : Time::min(); }
  void count_gap(Time from, Time until) noexcept;
  void note_gap(Duration gap, Time from) noexcept;
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
  PauseTracker pauses_;
  SeenNumbers seen_;
  AgeOfInformation age_;
  SlidingDelays delays_;
  StepClock clock_;
  std::vector<Step> steps_;
  std::array<Window, kWindows> windows_;
  GapMeter gaps_;  ///< of closed steps, which lag behind the reported events
};

}  // namespace tandem::netsim
