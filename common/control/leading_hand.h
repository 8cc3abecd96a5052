#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "common/base/axes.h"
#include "common/base/port_sample.h"
#include "common/control/hand_motion.h"

namespace tandem::control {

/// Motion of one hand for display (ghost) and for seats with `assist`: its position now, predicted over the age of its
/// newest sample.
///
///     quick     x + age v              v: as received, through one pole of 2.5 Hz
///     steady    x_s + age v_s          x_s' = v_s + 2 w0 (x - x_s), v_s' = w0^2 (x - x_s), w0 = 8 /s
///     shown     quick + u (steady - quick)     u = age^2 / (age^2 + (50 ms)^2) / (1 + (v / 10 mm/s)^4)
///
/// A hand that is held still shakes by 0.5 mm at 2 Hz and by 0.1 mm at 10 Hz. At ages of 100 ms and more the quick
/// prediction, made for fast hands, amplifies this to several millimetres. The steady prediction limits it to one
/// millimetre. It lags when the hand changes direction, so fast motion does not use it.
class LeadingHand {
 public:
  LeadingHand() noexcept : LeadingHand(0.001) {}
  /// @param dt  tick [s]
  explicit LeadingHand(double dt) noexcept : dt_(dt), part_(pole_part(kHz, dt)) {}

  /// Advances the prediction by one tick.
  /// @param present  false: the hand is forgotten
  /// @param heard    newest sample, in port axes
  /// @param axes     number of axes of a TIP port, 1 to 3; 0 for JOINT ports, whose hands are shown at the received
  /// position
  /// @param age      age of the sample [s]
  void step(bool present, const PortSample& heard, std::size_t axes, double age) noexcept TANDEM_REALTIME {
    if (!present) [[unlikely]]
      return set_present(false);
    double square = 0;
    for (std::size_t a = 0; a < axes; ++a) {
      if (!present_) [[unlikely]] {
        slow_[a] = heard.x[a];
        slow_v_[a] = quick_v_[a] = 0;
      }
      quick_v_[a] +=
          part_ * (std::clamp(heard.v[a], -Prediction::kVelocityMax, Prediction::kVelocityMax) - quick_v_[a]);
      const double behind = heard.x[a] - slow_[a];
      slow_[a] += (slow_v_[a] + 2 * kSlowPole * behind) * dt_;
      slow_v_[a] += kSlowPole * kSlowPole * behind * dt_;
      square += quick_v_[a] * quick_v_[a];
    }
    const double speed = square / (kSlow * kSlow);
    share_ = age * age / ((age * age + kAge * kAge) * (1 + speed * speed));
    for (std::size_t a = 0; a < axes; ++a) {
      steady_x_[a] = Prediction::place_for_hand(slow_[a], slow_v_[a], age);
      const double quick = Prediction::place_for_hand(heard.x[a], quick_v_[a], age);
      moved_[a] = quick + share_ * (steady_x_[a] - quick) - heard.x[a];
      shown_v_[a] = quick_v_[a] + share_ * (slow_v_[a] - quick_v_[a]);
    }
    present_ = true;
  }
  /// Replaces `step` under laws that predict no hands: the hand is shown at the received position.
  void set_present(bool present) noexcept TANDEM_REALTIME { present_ = present; }
  [[nodiscard]] bool present() const noexcept { return present_; }
  /// The weight u of the class comment, in [0, 1].
  [[nodiscard]] double steady_share() const noexcept { return present_ ? share_ : 0; }
  /// Steady prediction of the position where the hand pulls at the tool [m], and its velocity [m/s]. @pre present, at
  /// a TIP port
  [[nodiscard]] double steady_x(std::size_t axis) const noexcept { return steady_x_[axis]; }
  [[nodiscard]] double steady_v(std::size_t axis) const noexcept { return slow_v_[axis]; }
  /// Position at which the hand is shown [m].
  /// @param tip  received tip position [m]; with a motor at its limit it is beyond the position where the hand pulls
  [[nodiscard]] double shown_x(std::size_t axis, double tip) const noexcept {
    return std::clamp(tip + moved_[axis], -kTipMax, kTipMax);
  }
  /// Velocity with which the hand is shown [m/s].
  [[nodiscard]] double shown_v(std::size_t axis) const noexcept { return shown_v_[axis]; }

  static constexpr double kHz = 2.5;      ///< [Hz]
  static constexpr double kSlowPole = 8;  ///< w0 [1/s]
  static constexpr double kSlow = 0.010;  ///< [m/s]
  static constexpr double kAge = 0.05;    ///< [s]
  static constexpr double kTipMax = 10;   ///< bound of a shown position [m]

 private:
  double dt_, part_;
  bool present_ = false;
  double share_ = 0;
  std::array<double, 3> slow_{}, slow_v_{}, quick_v_{}, steady_x_{}, shown_v_{}, moved_{};
};

}  // namespace tandem::control
