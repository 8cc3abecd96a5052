#pragma once

#include <cstdint>
#include <expected>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/feel/feel_keys.h"

namespace tandem::netsim {

/// A number over all seeds. NaN: no seed, or some seed, has no such number.
struct FeelNumber {
  double mean = 0, worst = 0;
  std::uint64_t worst_seed = 0;
};

/// What one seed gave: all its probes together.
struct FeelSeed {
  std::uint64_t seed = 0;
  FeelValues values;
};

/// Mean and worst over the seeds, by key. A seed without the number makes it unknown: NaN.
[[nodiscard]] std::map<std::string, FeelNumber> summarised(const std::vector<FeelSeed>& seeds);

/// What must hold of a number: of its mean; the worst seed may be this much worse.
struct FeelLimit {
  static constexpr double kWorstFactor = 1.5;
  std::string key;
  double end = 0;        ///< in SI
  bool at_least = false;  ///< else at most

  /// Of a number that is at most: the worst is at most 1.5 times the end; at least: the worst is at least the end divided by 1.5.
  [[nodiscard]] bool holds(const FeelNumber& number) const noexcept;
};

/// Reads `KEY<=NUMBER` or `KEY>=NUMBER`, in SI. The error names the text, what is allowed, and the nearest key.
[[nodiscard]] std::expected<FeelLimit, std::string> parse_feel_limit(std::string_view text);

}  // namespace tandem::netsim
