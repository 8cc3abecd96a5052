#pragma once

/// Stiffness limit of a spring that acts on a sampled device.
///
/// The motor holds each force for a tick T, on average T/2 too long, and the device adds its latency t_d. A spring of
/// stiffness k creates energy through that delay unless the device's own physical damping b dissipates it:
///
///     k <= b / (T/2 + t_d)
///
/// Sources: t_d = 0 [Colgate, Schenkel, J. Robotic Systems 14(1) 1997], k <= 2 b/T; with delay [Gil, Sanchez, Hulin,
/// Preusche, Hirzinger, J. Comput. Inf. Sci. Eng. 9(1) 2009].
namespace tandem {

/// Damping assumed for a device that declares none [N s/m at the tip]: half of that of a Touch, the least damped device
/// modelled here.
inline constexpr double kDampingUnknown = 0.1;
/// Latency assumed for a real device that declares none [s]: the force follows a reading after one exchange of 1 ms.
inline constexpr double kLatencyUnknown = 0.001;

/// Share of the limit that law `replica` renders. At the limit itself no damping is left for a released handle without
/// friction. With 0.93 a Touch renders bone (20 kN/m) with 365 N/m. Such a handle then comes to rest with a time
/// constant of 9 s (ARCHITECTURE.md, law `replica`).
inline constexpr double kStiffnessShare = 0.93;

/// @param damping  physical, at the tip [N s/m]  @param latency  t_d [s]  @param tick  T [s], positive
/// @return largest passive stiffness [N/m]
[[nodiscard]] constexpr double stiffness_limit(double damping, double latency, double tick) noexcept {
  return damping / (0.5 * tick + latency);
}

}  // namespace tandem
