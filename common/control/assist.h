#pragma once

#include <cstddef>

#include "common/base/axes.h"

namespace tandem::control {

/// A bounded pull of a following hand towards the hand that leads it. A relaxed hand that follows a spring stays offset
/// from the leader by what friction and its own damping hold. This law moves the end of the hand's spring by a shift s,
/// so that the offset vanishes:
///
///     e    = leader's hand - own hand, at most F_a / k_c long      F_a: the bound of the pull
///     z    = e through two poles at p
///     s'   = w p / 6 z - s / T                                     |s| <= F_a / k_c, |s'| <= 10 N/s / k_c
///     F    = k_c (x + s - q)
///
/// - The two poles are at p = 1/2 sqrt(k_c / 0.5 kg), before the integration. A hand and a handle of at most 0.5 kg
/// swing on the spring at 2 p or faster. Above p the pull lags by more than half a period, so it damps that
/// oscillation. Below p the loop has a gain margin of 12.
/// - 1/T is 1/4 s: the pull fades as the hand arrives, and a hand that friction holds is not pulled on. At rest one
/// twentieth of the original e remains.
/// - w = 1 / (1 + (v / 40 mm/s)^2) with the leader's velocity v, because a pull delayed by 1/p would worsen a fast
/// motion.
/// - The pull only fades while no hand leads, while this hand has authority (full pull at 0, none from 0.02 on), or at
/// a surface unless `in_contact`.
///
/// Each step of s is work of the spring's end. The owner pays for it and then confirms it by `move`; an axis that could
/// not pay keeps its shift.
class Assist {
 public:
  static constexpr std::size_t kAxes = 3;
  /// Bounds and conditions of the assist.
  struct Params {
    std::size_t axes = 3;     ///< of a TIP port, 1 to 3
    double force = 0;         ///< F_a [N]; 0: off
    bool in_contact = false;  ///< pulls also while the tool touches a surface
    double k_c = 400;         ///< hand to copy [N/m]
    double dt = 0.001;        ///< duration of a tick [s]
  };
  /// Input of one tick. Axes are those of the port.
  struct Input {
    bool led = false;       ///< another hand leads, and `ahead` and `velocity` are known
    AxisArray ahead{};      ///< the leader's hand minus this hand [m], world axes
    AxisArray velocity{};   ///< of the leader's hand [m/s]
    double authority = 0;   ///< of this hand [0, 1]
    bool touching = false;  ///< the tool touches a surface
  };
  explicit Assist(const Params& params) noexcept;

  /// Sets the pull to zero at once, for a seat that is not engaged.
  void rest() noexcept { *this = Assist(p_); }
  /// Computes the wanted step; called once per tick. @return the wanted step of the shift [m]; inputs that are not
  /// finite are ignored
  const AxisArray& step(const Input& in) noexcept TANDEM_REALTIME;
  /// Confirms that this step was paid for.
  void move(std::size_t axis, double step) noexcept { shift_[axis] += step; }

  /// True if the assist is enabled.
  [[nodiscard]] bool on() const noexcept { return p_.force > 0; }
  [[nodiscard]] double shift(std::size_t axis) const noexcept { return shift_[axis]; }  ///< s [m]
  [[nodiscard]] double force() const noexcept;  ///< norm of k_c s [N], at most F_a

  static constexpr double kRate = 10;          ///< largest change of the pull [N/s]
  static constexpr double kAuthority = 0.02;   ///< from this authority on a hand is not pulled
  static constexpr double kMassMax = 0.5;      ///< of a hand and its handle [kg]
  static constexpr double kFadeTime = 4;       ///< T [s]
  static constexpr double kReleaseTime = 0.2;  ///< the same while nothing pulls [s]
  static constexpr double kSlow = 0.04;        ///< [m/s]

 private:
  Params p_;
  double reach_ = 0, pole_ = 0, most_ = 0;  ///< F_a / k_c [m]; share of a tick; largest step of s [m]
  AxisArray first_{}, second_{}, shift_{}, step_{};
};

}  // namespace tandem::control
