#pragma once

#include <complex>
#include <cstddef>
#include <limits>
#include <span>
#include <vector>

#include "hal/core/device.h"

/// Numbers from columns of samples. The functions are pure: they use no scene and no session. A number that does not
/// exist is NaN.
namespace tandem::netsim {

inline constexpr double kNaN = std::numeric_limits<double>::quiet_NaN();

using Series = std::span<const hal::Vec3>;

[[nodiscard]] double mean(std::span<const double> values) noexcept;
[[nodiscard]] hal::Vec3 mean(Series values) noexcept;

/// Returns the x coordinates.
[[nodiscard]] std::vector<double> along_x(Series values);

/// Returns the larger number; NaN if either is NaN.
[[nodiscard]] double larger(double a, double b) noexcept;

/// Returns the root of the mean square of the norms.
[[nodiscard]] double rms(Series values) noexcept;
/// Returns the rms of a - b. @pre a and b have the same length
[[nodiscard]] double rms_difference(Series a, Series b) noexcept;
/// Returns the RMS distance between a point and its position `rows` rows earlier. NaN if there are not so many rows.
[[nodiscard]] double rms_lag(Series values, std::size_t rows) noexcept;

/// Returns the slope of y over x by least squares, over the rows with y in [low, high]. NaN below 50 rows or without
/// extent in x.
[[nodiscard]] double slope(std::span<const double> x, std::span<const double> y, double low, double high) noexcept;

/// Returns the complex amplitude of x(t) at frequency `hz` [Hz], by least squares of cosine, sine and a constant: x =
/// Re(amplitude exp(i 2 pi hz t)) + constant + rest. NaN below 8 rows.
[[nodiscard]] std::complex<double> harmonic(std::span<const double> t, std::span<const double> x, double hz) noexcept;

/// Returns the RMS of the part above `hz` [Hz]; the squares of the axes are added. A straight line is removed and a
/// Hann window is applied, so that a slow drift does not count. NaN below 8 rows.
/// @param rate  rows per second
[[nodiscard]] double rms_above(Series values, double hz, double rate) noexcept;

/// Returns the largest norm of a change within a millisecond [unit/ms]. Below 1 kHz it is the change of a row divided
/// by its length.
/// @param rate  rows per second
[[nodiscard]] double largest_step_per_ms(Series values, double rate) noexcept;

/// Returns the largest distance of a row from `from`.
[[nodiscard]] double largest_distance(Series values, const hal::Vec3& from) noexcept;

/// Returns how far x rises above its end (the mean of its last tenth), as a share of the rise from first row to end.
/// Never below 0; NaN if x does not rise.
[[nodiscard]] double overshoot(std::span<const double> x) noexcept;
/// Returns how far `x` rises above the maximum of `above`, as a share of the rise of `above`. Never below 0; NaN if
/// `above` does not rise.
[[nodiscard]] double overshoot_above(std::span<const double> x, std::span<const double> above) noexcept;

}  // namespace tandem::netsim
