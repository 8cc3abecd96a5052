#include "tests/netsim/validation/statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "netsim/models/distributions.h"
#include "netsim/models/quantile_table.h"

namespace tandem::netsim::test {
namespace {

/// Regularized incomplete beta function I_x(a, b), by the continued fraction 26.5.8 of Abramowitz and Stegun; modified
/// Lentz.
double beta_i(double a, double b, double x) {
  if (x <= 0) return 0;
  if (x >= 1) return 1;
  if (x > (a + 1) / (a + b + 2)) return 1 - beta_i(b, a, 1 - x);
  constexpr double kTiny = 1e-300;
  double c = 1, d = 1 - (a + b) * x / (a + 1);
  d = 1 / (std::abs(d) < kTiny ? kTiny : d);
  double h = d;
  for (int m = 1; m < 100'000; ++m) {
    const double even = m * (b - m) * x / ((a + 2 * m - 1) * (a + 2 * m));
    const double odd = -(a + m) * (a + b + m) * x / ((a + 2 * m) * (a + 2 * m + 1));
    double factor = 1;
    for (const double term : {even, odd}) {
      d = 1 + term * d;
      d = 1 / (std::abs(d) < kTiny ? kTiny : d);
      c = 1 + term / c;
      if (std::abs(c) < kTiny) c = kTiny;
      factor = c * d;
      h *= factor;
    }
    if (std::abs(factor - 1) < 1e-14) break;
  }
  const double front =
      std::exp(std::lgamma(a + b) - std::lgamma(a) - std::lgamma(b) + a * std::log(x) + b * std::log1p(-x));
  return std::min(1.0, front * h / a);
}

}  // namespace

double normal_p(double z) { return std::erfc(std::abs(z) / std::sqrt(2.0)); }

double ks_p(std::span<double> samples, const std::function<double(double)>& cdf) {
  std::ranges::sort(samples);
  const double n = static_cast<double>(samples.size());
  double worst = 0;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const double f = cdf(samples[i]);
    const double below = static_cast<double>(i) / n;
    worst = std::max({worst, f - below, below + 1 / n - f});
  }
  const double x = worst * (std::sqrt(n) + 0.12 + 0.11 / std::sqrt(n));  // Stephens 1970
  return std::min(1.0, 2 * std::exp(-2 * x * x));
}

double anderson_darling_p(std::span<double> samples, const std::function<double(double)>& cdf) {
  std::ranges::sort(samples);
  const std::size_t n = samples.size();
  double sum = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double f = std::clamp(cdf(samples[i]), 1e-300, 1 - 0x1.0p-53);
    // Factors (2i + 1) of ln F, by the rank from below, and (2 (n - 1 - i) + 1) of ln (1 - F), by the rank from above.
    sum += (2 * static_cast<double>(i) + 1) * std::log(f);
    sum += (2 * static_cast<double>(n - 1 - i) + 1) * std::log1p(-f);
  }
  const double a2 = -static_cast<double>(n) - sum / static_cast<double>(n);
  return std::min(1.0, std::sqrt(3.0) * std::erfc(std::sqrt(std::max(0.0, a2))));
}

double chi_square_p(std::span<const double> seen, std::span<const double> shares, int free_numbers) {
  const double n = std::accumulate(seen.begin(), seen.end(), 0.0);
  double sum = 0, expected = 0, counted = 0;
  int classes = 0;
  double last_expected = 0, last_counted = 0, last_part = 0;
  const auto close = [&] {
    last_part = (counted - expected) * (counted - expected) / expected;
    last_expected = expected;
    last_counted = counted;
    sum += last_part;
    ++classes;
    expected = counted = 0;
  };
  for (std::size_t i = 0; i < seen.size(); ++i) {
    expected += n * shares[i];
    counted += seen[i];
    if (expected >= 10) close();
  }
  if (expected > 0 && classes > 0) {  // the remainder joins the last class
    sum -= last_part;
    --classes;
    expected += last_expected;
    counted += last_counted;
    close();
  }
  const int freedom = classes - 1 - free_numbers;
  return freedom < 1 ? 0 : gamma_q(freedom / 2.0, sum / 2);
}

double binomial_p(std::uint64_t k, std::uint64_t n, double p) {
  const double below = k == n ? 1 : beta_i(static_cast<double>(n - k), static_cast<double>(k) + 1, 1 - p);  // P(X <= k)
  const double above = k == 0 ? 1 : beta_i(static_cast<double>(k), static_cast<double>(n - k) + 1, p);      // P(X >= k)
  return std::min(1.0, 2 * std::min(below, above));
}

double correlation(std::span<const double> x, std::span<const double> y) {
  const double n = static_cast<double>(x.size());
  const double mx = std::accumulate(x.begin(), x.end(), 0.0) / n, my = std::accumulate(y.begin(), y.end(), 0.0) / n;
  double xy = 0, xx = 0, yy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mx) * (y[i] - my);
    xx += (x[i] - mx) * (x[i] - mx);
    yy += (y[i] - my) * (y[i] - my);
  }
  return xy / std::sqrt(xx * yy);
}

double autocorrelation(std::span<const double> x, std::size_t lag) {
  const double n = static_cast<double>(x.size());
  const double mean = std::accumulate(x.begin(), x.end(), 0.0) / n;
  double products = 0, squares = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    squares += (x[i] - mean) * (x[i] - mean);
    if (i + lag < x.size()) products += (x[i] - mean) * (x[i + lag] - mean);
  }
  return products / squares * n / (n - static_cast<double>(lag));
}

std::vector<double> rank_gaussian(std::span<const double> x) {
  std::vector<std::size_t> order(x.size());
  std::iota(order.begin(), order.end(), 0U);
  std::ranges::sort(order, [&](std::size_t a, std::size_t b) { return x[a] < x[b]; });
  std::vector<double> z(x.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && x[order[end]] == x[order[i]]) ++end;
    const double middle = static_cast<double>(i + end) / 2;
    const double value = normal_quantile(middle / static_cast<double>(x.size()));
    for (; i < end; ++i) z[order[i]] = value;
  }
  return z;
}

double quantile_of(std::vector<double>& samples, double q) {
  const auto nth = samples.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(samples.size() - 1));
  std::nth_element(samples.begin(), nth, samples.end());
  return *nth;
}

std::vector<double> geometric_shares(double r, std::size_t kinds) {
  std::vector<double> shares;
  double rest = 1;
  for (std::size_t k = 1; k < kinds; ++k, rest *= 1 - r) shares.push_back(rest * r);
  shares.push_back(rest);
  return shares;
}

std::vector<double> run_lengths(const std::vector<bool>& bits, bool value, std::size_t kinds) {
  std::vector<double> runs(kinds);
  std::size_t run = 0;
  bool begun = false;  // true after the first change: the run has a beginning
  for (std::size_t i = 0; i < bits.size(); ++i) {
    if (bits[i] == value) {
      ++run;
      continue;
    }
    if (run > 0 && begun) ++runs[std::min(run, kinds) - 1];
    run = 0;
    begun = true;
  }
  return runs;
}

}  // namespace tandem::netsim::test
