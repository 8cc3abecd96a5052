#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

/// Tests of hypotheses for the simulator's own tests. Each gives the probability p of a result at least as bad when the
/// hypothesis is true; a test of the matrix fails below kAlpha, so that 10,000 of them together fail wrongly once in 100 runs.
namespace tandem::netsim::test {

inline constexpr double kAlpha = 1e-6;

/// Kolmogorov-Smirnov. @param samples  sorted here @param cdf  of a sample
[[nodiscard]] double ks_p(std::span<double> samples, const std::function<double(double)>& cdf);

/// Anderson-Darling against a distribution known in full: sees the tails that KS does not.
/// Asymptotic upper tail sqrt(3) P(chi2_1 > 2 A2), within 10 % for p < 0.01 and conservative above.
[[nodiscard]] double anderson_darling_p(std::span<double> samples, const std::function<double(double)>& cdf);

/// Chi-square of counts against shares that add up to 1; classes that expect fewer than 10 are put together with the next.
/// @param free_numbers  how many numbers of the shares were estimated from the counts
[[nodiscard]] double chi_square_p(std::span<const double> seen, std::span<const double> shares, int free_numbers = 0);

/// Exact binomial, two-sided: twice the smaller tail.
[[nodiscard]] double binomial_p(std::uint64_t k, std::uint64_t n, double p);

/// Two-sided, of a standard normal.
[[nodiscard]] double normal_p(double z);

/// Autocorrelation at a lag, about the sample's own mean.
[[nodiscard]] double autocorrelation(std::span<const double> x, std::size_t lag);

/// Pearson's.
[[nodiscard]] double correlation(std::span<const double> x, std::span<const double> y);

/// Every value replaced by the normal quantile of its rank; equal values share their middle rank.
[[nodiscard]] std::vector<double> rank_gaussian(std::span<const double> x);

/// The value that a share q of the sample is not above; sorts nothing but reorders.
[[nodiscard]] double quantile_of(std::vector<double>& samples, double q);

/// Shares of a geometric distribution of mean 1 / r: lengths 1, 2, ... kinds - 1, and all longer ones.
[[nodiscard]] std::vector<double> geometric_shares(double r, std::size_t kinds);

/// How many runs of `value` have length 1, 2, ..., the last entry counts all longer ones. Runs at both ends are left out.
[[nodiscard]] std::vector<double> run_lengths(const std::vector<bool>& bits, bool value, std::size_t kinds);

}  // namespace tandem::netsim::test
