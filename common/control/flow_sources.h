#pragma once

#include <cstddef>
#include <cstdint>

#include "common/base/axes.h"

namespace tandem::control {

/// Rule by which the flow sources of a tool are limited.
enum class FlowSourceMode : std::uint8_t {
  kOpen,  ///< every grant is given; stable by weighted passivity
  kTank,  ///< grants come from a tank of dissipated energy: absolutely passive, but a following hand receives little
  kSeed,  ///< velocity gate by E_p exactly as printed in [Licona et al. 2019] eq. 3-4
  kSeedSigned  ///< the same with the sign that makes the printed rule passive
};

/// The modulated flow sources (MFS) of a tool. They let a seat feel more of the tool than its authority pays for. The
/// gate acts per axis, on credit (open, tank) or on velocity (seed modes).
class FlowSources {
 public:
  /// @param tank_initial  initial level of the tank [J]; kTank only
  explicit FlowSources(FlowSourceMode mode = FlowSourceMode::kOpen, double tank_initial = 0.05) noexcept
      : mode_(mode), tank_(tank_initial), tank_initial_(tank_initial) {}

  /// Requests energy for a seat's credit beyond the energy that the tool really paid [J] >= 0. @return the granted
  /// energy, <= wanted.
  [[nodiscard]] double grant(double wanted) noexcept {
    if (!(wanted > 0)) return 0;
    const bool limited = mode_ == FlowSourceMode::kTank;
    const double given = limited && tank_ < wanted ? tank_ : wanted;
    if (limited) tank_ -= given;
    granted_ += given;
    return given;
  }
  /// Adds dissipated energy and energy absorbed by the sources to the tank. The tank holds at most four times its
  /// initial level.
  void fill(double joule) noexcept {
    if (joule > 0 && mode_ == FlowSourceMode::kTank)
      tank_ = tank_ + joule < 4 * tank_initial_ ? tank_ + joule : 4 * tank_initial_;
  }

  /// Integrates the observer of eq. 3: E_p = integral of [sum over masters of -(1 - alpha_i) F_ri] v_rs = -E_injected.
  /// @param injected_power  sum_i (C_i - alpha_i) F_ri v_rs on this axis [W].
  void observe(std::size_t axis, double injected_power, double dt) noexcept { e_inj_[axis] += injected_power * dt; }

  /// Returns the gate g of eq. 4 on this axis, 0 or 1. As printed (kSeed) it cuts the sources when E_p > 0, which is
  /// when they have absorbed energy.
  [[nodiscard]] double gate(std::size_t axis) const noexcept {
    switch (mode_) {
      case FlowSourceMode::kSeed:
        return -e_inj_[axis] <= 0 ? 1 : 0;
      case FlowSourceMode::kSeedSigned:
        return e_inj_[axis] <= 0 ? 1 : 0;
      default:
        return 1;
    }
  }
  /// Returns whether the gate acts on velocity (seed modes).
  [[nodiscard]] bool gates_velocity() const noexcept {
    return mode_ == FlowSourceMode::kSeed || mode_ == FlowSourceMode::kSeedSigned;
  }
  [[nodiscard]] double energy_p(std::size_t axis) const noexcept { return -e_inj_[axis]; }  ///< E_p of eq. 3 [J]
  [[nodiscard]] double granted() const noexcept { return granted_; }                        ///< cumulative [J]
  /// Level of the tank [J].
  [[nodiscard]] double tank() const noexcept { return tank_; }
  [[nodiscard]] FlowSourceMode mode() const noexcept { return mode_; }

 private:
  FlowSourceMode mode_;
  double tank_, tank_initial_;
  double granted_ = 0;
  AxisArray e_inj_{};
};

}  // namespace tandem::control
