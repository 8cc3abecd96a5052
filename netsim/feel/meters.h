#pragma once

#include <complex>
#include <cstddef>
#include <span>

#include "hal/device.h"

/// Numbers from columns of samples. Pure: no scene, no session. NaN where a number does not exist.
namespace tandem::netsim {

using Series = std::span<const hal::Vec3>;

[[nodiscard]] double mean(std::span<const double> values) noexcept;
[[nodiscard]] hal::Vec3 mean(Series values) noexcept;

/// Root of the mean square of the norms.
[[nodiscard]] double rms(Series values) noexcept;
/// The same of a - b. @pre a and b have the same length
[[nodiscard]] double rms_difference(Series a, Series b) noexcept;
/// RMS distance between a point and where it was `rows` rows earlier. NaN if there are not so many rows.
[[nodiscard]] double rms_lag(Series values, std::size_t rows) noexcept;

/// Slope of y over x by least squares, over the rows with y in [low, high]. NaN below 50 rows or without extent in x.
[[nodiscard]] double slope(std::span<const double> x, std::span<const double> y, double low, double high) noexcept;

/// Complex amplitude of the part of x(t) that turns with `hz`, by least squares of cosine, sine and a constant.
/// x = Re(amplitude exp(i 2 pi hz t)) + constant + rest. NaN below 8 rows.
[[nodiscard]] std::complex<double> harmonic(std::span<const double> t, std::span<const double> x, double hz) noexcept;

/// RMS of what lies above `hz` in each axis, the axes added as squares. A straight line is removed and a Hann window
/// applied, so that a slow drift does not count. NaN below 8 rows.
/// @param rate  rows per second
[[nodiscard]] double rms_above(Series values, double hz, double rate) noexcept;

/// Largest norm of a change within a millisecond [unit/ms]; for rates below 1 kHz the change of a row per its length.
[[nodiscard]] double largest_step_per_ms(Series values, double rate) noexcept;

/// Largest distance of a row from `from`.
[[nodiscard]] double largest_distance(Series values, const hal::Vec3& from) noexcept;

/// How far x rises above its end (the mean of its last tenth), as a share of the rise from its first row to its end.
/// Never below 0; NaN if x does not rise.
[[nodiscard]] double overshoot(std::span<const double> x) noexcept;
/// How far `x` rises above the highest `above`, as a share of the rise of `above`. Never below 0; NaN if `above` does not rise.
[[nodiscard]] double overshoot_above(std::span<const double> x, std::span<const double> above) noexcept;

}  // namespace tandem::netsim
