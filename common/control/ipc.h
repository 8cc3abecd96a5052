#pragma once

#include "common/base/axes.h"
#include "common/control/pull.h"

/// Virtual coupling masses: the intrinsically passive controllers (IPC) of one axis [Stramigioli, LNCIS 266, 2001].
/// Their steps are implicit: the springs act on the virtual mass at the END of the step. No step therefore creates
/// energy, for any stiffness, mass and sample time (ARCHITECTURE.md, invariant 9).
namespace tandem::control {

/// Virtual mass between a device (stiffness k_c) and a reference (stiffness k). All gains are of this axis.
struct MasterIpc {
  double x = 0;  ///< position of the virtual mass xc
  double v = 0;  ///< its velocity vc
  /// Energy dissipated during the last step [J]: the damper's heat, and what the implicit step takes out of the channel
  /// spring, exactly 1/2 k (dx)^2. The balance is H' - H = supplied - b v'^2 T - 1/2 m (dv)^2 - 1/2 (k_c + k)(dx)^2.
  /// The share of k_c is not counted, because the held force of a sampled device generates as much.
  double dissipated = 0;

  struct Gains {
    double k_c = 0, b = 0, m_c = 0;  ///< stiffness to the device, damping, virtual mass
  };

  /// Advances by one step of length T [s], with the device at q and the reference at r through stiffness k.
  /// @param b_added  damping from the schedule, in addition to `Gains::b`.
  /// The result is finite for finite input with k, k_c, b >= 0 and m_c > 0.
  void step(const Gains& g, double T, double q, double r, double k, double b_added) noexcept TANDEM_REALTIME {
    const double b = g.b + b_added;
    v = (g.m_c * v + T * (g.k_c * (q - x) + k * (r - x))) / (g.m_c + T * b + T * T * (g.k_c + k));
    x += T * v;
    dissipated = (b + 0.5 * k * T) * v * v * T;
  }
  void rest_at(double q) noexcept {
    x = q;
    v = 0;
    dissipated = 0;
  }
  /// Returns the effort on the device [N or N m].
  [[nodiscard]] double device_effort(const Gains& g, double q) const noexcept { return -g.k_c * (q - x); }
  /// Returns the energy stored in the mass and both springs [J].
  [[nodiscard]] double stored(const Gains& g, double q, double r, double k) const noexcept {
    return 0.5 * g.m_c * v * v + 0.5 * g.k_c * (q - x) * (q - x) + 0.5 * k * (r - x) * (r - x);
  }
};

/// The shared tool of one axis: the slave's virtual mass m_s, pulled by the springs of the seats and by its slave
/// device.
struct ToolIpc {
  double x = 0;
  double v = 0;
  double dissipated =
      0;  ///< during the last step [J]: as for MasterIpc, the damper and the springs of the seats, not the slave's

  struct Gains {
    double m_s = 0, b_s = 0;  ///< virtual mass and damping
  };
  using Pull = control::Pull;  ///< the springs of the seats enter as alpha_i k_i and alpha_i k_i p_i
  /// Advances by one step of length T [s]. Springs act at the end of the step, so the weighted storage does not grow as
  /// it does in the published explicit form.
  /// @param k_seats  the part of pull.k that comes from the seats.
  void step(const Gains& g, double T, const Pull& pull, double k_seats) noexcept TANDEM_REALTIME {
    const double b = g.b_s + pull.b;
    v = (g.m_s * v + T * (pull.k_anchor - pull.k * x + pull.b_velocity)) / (g.m_s + T * b + T * T * pull.k);
    x += T * v;
    dissipated = (b + 0.5 * k_seats * T) * v * v * T;
  }
};

}  // namespace tandem::control
