#pragma once

#include <algorithm>
#include <array>
#include <cstddef>

#include "hal/core/device.h"
#include "proto/spec/scene_spec.h"

namespace tandem::hal::sim {

/// A flat, frictionless surface. Force k d + k3 d^3 + b d' along its outward normal at penetration d > 0; it never
/// pulls.
struct Surface {
  int axis = 0;      ///< 0 x, 1 y, 2 z
  double sign = -1;  ///< direction of the outward normal along the axis
  double at = 0;     ///< [m]
  double k = 0;      ///< [N/m]
  double k3 = 0;     ///< [N/m^3]
  double b = 0;      ///< [N s/m]

  [[nodiscard]] double penetration(const Vec3& tip) const noexcept { return sign * (at - tip[axis]); }
  [[nodiscard]] double slope(double d) const noexcept { return d > 0.0 ? k + 3.0 * k3 * d * d : k; }
  [[nodiscard]] double spring(double d) const noexcept { return d > 0.0 ? d * (k + k3 * d * d) : k * d; }
};

/// The surfaces at the tip of a simulated slave: at most one wall and one tissue.
class Environment {
 public:
  static constexpr std::size_t kSurfacesMax = 2;

  Environment() = default;
  explicit Environment(const EnvironmentSpec& spec) noexcept;

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  [[nodiscard]] const Surface& operator[](std::size_t i) const noexcept { return surfaces_[i]; }
  /// Returns the deepest penetration [m]; 0: no contact.
  [[nodiscard]] double penetration(const Vec3& tip) const noexcept;

 private:
  std::array<Surface, kSurfacesMax> surfaces_{};
  std::size_t size_ = 0;
};

/// Contact with one surface within one substep, reduced to a scalar: f = max(0, f0 - g * (change of the approach
/// speed)).
/// The linearly implicit form is stable for any stiffness.
/// It is trapezoidal while the step resolves the contact (energy is conserved), else backward Euler (no oscillation).
struct ContactStep {
  bool active = false;
  double f0 = 0;  ///< force if the velocity does not change [N]
  double g = 0;   ///< [N s/m]

  ContactStep() = default;
  /// @param d         penetration at the middle of the step if the velocity does not change [m]
  /// @param rate      velocity into the surface at the start [m/s]
  /// @param change    change of that velocity over the step without contact [m/s]
  /// @param mobility  velocity change per impulse along the normal [1/kg]
  ContactStep(const Surface& s, double d, double rate, double change, double mobility, double h) noexcept {
    if (!(d + 0.25 * h * change > 0.0)) return;
    active = true;
    const double k = s.slope(d);
    if (h * h * k * mobility <= 1.0) {
      f0 = s.spring(d) + s.b * rate;
      g = 0.25 * h * k + s.b;
    } else {
      const double ahead = d + 0.5 * h * rate;
      f0 = s.spring(d) + k * (ahead - d) + s.b * rate;
      g = h * k + s.b;
    }
  }
  /// Returns the force on the tip along the normal [N] if everything else changes the approach speed by `change`.
  [[nodiscard]] double force(double change, double mobility, double h) const noexcept {
    return active ? std::max(0.0, (f0 + g * change) / (1.0 + g * h * mobility)) : 0.0;
  }
};

}  // namespace tandem::hal::sim
