#pragma once

#include <algorithm>

#include "common/base/axes.h"

namespace tandem::control {

/// Gains of a channel as a function of the delay. The P+d condition [Nuno et al., IJRR 28(7) 2009] requires that k d
/// stays small.
struct GainScheduleParams {
  double k = 1000,        ///< stiffness without delay [N/m]
      k_min = 60;         ///< smallest stiffness at any delay [N/m]
  double k_delay = 5;     ///< k <= k_delay / d [N s/m]
  double b_delay = 0.25;  ///< damping = b_delay k d
  double lead_max = 0.1;  ///< [s]
  double k_rise = 500,    ///< largest rise of k, which is paid [N/m per s]
      k_fall = 4000;      ///< largest fall of k, which returns energy [N/m per s]
};

/// Computes stiffness, damping and lead from the delay. Stiffness is slewed so that no change is felt as a step.
class GainSchedule {
 public:
  /// Starts with the stiffness of no delay. @param p  gains and slews
  explicit GainSchedule(const GainScheduleParams& p = {}) noexcept : p_(p), k_(p.k) {}

  /// @param age  age of the datagram in use [s] >= 0: RTT/2 without synchronised clocks, plus the wait since its
  /// arrival. A value that is not a number, or above kAgeMax, counts as kAgeMax.
  /// @param dt   duration of a tick [s]
  void step(double age, double dt) noexcept TANDEM_REALTIME {
    age = bounded(age);
    const double tau = age > delay_ ? kRiseTime : kDecayTime;
    delay_ += (age - delay_) * std::min(1.0, dt / tau);
    const double wanted = delay_ > 0 ? std::clamp(p_.k_delay / delay_, std::min(p_.k_min, p_.k), p_.k) : p_.k;
    k_ += std::clamp(wanted - k_, -p_.k_fall * dt, p_.k_rise * dt);
  }
  /// Sets the delay known before the seat engages, without slewing: no spring is loaded then, so no step is felt.
  void settle(double age) noexcept {
    delay_ = bounded(age);
    k_ = delay_ > 0 ? std::clamp(p_.k_delay / delay_, std::min(p_.k_min, p_.k), p_.k) : p_.k;
  }
  /// Filtered delay [s].
  [[nodiscard]] double delay() const noexcept { return delay_; }
  /// Stiffness at the tip [N/m].
  [[nodiscard]] double stiffness() const noexcept { return k_; }
  /// Damping at the tip [N s/m].
  [[nodiscard]] double damping() const noexcept { return p_.b_delay * std::min(k_ * delay_, 1.5 * p_.k_delay); }
  /// Returns the time by which a position of this age is extrapolated [s].
  [[nodiscard]] double lead(double age) const noexcept { return std::min(age, p_.lead_max); }
  static constexpr double kShort = 0.002;  ///< below this age a datagram counts as fresh [s]
  static constexpr double kAgeMax = 60;    ///< [s]

 private:
  [[nodiscard]] static double bounded(double age) noexcept { return age < kAgeMax ? std::max(0.0, age) : kAgeMax; }
  static constexpr double kRiseTime = 0.1, kDecayTime = 1.0;  // a longer delay takes effect soon, a shorter one slowly
  GainScheduleParams p_;
  double delay_ = 0;
  double k_;
};

}  // namespace tandem::control
