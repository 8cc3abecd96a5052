#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"
#include "common/base/time.h"
#include "server/admission.h"

namespace tandem::server {

/// What a thread of ticks goes without while it has too much to do, one rung after the other, in the order of the design notes
/// (reliability 2.4): each rung keeps what the ones before it saved. The rung "compression" does not exist: nothing is compressed.
/// Masters, trainees, instructors, slaves and required seats are told at every tick, on every rung.
enum class Rung : std::uint8_t {
  kNothing,         ///< everything is done
  kTelemetry,       ///< records of every 10th tick only, pictures for people a quarter as often
  kObservers,       ///< who feels nothing is told 20 times a second instead of 60
  kObserversMore,   ///< 10 times: an echo that stood still for 200 ms would be a loss
  kEvaluators,      ///< who only feels, and whom nobody waits for, is told at every 2nd tick
  kEvaluatorsMore,  ///< at every 3rd, if six such intervals fit into his gate's silence limit: at every 4th, four lost datagrams would let his hand go
  kNewcomers,       ///< nobody new gets a seat (admission.h)
};
inline constexpr std::size_t kRungs = static_cast<std::size_t>(Rung::kNewcomers) + 1;

/// For people and logs.
[[nodiscard]] constexpr const char* to_text(Rung rung) noexcept {
  constexpr std::array<const char*, kRungs> kNames{"nothing", "telemetry", "observers (20 Hz)", "observers (10 Hz)", "evaluators (every 2nd tick)", "evaluators (every 3rd tick)",
                                                   "newcomers"};
  return static_cast<std::size_t>(rung) < kRungs ? kNames[static_cast<std::size_t>(rung)] : "?";
}

/// How a session is to be served now.
struct Relief {
  Rung rung = Rung::kNothing;
  bool passive = false;  ///< time is not kept: all hands are let go, and come back by themselves
  friend bool operator==(const Relief&, const Relief&) = default;
};

/// A wait that doubles when it turned out too short: what comes back too early goes again within a minute.
class Patience {
 public:
  constexpr Patience(Duration first, Duration most) noexcept : first_(first), most_(most), now_(first) {}
  [[nodiscard]] Duration wait() const noexcept { return now_; }
  /// Trouble is there, or grows.
  void troubled(Time now) noexcept {
    if (!waited_) return;
    waited_ = false;
    now_ = now - eased_ > kMemory ? first_ : now_ * 2 < most_ ? now_ * 2 : most_;
  }
  /// It was waited for long enough.
  void eased(Time now) noexcept {
    eased_ = now;
    waited_ = true;
  }

 private:
  static constexpr Duration kMemory = std::chrono::minutes(1);
  Duration first_, most_, now_;
  Time eased_{};
  bool waited_ = false;  ///< since the last trouble
};

/// Decides what is gone without, by how full and how late the ticks are. Sans-I/O, no heap, one call per tick.
///
/// Strain of a tick = max(processor time / period, lateness / 5 ms). A rung is climbed when more than 10 % of the ticks of a window of
/// 0.1 s strain above its threshold: 0.40, 0.44, ... 0.56, and 0.60 for the last, which is the limit of admission. It is left when for
/// 5 s no window had more than 10 % of its ticks above the threshold minus 0.10; after coming back within a minute for 10, 20, 40 s.
/// One rung per window, so that each shows what it saves. For the last rung lateness does not count: it is others' work on the machine that
/// makes ticks late while they are not full, and they do not go away when people are sent away.
///
/// The third tick in a row that begins more than 5 ms late makes its sessions PASSIVE; they come back when for a second there were no
/// three in a row (again within a minute: 2, 4 s). Not latched: the hands are whole, and scenes without an instructor have
/// nobody who could resume, so a machine that was busy for a moment ends no lesson; the doubled wait keeps hands from being caught and dropped.
class LoadLadder {
 public:
  static constexpr Duration kWindow = std::chrono::milliseconds(100);
  static constexpr Duration kLateMost = std::chrono::milliseconds(5);
  static constexpr unsigned kLateTicks = 3;
  static constexpr double kFirst = 0.40, kStep = 0.04, kHysteresis = 0.10;

  /// @param period  of a tick, positive
  explicit LoadLadder(Duration period) noexcept;

  /// @param late  after its time this tick begins  @param used  processor time that the one before took, sending too
  /// @return for this very tick
  Relief step(Time now, Duration late, Duration used) noexcept TANDEM_REALTIME;
  [[nodiscard]] const Relief& relief() const noexcept { return relief_; }

  /// Strain above which this rung is climbed.  @pre rung > kNothing
  [[nodiscard]] static constexpr double threshold(Rung rung) noexcept { return kFirst + kStep * (static_cast<int>(rung) - 1); }

 private:
  void judge_window(Time now) noexcept;
  void judge_lateness(Time now, Duration late) noexcept;

  Duration period_;
  std::uint32_t window_;  ///< ticks
  Relief relief_;
  std::uint32_t ticks_ = 0, above_ = 0, not_calm_ = 0;  ///< of this window
  Time restless_{};       ///< when the last window ended that was not calm
  Patience rungs_{std::chrono::seconds(5), std::chrono::seconds(40)};
  unsigned late_ = 0;     ///< in a row
  Time too_late_{};       ///< the last time that there were three
  Patience hands_{std::chrono::seconds(1), std::chrono::seconds(4)};
};
static_assert(LoadLadder::threshold(Rung::kNewcomers) > LoadLimits{}.tick - 1e-9 && LoadLadder::threshold(Rung::kNewcomers) < LoadLimits{}.tick + 1e-9);

}  // namespace tandem::server
