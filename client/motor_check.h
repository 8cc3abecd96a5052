#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "client/examination.h"
#include "hal/device.h"

namespace tandem::client {

/// Finds out whether each motor pushes the way it is told, by pairs of short opposite pulses while the joint's encoder is watched: at
/// 10, 20 and 30 % of the device's peak force until both pulses of a pair move the joint by kCounts the way they pushed. The first
/// pulse that moves a joint by kCounts the other way ends everything at once. Before each pulse the joint must rest. Pure; no heap
/// while it runs. Call `step` once per reading; the effort is zero outside of a pulse, and after the end.
class MotorCheck {
 public:
  static constexpr std::array<double, 3> kShares{0.1, 0.2, 0.3};  ///< of the peak at the tip
  static constexpr Duration kPulse = std::chrono::milliseconds(30);  ///< at most
  static constexpr Duration kWatch = std::chrono::milliseconds(20);  ///< after a pulse, for what moves late
  static constexpr Duration kRest = std::chrono::milliseconds(60);   ///< without motion, before a pulse
  static constexpr Duration kRestLimit = std::chrono::seconds(3);    ///< a joint that does not rest within it stays unconfirmed
  static constexpr Duration kSoftStart = std::chrono::milliseconds(600);  ///< the guard's, which would make the first pulses smaller
  static constexpr int kWeakMax = 5;      ///< pulses of a motor that may come out too small, and are given again
  static constexpr int kCounts = 4;       ///< of the encoder: a motion
  static constexpr int kRestCounts = 2;   ///< less than a motion

  enum class Verdict : std::uint8_t {
    kUntested,     ///< the check ended before this motor's turn
    kRight,
    kReversed,     ///< it moved against its order
    kUnconfirmed,  ///< it did not move, or did not rest
  };
  enum class Why : std::uint8_t { kNone, kDidNotMove, kOneWayOnly, kDidNotRest, kNoForceLeft };
  struct Motor {
    Verdict verdict = Verdict::kUntested;
    Why why = Why::kNone;
    double share = 0;              ///< of the last pulse
    std::array<int, 2> moved{};    ///< counts along the pulse, of the last pair: towards larger angles, towards smaller
  };

  /// @param joints  of the device, a motor each
  /// @param peak    force at the tip that shares are of [N]; 0: unknown, and there is nothing to do
  MotorCheck(std::size_t joints, double peak, Time begin) noexcept;

  /// @return joint effort for this moment [N m] or [N]
  [[nodiscard]] AxisArray step(Time now, const hal::State& state) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool over() const noexcept { return phase_ == Phase::kOver; }
  [[nodiscard]] bool all_right() const noexcept;
  [[nodiscard]] std::size_t motors() const noexcept { return motors_; }
  [[nodiscard]] const Motor& motor(std::size_t i) const noexcept { return motor_[i]; }
  /// For a person. @param names  of the motors, as their file calls them
  [[nodiscard]] std::vector<Examination::Finding> findings(const std::vector<std::string>& names) const;

 private:
  enum class Phase : std::uint8_t { kWaiting, kResting, kPulsing, kWatching, kOver };

  void rest(Time now) noexcept;
  void end_pulse(Time now) noexcept;
  void judge_pulse(Time now) noexcept;
  void next_motor(Time now, Verdict verdict, Why why) noexcept;
  [[nodiscard]] int moved_along(const hal::State& state) const noexcept;

  std::size_t motors_;
  double peak_;
  std::array<Motor, kAxesMax> motor_{};

  Phase phase_ = Phase::kWaiting;
  Time since_;                 ///< of this phase
  Time rest_from_{};           ///< the joint has not moved since
  std::size_t now_at_ = 0, level_ = 0;
  int weak_ = 0;               ///< pulses of this motor that left the program too small
  bool forward_ = true;        ///< this pulse is towards larger angles
  std::array<bool, 2> went_{};  ///< of this pair: moved the way it was pushed
  std::int32_t from_raw_ = 0, rest_low_ = 0, rest_high_ = 0;
  double from_q_ = 0;
  double ordered_ = 0, given_ = 0;  ///< largest effort of this pulse
};

}  // namespace tandem::client
