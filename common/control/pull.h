#pragma once

namespace tandem::control {

/// What pulls at a mass along one axis: springs and dampers summed, so that an implicit step can take them all at its end.
struct Pull {
  double k = 0, k_anchor = 0;    ///< sums of stiffness, and of stiffness times anchor [N/m, N]
  double b = 0, b_velocity = 0;  ///< sums of damping, and of damping times the velocity it is relative to [N s/m, N]
  void spring(double stiffness, double anchor) noexcept {
    k += stiffness;
    k_anchor += stiffness * anchor;
  }
  /// @param velocity  it is relative to; 0: the ground
  void damper(double gain, double velocity) noexcept {
    b += gain;
    b_velocity += gain * velocity;
  }
};

}  // namespace tandem::control
