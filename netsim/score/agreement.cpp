#include "netsim/score/agreement.h"

#include <algorithm>
#include <boost/math/distributions/fisher_f.hpp>
#include <cmath>
#include <limits>
#include <numeric>

namespace tandem::netsim::score {
namespace {

using Matrix = std::vector<std::vector<double>>;

/// Mean squares of a two-way analysis of variance.
struct MeanSquares {
  double rows = 0, columns = 0, error = 0;
};

MeanSquares mean_squares(const Matrix& ratings) {
  const std::size_t n = ratings.size(), k = ratings.front().size();
  const auto targets = static_cast<double>(n), judges = static_cast<double>(k);
  std::vector<double> row(n), column(k);
  double all = 0;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < k; ++j) {
      row[i] += ratings[i][j] / judges;
      column[j] += ratings[i][j] / targets;
      all += ratings[i][j] / (targets * judges);
    }
  MeanSquares out;
  for (std::size_t i = 0; i < n; ++i) {
    out.rows += judges * (row[i] - all) * (row[i] - all) / (targets - 1);
    for (std::size_t j = 0; j < k; ++j) {
      const double rest = ratings[i][j] - row[i] - column[j] + all;
      out.error += rest * rest / ((targets - 1) * (judges - 1));
    }
  }
  for (const double c : column) out.columns += targets * (c - all) * (c - all) / (judges - 1);
  return out;
}

double f_quantile(double share, double first, double second) {
  return boost::math::quantile(boost::math::fisher_f(first, second), share);
}

/// Reliability of the mean of k ratings from that of one.
double of_mean(double single, double k) { return k * single / (1 + (k - 1) * single); }

/// Sets the interval of ICC(2,1).
void set_interval(const MeanSquares& m, double n, double k, double confidence, Correlation& icc) {
  const double share = 1 - (1 - confidence) / 2, rho = icc.value;
  if (!(m.error > 0)) {  // the evaluators differ by constants only
    icc.low = icc.high = rho;
    return;
  }
  const double fj = m.columns / m.error, a = n * (1 + (k - 1) * rho) - k * rho;
  const double above = k * rho * fj + a;
  const double freedom = (k - 1) * (n - 1) * above * above / ((n - 1) * k * k * rho * rho * fj * fj + a * a);
  if (!(freedom > 0)) {
    icc.low = icc.high = std::numeric_limits<double>::quiet_NaN();
    return;
  }
  const double upper_f = f_quantile(share, n - 1, freedom), lower_f = f_quantile(share, freedom, n - 1);
  const double rest = k * m.columns + (k * n - k - n) * m.error;
  icc.low = n * (m.rows - upper_f * m.error) / (upper_f * rest + n * m.rows);
  icc.high = n * (lower_f * m.rows - m.error) / (rest + n * lower_f * m.rows);
}

}  // namespace

std::expected<IntraclassCorrelation, std::string> intraclass_correlation(const Matrix& ratings, double confidence) {
  if (ratings.size() < 2 || ratings.front().size() < 2)
    return std::unexpected("an intraclass correlation needs at least two rated lessons and two evaluators");
  for (const auto& row : ratings) {
    if (row.size() != ratings.front().size()) return std::unexpected("a rating is missing");
    if (!std::ranges::all_of(row, [](double r) { return std::isfinite(r); }))
      return std::unexpected("a rating is not a number");
  }
  const auto n = static_cast<double>(ratings.size()), k = static_cast<double>(ratings.front().size());
  const MeanSquares m = mean_squares(ratings);
  const double variance = m.rows + (k - 1) * m.error + k * (m.columns - m.error) / n;
  const double of_means = m.rows + (m.columns - m.error) / n;
  if (!(variance > 0) || !(of_means > 0)) return std::unexpected("all ratings are equal, so agreement is not defined");
  IntraclassCorrelation out;
  out.targets = ratings.size();
  out.evaluators = ratings.front().size();
  out.confidence = confidence;
  out.single.value = (m.rows - m.error) / variance;
  set_interval(m, n, k, confidence, out.single);
  out.mean = {(m.rows - m.error) / of_means, of_mean(out.single.low, k), of_mean(out.single.high, k)};
  return out;
}

std::expected<Kappa, std::string> cohen_kappa(const Matrix& table) {
  const std::size_t n = table.size();
  double all = 0, same = 0, chance = 0;
  std::vector<double> first(n), second(n);
  for (std::size_t i = 0; i < n; ++i) {
    if (table[i].size() != n) return std::unexpected("the table of judgements is not square");
    for (std::size_t j = 0; j < n; ++j) {
      if (!(table[i][j] >= 0) || !std::isfinite(table[i][j]))
        return std::unexpected("a count is negative or not finite");
      all += table[i][j];
      first[i] += table[i][j];
      second[j] += table[i][j];
      same += i == j ? table[i][j] : 0;
    }
  }
  if (!(all > 0)) return std::unexpected("there is no judgement");
  for (std::size_t i = 0; i < n; ++i) chance += first[i] * second[i] / (all * all);
  if (!(chance < 1)) return std::unexpected("both evaluators always chose the same category, so kappa is not defined");
  const double agreement = same / all;
  return Kappa{(agreement - chance) / (1 - chance), agreement, static_cast<std::size_t>(std::llround(all)), 2};
}

std::expected<Kappa, std::string> fleiss_kappa(const Matrix& counts) {
  if (counts.empty() || counts.front().empty()) return std::unexpected("there is no judgement");
  const auto subjects = static_cast<double>(counts.size());
  const double raters = std::accumulate(counts.front().begin(), counts.front().end(), 0.0);
  if (raters < 2) return std::unexpected("agreement needs at least two evaluators");
  std::vector<double> share(counts.front().size());
  double agreement = 0;
  for (const auto& row : counts) {
    if (row.size() != share.size() || std::abs(std::accumulate(row.begin(), row.end(), 0.0) - raters) > 1e-9)
      return std::unexpected("not every item has a judgement of every evaluator");
    double squares = 0;
    for (std::size_t c = 0; c < row.size(); ++c) {
      if (!(row[c] >= 0)) return std::unexpected("a count is negative or not finite");
      squares += row[c] * row[c];
      share[c] += row[c] / (subjects * raters);
    }
    agreement += (squares - raters) / (raters * (raters - 1)) / subjects;
  }
  double chance = 0;
  for (const double s : share) chance += s * s;
  if (!(chance < 1 - 1e-12)) return std::unexpected("all judgements are in one category, so kappa is not defined");
  return Kappa{(agreement - chance) / (1 - chance), agreement, counts.size(),
               static_cast<std::size_t>(std::llround(raters))};
}

}  // namespace tandem::netsim::score
