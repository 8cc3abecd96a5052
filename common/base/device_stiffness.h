#pragma once

/// How stiff a spring may be that meets a sampled device.
///
/// The motor holds each force for a tick T, on average T/2 too long, and the device adds its latency t_d: a spring of stiffness k makes
/// energy out of that delay unless the device's own physical damping b takes it away,
///
///     k <= b / (T/2 + t_d)
///
/// Sources: t_d = 0 [Colgate, Schenkel, J. Robotic Systems 14(1) 1997], k <= 2 b/T; with delay [Gil, Sanchez, Hulin, Preusche, Hirzinger,
/// J. Comput. Inf. Sci. Eng. 9(1) 2009].
namespace tandem {

/// Damping taken for a device that declares none [N s/m at the tip]: half of the least damped device modelled here, a Touch.
inline constexpr double kDampingUnknown = 0.1;
/// Latency taken for a real device that declares none [s]: the force answers a reading one exchange of 1 ms later.
inline constexpr double kLatencyUnknown = 0.001;

/// Share of the limit that law `replica` renders. At the limit itself nothing is left that calms a released handle without friction; with 0.93 a
/// Touch feels bone (20 kN/m) with 365 N/m, and such a handle comes to rest with a time constant of 9 s (ARCHITECTURE.md, law `replica`).
inline constexpr double kStiffnessShare = 0.93;

/// @param damping  physical, at the tip [N s/m]  @param latency  t_d [s]  @param tick  T [s], positive
/// @return largest stiffness that stays passive [N/m]
[[nodiscard]] constexpr double stiffness_limit(double damping, double latency, double tick) noexcept { return damping / (0.5 * tick + latency); }

}  // namespace tandem
