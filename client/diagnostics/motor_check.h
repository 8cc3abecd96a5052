#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "client/diagnostics/device_diagnostics.h"
#include "hal/core/device.h"

namespace tandem::client {

/// Checks the direction of each motor with pairs of short opposite force pulses, measured by the joint's encoder.
/// Pulses have 10, 20 and 30 % of the device's peak force, until both pulses of a pair move the joint by kCounts in
/// their direction. The first pulse that moves a joint by kCounts in the opposite direction ends the whole check at
/// once. Before each pulse the joint must rest. The effort is zero outside of a pulse and after the end. Call `step`
/// once per reading. Sans-I/O; `step` uses no heap.
class MotorCheck {
 public:
  static constexpr std::array<double, 3> kShares{0.1, 0.2, 0.3};     ///< pulse force as a share of the peak at the tip
  static constexpr Duration kPulse = std::chrono::milliseconds(30);  ///< longest pulse
  static constexpr Duration kWatch = std::chrono::milliseconds(20);  ///< observation after a pulse, for late motion
  static constexpr Duration kRest = std::chrono::milliseconds(60);   ///< time without motion before a pulse
  static constexpr Duration kRestLimit =
      std::chrono::seconds(3);  ///< a joint that does not rest within this time is unconfirmed
  static constexpr Duration kSoftStart =
      std::chrono::milliseconds(600);    ///< wait for the driver guard's soft start, which reduces early pulses
  static constexpr int kWeakMax = 5;     ///< repetitions per motor of pulses that the guard reduced
  static constexpr int kCounts = 4;      ///< encoder counts that count as motion
  static constexpr int kRestCounts = 2;  ///< largest range of encoder counts of a joint at rest

  enum class Verdict : std::uint8_t {
    kUntested,  ///< the check ended before this motor was tested
    kRight,
    kReversed,     ///< the joint moved against the commanded direction
    kUnconfirmed,  ///< the joint did not move in both directions, or did not rest, or hardly any force was delivered
  };
  enum class Reason : std::uint8_t { kNone, kDidNotMove, kOneWayOnly, kDidNotRest, kNoForceLeft };
  struct Motor {
    Verdict verdict = Verdict::kUntested;
    Reason reason = Reason::kNone;
    double share = 0;            ///< force of the last pulse as a share of the peak
    std::array<int, 2> moved{};  ///< counts in pulse direction, last pair: towards larger angles, towards smaller
  };

  /// @param joints  number of joints, one motor each
  /// @param peak    peak force at the tip [N]; 0: unknown, and the check ends at once
  MotorCheck(std::size_t joints, double peak, Time begin) noexcept;

  /// Advances the check by one reading. @return joint effort to apply now [N m] or [N]
  [[nodiscard]] AxisArray step(Time now, const hal::State& state) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool finished() const noexcept { return phase_ == Phase::kOver; }
  [[nodiscard]] bool all_right() const noexcept;
  [[nodiscard]] std::size_t motors() const noexcept { return motors_; }
  [[nodiscard]] const Motor& motor(std::size_t i) const noexcept { return motor_[i]; }
  /// Returns one finding per motor as text for the user. @param names  names of the motors in the device file
  [[nodiscard]] std::vector<DeviceDiagnostics::Finding> findings(const std::vector<std::string>& names) const;

 private:
  enum class Phase : std::uint8_t { kWaiting, kResting, kPulsing, kWatching, kOver };

  void rest(Time now) noexcept;
  void end_pulse(Time now) noexcept;
  void judge_pulse(Time now) noexcept;
  void next_motor(Time now, Verdict verdict, Reason why) noexcept;
  [[nodiscard]] int moved_along(const hal::State& state) const noexcept;

  std::size_t motors_;
  double peak_;
  std::array<Motor, kAxesMax> motor_{};

  Phase phase_ = Phase::kWaiting;
  Time since_;        ///< begin of this phase
  Time rest_from_{};  ///< the joint rests since then
  std::size_t now_at_ = 0, level_ = 0;
  int weak_ = 0;                ///< pulses of this motor that the guard reduced
  bool forward_ = true;         ///< this pulse is towards larger angles
  std::array<bool, 2> went_{};  ///< per pulse of this pair: the joint moved in pulse direction
  std::int32_t from_raw_ = 0, rest_low_ = 0, rest_high_ = 0;
  double from_q_ = 0;
  double ordered_ = 0, given_ = 0;  ///< largest effort commanded and delivered in this pulse [N m] or [N]
};

}  // namespace tandem::client
