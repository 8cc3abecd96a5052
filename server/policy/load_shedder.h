#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "server/policy/admission_control.h"

namespace tandem::server {

/// Shed level of a tick thread: the work that it omits while overloaded. Each level includes the ones before it. No
/// level is about compression, because nothing is compressed. Masters, trainees, instructors, slaves and required seats
/// get FORCE at every tick on every level.
enum class ShedLevel : std::uint8_t {
  kNone,                ///< nothing is shed
  kTelemetry,           ///< records of every 10th tick only; display snapshots at a quarter of the rate
  kObservers20Hz,       ///< seats without force get 20 instead of 60 FORCE datagrams per second
  kObservers10Hz,       ///< 10 per second: an echo older than 200 ms would count as loss
  kEvaluatorsEvery2nd,  ///< seats that only receive force and are not required get FORCE at every 2nd tick
  /// At every 3rd tick, if six such intervals fit into the seat's silence limit. At every 4th tick, four lost datagrams
  /// would disengage the seat.
  kEvaluatorsEvery3rd,
  kNewJoins,  ///< new joins are rejected (admission_control.h)
};
inline constexpr std::size_t kShedLevels = static_cast<std::size_t>(ShedLevel::kNewJoins) + 1;

/// Text for screens and logs.
[[nodiscard]] constexpr const char* to_text(ShedLevel rung) noexcept {
  constexpr std::array<const char*, kShedLevels> kNames{"none",
                                                        "telemetry",
                                                        "observers (20 Hz)",
                                                        "observers (10 Hz)",
                                                        "evaluators (every 2nd tick)",
                                                        "evaluators (every 3rd tick)",
                                                        "new joins"};
  return static_cast<std::size_t>(rung) < kShedLevels ? kNames[static_cast<std::size_t>(rung)] : "?";
}

/// How the server operates the sessions of a tick thread.
struct LoadState {
  ShedLevel level = ShedLevel::kNone;
  bool overloaded = false;  ///< tick deadlines are missed: all hands are disengaged, and engage again automatically
  friend bool operator==(const LoadState&, const LoadState&) = default;
};

/// Exponential back-off of a recovery time. It doubles if the overload returns within a minute after recovery.
class RecoveryBackoff {
 public:
  constexpr RecoveryBackoff(Duration first, Duration most) noexcept : first_(first), longest_(most), now_(first) {}
  [[nodiscard]] Duration wait() const noexcept { return now_; }
  /// Reports an overload, new or growing.
  void on_overload(Time now) noexcept {
    if (!recovered_) return;
    recovered_ = false;
    now_ = now - last_recovery_ > kMemory ? first_ : now_ * 2 < longest_ ? now_ * 2 : longest_;
  }
  /// Reports that the recovery time has passed without overload.
  void on_recovery(Time now) noexcept {
    last_recovery_ = now;
    recovered_ = true;
  }

 private:
  static constexpr Duration kMemory = std::chrono::minutes(1);
  Duration first_, longest_, now_;
  Time last_recovery_{};
  bool recovered_ = false;  ///< since the last overload
};

/// Selects the shed level from the duration and lateness of ticks. Sans-I/O, no heap, one call per tick.
///
/// Load of a tick = max(processor time / period, lateness / 5 ms). The level rises when more than 10 % of the ticks in
/// a 0.1 s window exceed its threshold: 0.40, 0.44, ... 0.56. It rises to the last level when the thread works,
/// receiving included, for a greater share of the window than the limit of new joins, and only from the level before.
/// Lateness does not count there: it is caused by other processes, and rejecting joins does not reduce it. The level
/// falls after 5 s without a window in which more than 10 % of the ticks exceed the threshold minus 0.10; from the last
/// level, without one whose share exceeds the limit minus 0.02. If the level rises again within a minute, the next fall
/// takes 10, then 20, then 40 s. It changes by one level per window, so that the effect of each level is measured.
///
/// The third tick in a row that begins more than 5 ms late puts the sessions into OVERLOADED. They continue after a
/// second without three such ticks in a row (2, 4 s if it happens again within a minute). The state is not latched, for
/// two reasons. The hands are unharmed, and scenes without an instructor have no seat that could resume. The back-off
/// prevents frequent changes between engaged and disengaged.
class LoadShedder {
 public:
  static constexpr Duration kWindow = std::chrono::milliseconds(100);
  static constexpr Duration kLateMost = std::chrono::milliseconds(5);
  static constexpr unsigned kLateTicks = 3;
  static constexpr double kFirst = 0.40, kStep = 0.04, kHysteresis = 0.10;
  static constexpr double kHysteresisOfJoins = 0.02;  ///< small, so that the limit is nearly the same after a moment

  /// @param period  tick period, positive
  explicit LoadShedder(Duration period) noexcept;

  /// Updates the load state for one tick.
  /// @param late  delay of this tick's start after its deadline
  /// @param used    processor time of the tick before, sending included
  /// @param worked  processor time of the thread since the last call
  /// @return load state for this tick
  LoadState step(Time now, Duration late, Duration used, Duration worked) noexcept TANDEM_REALTIME;
  [[nodiscard]] const LoadState& load_state() const noexcept { return load_state_; }

  /// Load above which this level is entered.  @pre the level is above ShedLevel::kNone.
  [[nodiscard]] static constexpr double threshold(ShedLevel rung) noexcept {
    return rung == ShedLevel::kNewJoins ? LoadLimits{}.busy : kFirst + kStep * (static_cast<int>(rung) - 1);
  }

 private:
  void update_level(Time now) noexcept;
  void update_overload(Time now, Duration late) noexcept;

  Duration period_;
  std::uint32_t window_;  ///< ticks
  LoadState load_state_;
  std::uint32_t ticks_ = 0, above_ = 0, above_release_ = 0;  ///< counted in this window
  Duration worked_{};                                        ///< in this window
  Time window_began_{};
  Time last_busy_window_{};  ///< end of the last window with load above the release threshold
  RecoveryBackoff level_backoff_{std::chrono::seconds(5), std::chrono::seconds(40)};
  unsigned late_ = 0;     ///< consecutive late ticks
  Time last_overload_{};  ///< time of the last three consecutive late ticks
  RecoveryBackoff overload_backoff_{std::chrono::seconds(1), std::chrono::seconds(4)};
};
static_assert(LoadShedder::threshold(ShedLevel::kEvaluatorsEvery3rd) < LoadShedder::threshold(ShedLevel::kNewJoins),
              "optional load is shed before joins are rejected");

}  // namespace tandem::server
