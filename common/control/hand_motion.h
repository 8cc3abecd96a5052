#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/axes.h"

/// How a hand moves, and where it will be: a network is bridged by prediction, so the error is the predictor's and not the way's.
namespace tandem::control {

struct HandMotion {
  double x = 0;  ///< [m]
  double v = 0;  ///< [m/s]
  double a = 0;  ///< [m/s^2]
};

/// Velocity and acceleration of one axis from encoder steps: a difference through one pole of 17 Hz, and the difference of that through one of
/// 2.3 Hz. Chosen together with `Prediction`, on circles with tremor and intention noise and on recorded motion: slower poles lag
/// behind a hand, faster ones amplify what it does at 3 to 10 Hz (ARCHITECTURE.md has the trade).
class HandMotionFilter {
 public:
  explicit HandMotionFilter(double dt = 0.001) noexcept
      : dt_(dt), velocity_part_(1 - std::exp(-2 * std::numbers::pi * kVelocityHz * dt)), acceleration_part_(1 - std::exp(-2 * std::numbers::pi * kAccelerationHz * dt)) {}

  void rest_at(double x) noexcept { now_ = {x, 0, 0}; }
  /// Once per tick; what is not finite changes nothing.
  const HandMotion& step(double x) noexcept TANDEM_REALTIME {
    const double before = now_.v;
    const double rate = (x - now_.x) / dt_;
    if (!std::isfinite(rate)) return now_;
    now_.x = x;
    now_.v += velocity_part_ * (rate - before);
    now_.a += acceleration_part_ * ((now_.v - before) / dt_ - now_.a);
    return now_;
  }
  [[nodiscard]] const HandMotion& now() const noexcept { return now_; }
  /// With half of the velocity's own delay made up for: a damper to a velocity that lags feels like mass. All of it would
  /// make the damping that a hand feels at 1 Hz negative.
  [[nodiscard]] static double velocity_by_now(const HandMotion& m) noexcept {
    return m.v + m.a * 0.5 / (2 * std::numbers::pi * kVelocityHz);
  }

  static constexpr double kVelocityHz = 17, kAccelerationHz = 2.3;

 private:
  double dt_, velocity_part_, acceleration_part_;
  HandMotion now_;
};

/// Constant acceleration over the whole age of a sample, bounded by what a person does.
struct Prediction {
  static constexpr double kHorizonMax = 0.25;       ///< [s]
  static constexpr double kVelocityMax = 1;         ///< [m/s]
  static constexpr double kAccelerationMax = 0.5;   ///< [m/s^2]
  static constexpr double kApproach = 0.06;         ///< at which a tool goes to a better prediction [m/s]
  /// Half of the velocity filter's own delay is made up for: all of it costs more gain than it saves error.
  static constexpr double kFilterDelay = 0.5 / (2 * std::numbers::pi * HandMotionFilter::kVelocityHz);  ///< [s]

  [[nodiscard]] static double acceleration(const HandMotion& m) noexcept { return std::clamp(m.a, -kAccelerationMax, kAccelerationMax); }
  [[nodiscard]] static double velocity(const HandMotion& m) noexcept { return std::clamp(m.v, -kVelocityMax, kVelocityMax); }
  /// Place after `age` [s].
  [[nodiscard]] static double place(const HandMotion& m, double age) noexcept {
    const double h = std::clamp(age, 0.0, kHorizonMax);
    return m.x + h * (velocity(m) + acceleration(m) * (0.5 * h + kFilterDelay));
  }
  /// Velocity after `age` [m/s].
  [[nodiscard]] static double rate(const HandMotion& m, double age) noexcept {
    const double h = std::clamp(age, 0.0, kHorizonMax);
    return velocity(m) + acceleration(m) * (h + kFilterDelay);
  }
  /// What pulls a hand is predicted by its velocity alone, and by one that went through a further pole of 7 Hz: the bolder prediction shakes
  /// a relaxed hand.
  static constexpr double kCalmHz = 7;
  [[nodiscard]] static double calm_part(double dt) noexcept { return 1 - std::exp(-2 * std::numbers::pi * kCalmHz * dt); }
  [[nodiscard]] static double place_for_hand(double x, double v, double age) noexcept {
    return x + std::clamp(age, 0.0, kHorizonMax) * std::clamp(v, -kVelocityMax, kVelocityMax);
  }
};

}  // namespace tandem::control
