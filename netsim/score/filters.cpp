#include "netsim/score/filters.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tandem::netsim::score {
namespace {

/// Coefficients of a Butterworth low-pass of order 2 by the bilinear transform.
struct Biquad {
  double b0 = 1, b1 = 0, b2 = 0, a1 = 0, a2 = 0;

  Biquad(double cutoff_hz, double rate_hz) {
    const double w = std::tan(std::numbers::pi * cutoff_hz / rate_hz);
    const double scale = 1 / (1 + std::numbers::sqrt2 * w + w * w);
    b0 = w * w * scale;
    b1 = 2 * b0;
    b2 = b0;
    a1 = 2 * (w * w - 1) * scale;
    a2 = (1 - std::numbers::sqrt2 * w + w * w) * scale;
  }

  /// Filters in place. The state begins as after an endless constant input of the first value.
  template <class Iterator>
  void run(Iterator begin, const Iterator& end) const {
    if (begin == end) return;
    double s2 = (b2 - a2) * *begin, s1 = (b1 - a1) * *begin + s2;
    for (; begin != end; ++begin) {
      const double in = *begin, out = b0 * in + s1;
      s1 = b1 * in - a1 * out + s2;
      s2 = b2 * in - a2 * out;
      *begin = out;
    }
  }
};

constexpr double kSamplesPerCutoffMin = 2.5;
constexpr double kReflectedPeriods = 2;  // of the cut-off frequency, at either end

template <class Value>
Value difference(const Value& a, const Value& b, double scale) {
  if constexpr (std::is_same_v<Value, double>) {
    return (a - b) * scale;
  } else {
    Value out{};
    for (std::size_t c = 0; c < out.size(); ++c) out[c] = (a[c] - b[c]) * scale;
    return out;
  }
}

template <class Value>
std::vector<Value> central_differences(std::span<const Value> signal, double rate_hz) {
  const std::size_t n = signal.size();
  std::vector<Value> out(n);
  if (n < 2) return out;
  for (std::size_t k = 1; k + 1 < n; ++k) out[k] = difference(signal[k + 1], signal[k - 1], rate_hz / 2);
  out[0] = difference(signal[1], signal[0], rate_hz);
  out[n - 1] = difference(signal[n - 1], signal[n - 2], rate_hz);
  return out;
}

}  // namespace

void low_pass(std::span<double> signal, double cutoff_hz, double rate_hz) {
  const std::size_t n = signal.size();
  if (n < 4 || rate_hz < kSamplesPerCutoffMin * cutoff_hz) return;
  // Two passes lower the cut-off; this factor raises it before.
  const double corrected = cutoff_hz / std::pow(std::numbers::sqrt2 - 1, 0.25);
  const Biquad filter(std::min(corrected, 0.49 * rate_hz), rate_hz);
  const std::size_t pad = std::min(n - 1, static_cast<std::size_t>(std::ceil(kReflectedPeriods * rate_hz / cutoff_hz)));
  std::vector<double> wide(n + 2 * pad);
  for (std::size_t k = 0; k < pad; ++k) {
    wide[k] = 2 * signal[0] - signal[pad - k];
    wide[pad + n + k] = 2 * signal[n - 1] - signal[n - 2 - k];
  }
  std::ranges::copy(signal, wide.begin() + static_cast<std::ptrdiff_t>(pad));
  filter.run(wide.begin(), wide.end());
  filter.run(wide.rbegin(), wide.rend());
  std::copy_n(wide.begin() + static_cast<std::ptrdiff_t>(pad), n, signal.begin());
}

void low_pass(std::span<LessonTriple> signal, double cutoff_hz, double rate_hz) {
  std::vector<double> component(signal.size());
  for (std::size_t c = 0; c < 3; ++c) {
    for (std::size_t k = 0; k < signal.size(); ++k) component[k] = signal[k][c];
    low_pass(component, cutoff_hz, rate_hz);
    for (std::size_t k = 0; k < signal.size(); ++k) signal[k][c] = component[k];
  }
}

std::vector<LessonTriple> derivative(std::span<const LessonTriple> signal, double rate_hz) {
  return central_differences(signal, rate_hz);
}

std::vector<double> derivative(std::span<const double> signal, double rate_hz) {
  return central_differences(signal, rate_hz);
}

std::vector<double> squared_jerk(std::span<const LessonTriple> position, double rate_hz) {
  if (position.size() < 5) return {};
  std::vector<double> out(position.size() - 4);
  const double scale = rate_hz * rate_hz * rate_hz / 2;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const auto* x = &position[k];
    for (std::size_t c = 0; c < 3; ++c) {
      const double jerk = (x[4][c] - 2 * x[3][c] + 2 * x[1][c] - x[0][c]) * scale;
      out[k] += jerk * jerk;
    }
  }
  return out;
}

}  // namespace tandem::netsim::score
