#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Hypothesis tests for the simulator's own tests. Each returns the probability p of a result at least as extreme if
/// the hypothesis is true. A test of the matrix fails below kAlpha, so that 10,000 of them together fail wrongly once
/// in 100 runs.
namespace tandem::netsim::test {

inline constexpr double kAlpha = 1e-6;

/// Kolmogorov-Smirnov test.
/// @param samples  sorted by this function
/// @param cdf      distribution function of a sample
[[nodiscard]] double ks_p(std::span<double> samples, const std::function<double(double)>& cdf);

/// Anderson-Darling test against a fully specified distribution; more sensitive to tails than KS. Asymptotic upper tail
/// sqrt(3) P(chi2_1 > 2 A2), within 10 % for p < 0.01 and conservative above.
[[nodiscard]] double anderson_darling_p(std::span<double> samples, const std::function<double(double)>& cdf);

/// Chi-square test of counts against shares that sum to 1. Classes with an expected count below 10 are merged with the
/// next.
/// @param free_numbers  number of parameters of the shares that were estimated from the counts
[[nodiscard]] double chi_square_p(std::span<const double> seen, std::span<const double> shares, int free_numbers = 0);

/// Exact binomial test, two-sided: twice the smaller tail.
[[nodiscard]] double binomial_p(std::uint64_t k, std::uint64_t n, double p);

/// Two-sided test of a standard normal value.
[[nodiscard]] double normal_p(double z);

/// Returns the autocorrelation at a lag, about the sample mean.
[[nodiscard]] double autocorrelation(std::span<const double> x, std::size_t lag);

/// Returns Pearson's correlation.
[[nodiscard]] double correlation(std::span<const double> x, std::span<const double> y);

/// Returns the normal quantiles of the ranks; equal values share their mean rank.
[[nodiscard]] std::vector<double> rank_gaussian(std::span<const double> x);

/// Returns the value that a share q of the sample does not exceed. Reorders the samples without sorting them.
[[nodiscard]] double quantile_of(std::vector<double>& samples, double q);

/// Returns the shares of a geometric distribution with mean 1 / r: lengths 1, 2, ... kinds - 1, and all longer ones.
[[nodiscard]] std::vector<double> geometric_shares(double r, std::size_t kinds);

/// Returns the number of runs of `value` with length 1, 2, ...; the last entry counts all longer runs. Runs at both
/// ends are excluded.
[[nodiscard]] std::vector<double> run_lengths(const std::vector<bool>& bits, bool value, std::size_t kinds);

}  // namespace tandem::netsim::test
