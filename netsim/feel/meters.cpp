#include "netsim/feel/meters.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace tandem::netsim {
namespace {

constexpr std::size_t kSlopeRowsMin = 50, kWaveRowsMin = 8;

/// One axis without its straight line, times a Hann window; and the window's mean square.
struct Windowed {
  std::vector<double> x;
  double window_square = 0;
};
Windowed windowed(Series values, Eigen::Index axis) {
  const std::size_t n = values.size();
  const double middle = 0.5 * static_cast<double>(n - 1);
  double sum = 0, product = 0, square = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double at = static_cast<double>(i) - middle;
    sum += values[i][axis];
    product += at * values[i][axis];
    square += at * at;
  }
  const double level = sum / static_cast<double>(n), rise = product / square;
  Windowed out;
  out.x.resize(n);
  for (std::size_t i = 0; i < n; ++i) {
    const double w =
        0.5 - 0.5 * std::cos(2 * std::numbers::pi * (static_cast<double>(i) + 0.5) / static_cast<double>(n));
    out.x[i] = w * (values[i][axis] - level - rise * (static_cast<double>(i) - middle));
    out.window_square += w * w;
  }
  return out;
}

constexpr std::size_t kTenth = 10;
double end_of(std::span<const double> x) noexcept { return mean(x.last(x.size() / kTenth)); }

}  // namespace

double mean(std::span<const double> values) noexcept {
  if (values.empty()) return kNaN;
  double sum = 0;
  for (const double v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

hal::Vec3 mean(Series values) noexcept {
  if (values.empty()) return hal::Vec3::Constant(kNaN);
  hal::Vec3 sum = hal::Vec3::Zero();
  for (const hal::Vec3& v : values) sum += v;
  return sum / static_cast<double>(values.size());
}

std::vector<double> along_x(Series values) {
  std::vector<double> out;
  for (const hal::Vec3& v : values) out.push_back(v.x());
  return out;
}

double larger(double a, double b) noexcept { return std::isnan(a) || std::isnan(b) ? kNaN : std::max(a, b); }

double rms(Series values) noexcept {
  if (values.empty()) return kNaN;
  double sum = 0;
  for (const hal::Vec3& v : values) sum += v.squaredNorm();
  return std::sqrt(sum / static_cast<double>(values.size()));
}

double rms_difference(Series a, Series b) noexcept {
  const std::size_t n = std::min(a.size(), b.size());
  if (n == 0) return kNaN;
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) sum += (a[i] - b[i]).squaredNorm();
  return std::sqrt(sum / static_cast<double>(n));
}

double rms_lag(Series values, std::size_t rows) noexcept {
  if (values.size() <= rows) return kNaN;
  return rms_difference(values.subspan(rows), values.first(values.size() - rows));
}

double slope(std::span<const double> x, std::span<const double> y, double low, double high) noexcept {
  double n = 0, sx = 0, sy = 0;
  const std::size_t rows = std::min(x.size(), y.size());
  const auto within = [&](std::size_t i) { return y[i] >= low && y[i] <= high; };
  for (std::size_t i = 0; i < rows; ++i) {
    if (!within(i)) continue;
    n += 1;
    sx += x[i];
    sy += y[i];
  }
  if (n < kSlopeRowsMin) return kNaN;
  double xx = 0, xy = 0;
  for (std::size_t i = 0; i < rows; ++i) {
    if (!within(i)) continue;
    xx += (x[i] - sx / n) * (x[i] - sx / n);
    xy += (x[i] - sx / n) * (y[i] - sy / n);
  }
  return xx > 0 ? xy / xx : kNaN;
}

std::complex<double> harmonic(std::span<const double> t, std::span<const double> x, double hz) noexcept {
  const std::size_t n = std::min(t.size(), x.size());
  if (n < kWaveRowsMin) return {kNaN, kNaN};
  Eigen::Matrix3d squares = Eigen::Matrix3d::Zero();
  Eigen::Vector3d right = Eigen::Vector3d::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const double phase = 2 * std::numbers::pi * hz * (t[i] - t[0]);
    const Eigen::Vector3d row{std::cos(phase), std::sin(phase), 1.0};
    squares += row * row.transpose();
    right += x[i] * row;
  }
  const Eigen::Vector3d c = squares.ldlt().solve(right);
  return {c[0], -c[1]};
}

double rms_above(Series values, double hz, double rate) noexcept {
  const std::size_t n = values.size();
  if (n < kWaveRowsMin) return kNaN;
  const double length = static_cast<double>(n) / rate;
  // Parseval's theorem: the total power minus the lines of the spectrum below `hz`.
  const auto lines = std::min(static_cast<std::size_t>(std::ceil(hz * length)), n / 2);
  double power = 0;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const Windowed w = windowed(values, axis);
    double all = 0, low = 0;
    for (const double x : w.x) all += x * x;
    for (std::size_t k = 0; k < lines; ++k) {
      const std::complex<double> turn =
          std::polar(1.0, -2 * std::numbers::pi * static_cast<double>(k) / static_cast<double>(n));
      std::complex<double> sum = 0, at = 1;
      for (const double x : w.x) {
        sum += x * at;
        at *= turn;
      }
      low += (k == 0 ? 1.0 : 2.0) * std::norm(sum) / static_cast<double>(n);
    }
    power += std::max(0.0, all - low) / w.window_square;
  }
  return std::sqrt(power);
}

double largest_step_per_ms(Series values, double rate) noexcept {
  const auto rows = std::max<std::size_t>(1, static_cast<std::size_t>(std::llround(rate * 1e-3)));
  if (values.size() <= rows) return kNaN;
  double largest = 0;
  for (std::size_t i = rows; i < values.size(); ++i) largest = std::max(largest, (values[i] - values[i - rows]).norm());
  return largest / (static_cast<double>(rows) / rate * 1e3);
}

double largest_distance(Series values, const hal::Vec3& from) noexcept {
  if (values.empty()) return kNaN;
  double largest = 0;
  for (const hal::Vec3& v : values) largest = std::max(largest, (v - from).norm());
  return largest;
}

double overshoot(std::span<const double> x) noexcept {
  if (x.size() < kTenth) return kNaN;
  const double end = end_of(x), rise = end - x.front();
  return rise > 0 ? std::max(0.0, *std::ranges::max_element(x) - end) / rise : kNaN;
}

double overshoot_above(std::span<const double> x, std::span<const double> above) noexcept {
  if (above.size() < kTenth || x.empty()) return kNaN;
  const double rise = end_of(above) - above.front();
  return rise > 0 ? std::max(0.0, *std::ranges::max_element(x) - *std::ranges::max_element(above)) / rise : kNaN;
}

}  // namespace tandem::netsim
