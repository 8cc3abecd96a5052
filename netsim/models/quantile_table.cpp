#include "netsim/models/quantile_table.h"

#include <algorithm>
#include <cmath>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

constexpr double kEnd = 8.25;
constexpr double kPerUnit = 64;
constexpr int kTermsMax = 1000;

double gamma_series(double a, double x) noexcept {
  double term = 1 / a, sum = term;
  for (int n = 1; n < kTermsMax && term > sum * 1e-16; ++n) {
    term *= x / (a + n);
    sum += term;
  }
  return sum * std::exp(a * std::log(x) - x - std::lgamma(a));
}

double gamma_fraction(double a, double x) noexcept {
  constexpr double kTiny = 1e-300;
  double b = x + 1 - a, c = 1 / kTiny, d = 1 / b, h = d;
  for (int i = 1; i < kTermsMax; ++i) {
    const double an = -i * (i - a);
    b += 2;
    d = an * d + b;
    if (std::abs(d) < kTiny) d = kTiny;
    c = b + an / c;
    if (std::abs(c) < kTiny) c = kTiny;
    d = 1 / d;
    h *= d * c;
    if (std::abs(d * c - 1) < 1e-15) break;
  }
  return h * std::exp(a * std::log(x) - x - std::lgamma(a));
}

/// Returns P(X <= x) below the median and P(X > x) above it, so that each tail is computed from its own side.
double probability(const BodySpec& spec, double x, bool above) noexcept {
  if (spec.kind == BodySpec::Kind::kGamma) {
    const double scaled = x / static_cast<double>(spec.scale.count());
    return above ? gamma_q(spec.shape, scaled) : gamma_p(spec.shape, scaled);
  }
  double sum = 0, weights = 0;
  for (const HyperPhase& phase : spec.phases) {
    const double rest = natural_exp(-x / static_cast<double>(phase.mean.count()));
    sum += phase.weight * (above ? rest : 1 - rest);
    weights += phase.weight;
  }
  return sum / weights;
}

}  // namespace

double gamma_p(double a, double x) noexcept {
  if (!(x > 0)) return 0;
  return x < a + 1 ? gamma_series(a, x) : 1 - gamma_fraction(a, x);
}

double gamma_q(double a, double x) noexcept {
  if (!(x > 0)) return 1;
  return x < a + 1 ? 1 - gamma_series(a, x) : gamma_fraction(a, x);
}

QuantileTable::QuantileTable(const BodySpec& spec) {
  const double cap = static_cast<double>(spec.cap.count());
  for (double z = -kEnd; z <= kEnd; z += 1 / kPerUnit) {
    const bool above = z > 0;
    const double wanted = normal_cdf(above ? -z : z);
    double lo = 0, hi = cap;
    for (int step = 0; step < 50; ++step) {
      const double middle = 0.5 * (lo + hi);
      const double p = probability(spec, middle, above);
      (above ? p > wanted : p < wanted) ? lo = middle : hi = middle;
    }
    values_.push_back(hi);
  }
}

double QuantileTable::at(double z) const noexcept {
  const double place = std::clamp((z + kEnd) * kPerUnit, 0.0, static_cast<double>(values_.size() - 1));
  const auto left = std::min(static_cast<std::size_t>(place), values_.size() - 2);
  const double w = place - static_cast<double>(left);
  return values_[left] + w * (values_[left + 1] - values_[left]);
}

}  // namespace tandem::netsim
