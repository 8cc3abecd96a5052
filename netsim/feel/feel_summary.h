#pragma once

#include <cstdint>
#include <expected>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/feel/feel_keys.h"

namespace tandem::netsim {

/// A number over all seeds. NaN: there is no seed, or some seed lacks the number.
struct FeelNumber {
  double mean = 0, worst = 0;
  std::uint64_t worst_seed = 0;
};

/// Results of all probes of one seed.
struct FeelSeed {
  std::uint64_t seed = 0;
  FeelValues values;
};

/// Returns mean and worst over the seeds, by key. If a seed lacks the number, the result is NaN.
[[nodiscard]] std::map<std::string, FeelNumber> summarised(const std::vector<FeelSeed>& seeds);

/// A limit for the mean of a number; the worst seed may exceed it by the factor kWorstFactor.
struct FeelLimit {
  static constexpr double kWorstFactor = 1.5;
  std::string key;
  double end = 0;         ///< limit in SI units
  bool at_least = false;  ///< true: lower limit; false: upper limit

  /// Returns whether the limit holds. For an upper limit the worst is at most 1.5 times the end. For a lower limit it
  /// is at least the end divided by 1.5.
  [[nodiscard]] bool holds(const FeelNumber& number) const noexcept;
};

/// Reads `KEY<=NUMBER` or `KEY>=NUMBER`, in SI units. The error names the text, the allowed form, and the nearest key.
[[nodiscard]] std::expected<FeelLimit, std::string> parse_feel_limit(std::string_view text);

}  // namespace tandem::netsim
