#pragma once

/// Inverse distribution functions and the transcendental functions under them. The only file of the engine that uses
/// the C math library, so that one day it can be replaced by our own for results equal on every platform.
/// All are total: u is clamped into (0, 1) by `open_unit`, results are finite.
namespace tandem::netsim {

/// [0, 1) to (0, 1): the middle of the 2^-53 wide cell, so that 0 is never asked for.
[[nodiscard]] constexpr double open_unit(double u) noexcept { return u + 0x1.0p-54; }

[[nodiscard]] double natural_exp(double x) noexcept;

/// ln(1 + x).
[[nodiscard]] double natural_log1p(double x) noexcept;

/// z with P(N(0,1) <= z) = u. Relative error below 1e-15.
/// Source [Wichura 1988]: algorithm AS 241, PPND16, Applied Statistics 37(3).
[[nodiscard]] double normal_quantile(double u) noexcept;

/// P(N(0,1) <= z).
[[nodiscard]] double normal_cdf(double z) noexcept;

/// Exponential of mean 1: -ln(1 - u).
[[nodiscard]] double exponential_quantile(double u) noexcept;

/// Pareto of scale 1: (1 - u)^(-1/alpha), at least 1.
[[nodiscard]] double pareto_quantile(double u, double alpha) noexcept;

/// Log-normal of median 1 at the normal quantile z: exp(shape z).
[[nodiscard]] double log_normal_at(double z, double shape) noexcept;

/// Log-logistic of median 1 at the normal quantile z: (Phi(z) / Phi(-z))^(1/shape).
[[nodiscard]] double log_logistic_at(double z, double shape) noexcept;

/// The same from u: (u / (1 - u))^(1/shape).
[[nodiscard]] double log_logistic_quantile(double u, double shape) noexcept;

}  // namespace tandem::netsim
