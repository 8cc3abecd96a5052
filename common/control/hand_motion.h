#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/axes.h"

/// Filters and prediction of hand motion. Prediction bridges the network delay: the position error is then that of the
/// predictor, not the distance moved during the delay. Poles and bounds were chosen together from some 900 random
/// parameter sets. The criterion was the simulated hands of `tandem-netsim feel`, probes `free` and `gain`, at 0 to 200
/// ms (ARCHITECTURE.md describes the trade-off).
namespace tandem::control {

/// Returns the share of a new value that a single-pole filter passes within one tick, (0, 1).
[[nodiscard]] inline double pole_part(double hz, double dt) noexcept {
  return 1 - std::exp(-2 * std::numbers::pi * hz * dt);
}

/// Motion of a hand along one axis.
struct HandMotion {
  double x = 0;  ///< [m]
  double v = 0;  ///< [m/s]
  double a = 0;  ///< [m/s^2]: the lasting acceleration, within kLastingMax, plus the braking acceleration
};

/// Estimates velocity and acceleration of one axis from encoder counts. Velocity is the position difference through one
/// pole of 21 Hz. Its difference passes two poles:
/// - the lasting part (1.25 Hz) bends the predicted path over long ages;
/// - the part against the velocity (33 Hz) shows that a hand is about to stop. Without it the tool overshoots.
///
/// Braking below 1.2 m/s^2 is ignored: it is encoder noise and tremor. A hand on 50 mm at 0.5 Hz reaches
/// 0.5 m/s^2.
class HandMotionFilter {
 public:
  static constexpr double kVelocityHz = 21, kLastingHz = 1.25, kBrakingHz = 33;  ///< poles [Hz]
  static constexpr double kLastingMax = 0.35;                                    ///< [m/s^2]
  static constexpr double kBrakingFrom = 1.2;  ///< threshold of braking, beyond the lasting part [m/s^2]

  explicit HandMotionFilter(double dt = 0.001) noexcept
      : dt_(dt),
        velocity_part_(pole_part(kVelocityHz, dt)),
        lasting_part_(pole_part(kLastingHz, dt)),
        braking_part_(pole_part(kBrakingHz, dt)) {}

  void rest_at(double x) noexcept {
    now_ = {x, 0, 0};
    lasting_ = quick_ = 0;
  }
  /// Updates the estimate; called once per tick. A value that is not finite changes nothing.
  const HandMotion& step(double x) noexcept TANDEM_REALTIME {
    const double before = now_.v;
    const double rate = (x - now_.x) / dt_;
    if (!std::isfinite(rate)) return now_;
    now_.x = x;
    now_.v += velocity_part_ * (rate - before);
    const double change = (now_.v - before) / dt_;
    lasting_ += lasting_part_ * (change - lasting_);
    quick_ += braking_part_ * (change - quick_);
    const double beyond = quick_ - lasting_;
    const double braking = beyond - std::clamp(beyond, -kBrakingFrom, kBrakingFrom);
    now_.a = std::clamp(lasting_, -kLastingMax, kLastingMax) + (braking * now_.v < 0 ? braking : 0);
    return now_;
  }
  /// Returns the present estimate.
  [[nodiscard]] const HandMotion& now() const noexcept { return now_; }

 private:
  double dt_, velocity_part_, lasting_part_, braking_part_;
  double lasting_ = 0, quick_ = 0;  ///< [m/s^2]
  HandMotion now_;
};

/// Velocity of the hand for the damper between the hand and its copy of the tool. Its pole is fast (40 Hz), because a
/// damper to a lagging velocity feels like mass.
class HandVelocity {
 public:
  static constexpr double kHz = 40;  ///< pole [Hz]

  explicit HandVelocity(double dt = 0.001) noexcept : dt_(dt), part_(pole_part(kHz, dt)) {}
  void rest_at(double x) noexcept {
    x_ = x;
    v_ = 0;
  }
  /// Returns the velocity [m/s]; called once per tick. A value that is not finite changes nothing.
  double step(double x) noexcept TANDEM_REALTIME {
    const double rate = (x - x_) / dt_;
    if (!std::isfinite(rate)) return v_;
    x_ = x;
    return v_ += part_ * (rate - v_);
  }

 private:
  double dt_, part_;
  double x_ = 0, v_ = 0;
};

/// Prediction over the whole age of a sample, bounded by what a human hand does: constant acceleration, and braking
/// until the hand is at rest.
struct Prediction {
  static constexpr double kHorizonMax = 0.25;     ///< [s]
  static constexpr double kVelocityMax = 1;       ///< [m/s]
  static constexpr double kAccelerationMax = 10;  ///< of a braking hand [m/s^2]; 20 mm within 0.15 s need 5
  /// Correction speeds of the tool, in addition to the hand's speed [m/s]. kApproach applies to every better
  /// prediction. kBackBy is added if the new prediction is less far ahead of the hand; this reduces overshoot.
  static constexpr double kApproach = 0.05, kBackBy = 0.1;
  /// The part of the filter delay that the acceleration compensates. It exceeds the 8 ms of the velocity pole because
  /// the lasting part is delayed as well.
  static constexpr double kFilterDelay = 0.015;  ///< [s]

  /// Returns the predicted velocity after `age` [m/s].
  [[nodiscard]] static double rate(const HandMotion& m, double age) noexcept {
    const double t = horizon(age) + kFilterDelay;
    return velocity(m) + lasting(m) * t + braked(m, t);
  }
  /// Returns the predicted position after `age` [m].
  [[nodiscard]] static double place(const HandMotion& m, double age) noexcept {
    const double h = horizon(age);
    return m.x + h * (velocity(m) + lasting(m) * (0.5 * h + kFilterDelay) + 0.5 * braked(m, h + kFilterDelay));
  }
  /// Prediction of a reference that pulls a hand. It uses velocity alone, through a further pole of 7 Hz that becomes
  /// slower beyond an age of 130 ms. The prediction used for tools would shake a relaxed hand.
  static constexpr double kCalmHz = 7, kCalmTurns = 0.9;
  [[nodiscard]] static double calm_part(double dt, double age) noexcept {
    return pole_part(std::min(kCalmHz, kCalmTurns / std::max(age, dt)), dt);
  }
  /// Returns the predicted position after `age` from velocity alone [m].
  [[nodiscard]] static double place_for_hand(double x, double v, double age) noexcept {
    return x + horizon(age) * std::clamp(v, -kVelocityMax, kVelocityMax);
  }

 private:
  [[nodiscard]] static double horizon(double age) noexcept { return std::clamp(age, 0.0, kHorizonMax); }
  [[nodiscard]] static double velocity(const HandMotion& m) noexcept {
    return std::clamp(m.v, -kVelocityMax, kVelocityMax);
  }
  [[nodiscard]] static double lasting(const HandMotion& m) noexcept {
    return std::clamp(m.a, -HandMotionFilter::kLastingMax, HandMotionFilter::kLastingMax);
  }
  /// Returns the change of velocity within `t` [s] through braking [m/s]. Braking stops a hand and never reverses it.
  [[nodiscard]] static double braked(const HandMotion& m, double t) noexcept {
    const double v = velocity(m), by = t * (std::clamp(m.a, -kAccelerationMax, kAccelerationMax) - lasting(m));
    if (by * v >= 0) return 0;
    return std::clamp(by, -std::abs(v), std::abs(v));
  }
};

}  // namespace tandem::control
