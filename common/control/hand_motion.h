#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/base/axes.h"

/// How a hand moves, and where it will be: a network is bridged by prediction, so the error is the predictor's and not the way's.
/// Poles and bounds were chosen together, by some 900 drawn sets on the hands of `tandem-netsim feel`, probes `free` and `gain`, at 0 to 200 ms
/// (ARCHITECTURE.md has the trade).
namespace tandem::control {

/// Share of a new value that one pole lets through within one tick.
[[nodiscard]] inline double pole_part(double hz, double dt) noexcept { return 1 - std::exp(-2 * std::numbers::pi * hz * dt); }

struct HandMotion {
  double x = 0;  ///< [m]
  double v = 0;  ///< [m/s]
  double a = 0;  ///< [m/s^2]: what lasts, within kLastingMax, and beside it how hard the hand brakes
};

/// Velocity and acceleration of one axis from encoder steps: a difference through one pole of 20 Hz, and of that the difference through two
/// poles. What lasts (1.3 Hz) bends a path over long ages. What goes against the velocity (30 Hz) says that a hand is about to stop: a tool that
/// does not hear of it overshoots. Below 1 m/s^2, twice what a hand on 50 mm at 0.5 Hz does, the latter is noise of the encoder and tremor.
class HandMotionFilter {
 public:
  static constexpr double kVelocityHz = 21, kLastingHz = 1.25, kBrakingHz = 33;
  static constexpr double kLastingMax = 0.35;   ///< [m/s^2]
  static constexpr double kBrakingFrom = 1.2;     ///< beyond what lasts [m/s^2]

  explicit HandMotionFilter(double dt = 0.001) noexcept
      : dt_(dt), velocity_part_(pole_part(kVelocityHz, dt)), lasting_part_(pole_part(kLastingHz, dt)), braking_part_(pole_part(kBrakingHz, dt)) {}

  void rest_at(double x) noexcept {
    now_ = {x, 0, 0};
    lasting_ = quick_ = 0;
  }
  /// Once per tick; what is not finite changes nothing.
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
  [[nodiscard]] const HandMotion& now() const noexcept { return now_; }

 private:
  double dt_, velocity_part_, lasting_part_, braking_part_;
  double lasting_ = 0, quick_ = 0;  ///< [m/s^2]
  HandMotion now_;
};

/// Velocity of the hand for the damper between it and its copy of the tool: a damper to a velocity that lags feels like mass.
class HandVelocity {
 public:
  static constexpr double kHz = 40;

  explicit HandVelocity(double dt = 0.001) noexcept : dt_(dt), part_(pole_part(kHz, dt)) {}
  void rest_at(double x) noexcept {
    x_ = x;
    v_ = 0;
  }
  /// Once per tick; what is not finite changes nothing. @return [m/s]
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

/// Over the whole age of a sample, bounded by what a person does: constant acceleration, and braking until the hand stands still.
struct Prediction {
  static constexpr double kHorizonMax = 0.25;       ///< [s]
  static constexpr double kVelocityMax = 1;         ///< [m/s]
  static constexpr double kAccelerationMax = 10;    ///< of a hand that brakes [m/s^2]; 20 mm within 0.15 s take 5
  /// How much faster than the hand a tool goes to a better prediction [m/s]; and to one that is less far ahead of the hand, which overshoots less.
  static constexpr double kApproach = 0.05, kBackBy = 0.1;
  /// How much of the filter's own delay the acceleration makes up for. More than the velocity's pole has (8 ms): what lasts comes late as well.
  static constexpr double kFilterDelay = 0.015;  ///< [s]

  /// Velocity after `age` [m/s].
  [[nodiscard]] static double rate(const HandMotion& m, double age) noexcept {
    const double t = horizon(age) + kFilterDelay;
    return velocity(m) + lasting(m) * t + braked(m, t);
  }
  /// Place after `age` [m].
  [[nodiscard]] static double place(const HandMotion& m, double age) noexcept {
    const double h = horizon(age);
    return m.x + h * (velocity(m) + lasting(m) * (0.5 * h + kFilterDelay) + 0.5 * braked(m, h + kFilterDelay));
  }
  /// What pulls a hand is predicted by its velocity alone, and by one that went through a further pole of 7 Hz, slower beyond an age of 130 ms: the
  /// bolder prediction shakes a relaxed hand.
  static constexpr double kCalmHz = 7, kCalmTurns = 0.9;
  [[nodiscard]] static double calm_part(double dt, double age) noexcept { return pole_part(std::min(kCalmHz, kCalmTurns / std::max(age, dt)), dt); }
  [[nodiscard]] static double place_for_hand(double x, double v, double age) noexcept {
    return x + horizon(age) * std::clamp(v, -kVelocityMax, kVelocityMax);
  }

 private:
  [[nodiscard]] static double horizon(double age) noexcept { return std::clamp(age, 0.0, kHorizonMax); }
  [[nodiscard]] static double velocity(const HandMotion& m) noexcept { return std::clamp(m.v, -kVelocityMax, kVelocityMax); }
  [[nodiscard]] static double lasting(const HandMotion& m) noexcept { return std::clamp(m.a, -HandMotionFilter::kLastingMax, HandMotionFilter::kLastingMax); }
  /// Change of velocity within `t` [s] by braking: it stops a hand, and turns none around.
  [[nodiscard]] static double braked(const HandMotion& m, double t) noexcept {
    const double v = velocity(m), by = t * (std::clamp(m.a, -kAccelerationMax, kAccelerationMax) - lasting(m));
    if (by * v >= 0) return 0;
    return std::clamp(by, -std::abs(v), std::abs(v));
  }
};

}  // namespace tandem::control
