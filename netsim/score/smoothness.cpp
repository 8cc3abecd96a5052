#include "netsim/score/smoothness.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <unsupported/Eigen/FFT>
#include <vector>

#include "netsim/score/triple.h"

namespace tandem::netsim::score {
namespace {

/// Returns the magnitudes at frequencies 0 to rate / 2 of the signal, continued with zeros to `points` (a power of 2).
std::vector<double> amplitudes(std::span<const double> signal, std::size_t points) {
  std::vector<double> padded(points);
  std::ranges::copy(signal, padded.begin());
  Eigen::FFT<double> transform;
  transform.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  std::vector<std::complex<double>> spectrum;
  transform.fwd(spectrum, padded);
  std::vector<double> out(spectrum.size());
  std::ranges::transform(spectrum, out.begin(), [](const std::complex<double>& c) { return std::abs(c); });
  return out;
}

std::size_t power_of_two_from(std::size_t n) {
  std::size_t points = 1;
  while (points < n) points *= 2;
  return points;
}

bool all_finite(std::span<const double> values) {
  return std::ranges::all_of(values, [](double v) { return std::isfinite(v); });
}

}  // namespace

double sparc(std::span<const double> speed, double rate_hz, const SparcOptions& options) {
  if (speed.size() < 4 || !all_finite(speed)) return kUnknown;
  const std::size_t points = power_of_two_from(speed.size()) << options.padding;
  std::vector<double> spectrum = amplitudes(speed, points);
  const double largest = std::ranges::max(spectrum), step = rate_hz / static_cast<double>(points);
  if (!(largest > 0)) return kUnknown;
  const auto within = static_cast<std::size_t>(std::floor(options.cutoff_hz / step * (1 + 1e-12))) + 1;
  spectrum.resize(std::min(within, spectrum.size()));
  for (double& m : spectrum) m /= largest;
  const auto strong = [&](double m) { return m >= options.amplitude; };
  const auto first = std::ranges::find_if(spectrum, strong);
  const auto last = std::find_if(spectrum.rbegin(), spectrum.rend(), strong).base();
  if (first >= last || last - first < 2) return kUnknown;
  const double share = 1 / static_cast<double>(last - first - 1);  // df / (f_last - f_first)
  double arc = 0;
  for (auto m = first + 1; m != last; ++m) arc += std::hypot(share, *m - *(m - 1));
  return -arc;
}

double dimensionless_jerk(std::span<const double> speed, double rate_hz) {
  if (speed.size() < 3 || !all_finite(speed)) return kUnknown;
  double peak = 0, sum = 0;
  for (const double s : speed) peak = std::max(peak, std::abs(s));
  if (!(peak > 0)) return kUnknown;
  for (std::size_t k = 0; k + 2 < speed.size(); ++k) {
    const double second = (speed[k + 2] - 2 * speed[k + 1] + speed[k]) * rate_hz * rate_hz;
    sum += second * second;
  }
  const double time = static_cast<double>(speed.size()) / rate_hz;
  return -time * time * time / (peak * peak) * sum / rate_hz;
}

double log_dimensionless_jerk(std::span<const double> speed, double rate_hz) {
  const double jerk = dimensionless_jerk(speed, rate_hz);
  return jerk < 0 ? -std::log(-jerk) : kUnknown;
}

double motion_frequency_95(std::span<const double> speed, double rate_hz) {
  if (speed.size() < 4 || !all_finite(speed)) return kUnknown;
  double mean = 0;
  for (const double s : speed) mean += s / static_cast<double>(speed.size());
  std::vector<double> deviation(speed.begin(), speed.end());
  for (double& d : deviation) d -= mean;
  const std::size_t points = power_of_two_from(speed.size());
  const std::vector<double> spectrum = amplitudes(deviation, points);
  double power = 0;
  for (const double m : spectrum) power += m * m;
  // A constant leaves only the rounding errors of its mean.
  if (!(power > 1e-20 * mean * mean * static_cast<double>(points))) return kUnknown;
  double sum = 0;
  for (std::size_t k = 0; k < spectrum.size(); ++k) {
    sum += spectrum[k] * spectrum[k];
    if (sum >= 0.95 * power) return static_cast<double>(k) * rate_hz / static_cast<double>(points);
  }
  return rate_hz / 2;
}

}  // namespace tandem::netsim::score
