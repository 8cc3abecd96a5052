#include "netsim/models/distributions.h"

#include <cmath>

namespace tandem::netsim {
namespace {

/// Polynomial in Horner form; the highest power comes first.
template <typename... Rest>
constexpr double polynomial(double x, double first, Rest... rest) noexcept {
  double sum = first;
  ((sum = sum * x + rest), ...);
  return sum;
}

}  // namespace

double natural_exp(double x) noexcept { return std::exp(x); }

double natural_log1p(double x) noexcept { return std::log1p(x); }

double normal_quantile(double u) noexcept {
  const double q = u - 0.5;
  if (std::abs(q) <= 0.425) {
    const double r = 0.180625 - q * q;
    return q *
           polynomial(r, 2509.0809287301226727, 33430.575583588128105, 67265.770927008700853, 45921.953931549871457,
                      13731.693765509461125, 1971.5909503065514427, 133.14166789178437745, 3.387132872796366608) /
           polynomial(r, 5226.495278852545925, 28729.085735721942674, 39307.89580009271061, 21213.794301586595867,
                      5394.1960214247511077, 687.1870074920579083, 42.313330701600911252, 1.0);
  }
  const double tail = q < 0 ? u : 1.0 - u;
  const double r = std::sqrt(-std::log(tail > 0 ? tail : 0x1.0p-1000));
  double z = 0;
  if (r <= 5.0) {
    const double s = r - 1.6;
    z = polynomial(s, 7.7454501427834140764e-4, 0.0227238449892691845833, 0.24178072517745061177,
                   1.27045825245236838258, 3.64784832476320460504, 5.7694972214606914055, 4.6303378461565452959,
                   1.42343711074968357734) /
        polynomial(s, 1.05075007164441684324e-9, 5.475938084995344946e-4, 0.0151986665636164571966,
                   0.14810397642748007459, 0.68976733498510000455, 1.6763848301838038494, 2.05319162663775882187, 1.0);
  } else {
    const double s = r - 5.0;
    z = polynomial(s, 2.01033439929228813265e-7, 2.71155556874348757815e-5, 0.0012426609473880784386,
                   0.026532189526576123093, 0.29656057182850489123, 1.7848265399172913358, 5.4637849111641143699,
                   6.6579046435011037772) /
        polynomial(s, 2.04426310338993978564e-15, 1.4215117583164458887e-7, 1.8463183175100546818e-5,
                   7.868691311456132591e-4, 0.0148753612908506148525, 0.13692988092273580531, 0.59983220655588793769,
                   1.0);
  }
  return q < 0 ? -z : z;
}

double normal_cdf(double z) noexcept { return 0.5 * std::erfc(-z * 0.70710678118654752440); }

double exponential_quantile(double u) noexcept { return -std::log1p(-u); }

double pareto_quantile(double u, double alpha) noexcept { return std::exp(exponential_quantile(u) / alpha); }

double log_normal_at(double z, double shape) noexcept { return std::exp(shape * z); }

double log_logistic_at(double z, double shape) noexcept {
  // Each tail is computed from its own side, because 1 - Phi(z) loses all digits above z = 8.
  return std::exp((std::log(normal_cdf(z)) - std::log(normal_cdf(-z))) / shape);
}

double log_logistic_quantile(double u, double shape) noexcept {
  return std::exp((std::log(u) - std::log1p(-u)) / shape);
}

}  // namespace tandem::netsim
