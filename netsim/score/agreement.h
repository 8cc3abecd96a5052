#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <string>
#include <vector>

/// Agreement of evaluators. Pure functions.
namespace tandem::netsim::score {

/// An intraclass correlation with its confidence interval.
struct Correlation {
  double value = 0, low = 0, high = 0;
};

/// Two-way random effects, absolute agreement: targets and evaluators are samples of larger sets.
struct IntraclassCorrelation {
  Correlation single;  ///< ICC(2,1): of one evaluator's rating
  Correlation mean;    ///< ICC(2,k): of the mean of all evaluators
  std::size_t targets = 0, evaluators = 0;
  double confidence = 0.95;
};

/// Source [Shrout & Fleiss 1979]: "Intraclass correlations: uses in assessing rater reliability", Psychological
/// Bulletin 86(2), case 2, with its confidence interval by Satterthwaite's degrees of freedom; the interval of the mean
/// by the Spearman-Brown formula.
/// @param ratings     [target][evaluator], complete
/// @param confidence  in (0, 1)
/// Error: fewer than two targets or evaluators, rows of different length, a rating that is not finite, no variance.
[[nodiscard]] std::expected<IntraclassCorrelation, std::string> intraclass_correlation(
    const std::vector<std::vector<double>>& ratings, double confidence = 0.95);

/// Agreement beyond chance [-1, 1], and the share of equal judgements [0, 1].
struct Kappa {
  double kappa = 0, agreement = 0;
  std::size_t subjects = 0, evaluators = 0;
};

/// Source [Cohen 1960]: "A coefficient of agreement for nominal scales", Educ. and Psychol. Measurement 20(1).
/// @param table  [category of evaluator 1][category of evaluator 2]: counts or shares, square
/// Error: not square, a negative count, no count, or both evaluators always chose one same category.
[[nodiscard]] std::expected<Kappa, std::string> cohen_kappa(const std::vector<std::vector<double>>& table);

/// Source [Fleiss 1971]: "Measuring nominal scale agreement among many raters", Psychological Bulletin 76(5).
/// @param counts  [subject][category]: evaluators who chose it; every row has the same sum of at least two
/// Error: rows of different length or sum, or all judgements in one category.
[[nodiscard]] std::expected<Kappa, std::string> fleiss_kappa(const std::vector<std::vector<double>>& counts);

}  // namespace tandem::netsim::score
