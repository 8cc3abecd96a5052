#pragma once

#include <span>

/// Smoothness of one movement from its speed, or of a force from its magnitude. Pure functions of evenly sampled
/// values, in any unit: each result is dimensionless or a frequency. Results that do not exist are NaN.
namespace tandem::netsim::score {

/// Parameters of `sparc`: those of the reference package.
struct SparcOptions {
  int padding = 4;          ///< the spectrum has 2^(ceil(log2 N) + padding) points
  double cutoff_hz = 10;    ///< largest frequency considered
  double amplitude = 0.05;  ///< the range reaches to the last frequency of at least this share of the largest amplitude
};

/// Spectral arc length: minus the length of the normalised amplitude spectrum's curve over [0, 1]. Near -1.4 for one
/// smooth movement; the more negative, the less smooth.
/// Source [Balasubramanian et al. 2015]: "On the analysis of movement smoothness", J. NeuroEng. Rehab. 12:112.
/// @param speed  at least 4 values, not all 0; otherwise NaN
[[nodiscard]] double sparc(std::span<const double> speed, double rate_hz, const SparcOptions& options = {});

/// Dimensionless jerk: -(T^3 / v_peak^2) integral (d2 s/dt2)^2 dt, by second forward differences and T = N / rate, as
/// the same reference. @param speed  at least 3 values, not all 0; otherwise NaN
[[nodiscard]] double dimensionless_jerk(std::span<const double> speed, double rate_hz);

/// Log dimensionless jerk: -ln |DLJ|. NaN also if DLJ is 0, as for a constant speed.
[[nodiscard]] double log_dimensionless_jerk(std::span<const double> speed, double rate_hz);

/// Frequency below which 95 % of the power of the speed's deviation from its mean lies [Hz]. NaN for a constant speed.
[[nodiscard]] double motion_frequency_95(std::span<const double> speed, double rate_hz);

}  // namespace tandem::netsim::score
