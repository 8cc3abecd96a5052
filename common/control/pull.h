#pragma once

namespace tandem::control {

/// The sum of all springs and dampers that pull a mass along one axis, so that an implicit step can apply them at its
/// end.
struct Pull {
  double k = 0, k_anchor = 0;    ///< sums of stiffness, and of stiffness times anchor [N/m, N]
  double b = 0, b_velocity = 0;  ///< sums of damping, and of damping times its reference velocity [N s/m, N]
  /// Adds a spring. @param stiffness  [N/m]  @param anchor  position of its far end [m]
  void spring(double stiffness, double anchor) noexcept {
    k += stiffness;
    k_anchor += stiffness * anchor;
  }
  /// Adds a damper. @param gain  [N s/m]  @param velocity  to which the damping is relative [m/s]; 0: ground
  void damper(double gain, double velocity) noexcept {
    b += gain;
    b_velocity += gain * velocity;
  }
};

}  // namespace tandem::control
