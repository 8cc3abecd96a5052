#pragma once

/// Inverse distribution functions and the transcendental functions they need. No other file of the engine uses the C
/// math library; a replacement here would make results equal on every platform. All functions are total: `open_unit`
/// maps u into (0, 1), and results are finite.
namespace tandem::netsim {

/// Maps [0, 1) to (0, 1) by taking the middle of the 2^-53 wide cell, so that u is never 0.
[[nodiscard]] constexpr double open_unit(double u) noexcept { return u + 0x1.0p-54; }

/// Returns e^x.
[[nodiscard]] double natural_exp(double x) noexcept;

/// Returns ln(1 + x).
[[nodiscard]] double natural_log1p(double x) noexcept;

/// Returns z with P(N(0,1) <= z) = u. Relative error below 1e-15.
/// Source [Wichura 1988]: algorithm AS 241, PPND16, Applied Statistics 37(3).
[[nodiscard]] double normal_quantile(double u) noexcept;

/// Returns P(N(0,1) <= z).
[[nodiscard]] double normal_cdf(double z) noexcept;

/// Quantile of the exponential distribution with mean 1: -ln(1 - u).
[[nodiscard]] double exponential_quantile(double u) noexcept;

/// Quantile of the Pareto distribution with scale 1: (1 - u)^(-1/alpha), at least 1.
[[nodiscard]] double pareto_quantile(double u, double alpha) noexcept;

/// Log-normal value with median 1 at the normal quantile z: exp(shape z).
[[nodiscard]] double log_normal_at(double z, double shape) noexcept;

/// Log-logistic value with median 1 at the normal quantile z: (Phi(z) / Phi(-z))^(1/shape).
[[nodiscard]] double log_logistic_at(double z, double shape) noexcept;

/// The same as a function of u: (u / (1 - u))^(1/shape).
[[nodiscard]] double log_logistic_quantile(double u, double shape) noexcept;

}  // namespace tandem::netsim
