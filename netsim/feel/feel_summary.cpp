#include "netsim/feel/feel_summary.h"

#include <charconv>
#include <cmath>
#include <limits>
#include <set>

#include "common/base/suggestions.h"
#include "netsim/feel/meters.h"

namespace tandem::netsim {

std::map<std::string, FeelNumber> summarised(const std::vector<FeelSeed>& seeds) {
  std::set<std::string> keys;
  for (const FeelSeed& seed : seeds)
    for (const auto& [key, value] : seed.values) keys.insert(key);
  std::map<std::string, FeelNumber> out;
  for (const std::string& key : keys) {
    const FeelKey* known = find_feel_key(key);
    const bool least = known != nullptr && known->least_is_worst;
    FeelNumber number;
    bool any = false;
    for (const FeelSeed& seed : seeds) {
      const auto it = seed.values.find(key);
      const double value = it == seed.values.end() ? kNaN : it->second;
      number.mean += value;
      if (any && std::isnan(number.worst)) continue;
      if (!any || std::isnan(value) || (least ? value < number.worst : value > number.worst)) {
        number.worst = value;
        number.worst_seed = seed.seed;
      }
      any = true;
    }
    number.mean /= static_cast<double>(seeds.size());
    out[key] = number;
  }
  return out;
}

bool FeelLimit::holds(const FeelNumber& number) const noexcept {
  if (std::isnan(number.mean) || std::isnan(number.worst)) return false;
  if (at_least) return number.mean >= end && number.worst >= end / kWorstFactor;
  return number.mean <= end && number.worst <= end * kWorstFactor;
}

std::expected<FeelLimit, std::string> parse_feel_limit(std::string_view text) {
  const std::string shown = "\"" + std::string(text.substr(0, 60)) + "\"";
  const auto cut = text.find_first_of("<>");
  if (cut == std::string_view::npos || cut + 2 >= text.size() || text[cut + 1] != '=')
    return std::unexpected(shown +
                           " is no limit: write KEY<=NUMBER or KEY>=NUMBER in SI units, such as 'drag_1hz_n<=0.15'");
  FeelLimit limit{.key = std::string(text.substr(0, cut)), .at_least = text[cut] == '>'};
  if (find_feel_key(limit.key) == nullptr) {
    std::vector<std::string> known;
    for (const FeelSection& section : feel_sections())
      for (const FeelKey& one : section.keys) known.emplace_back(one.key);
    return std::unexpected(shown + ": no number is called " + limit.key + "; " + suggest(limit.key, known));
  }
  const std::string_view number = text.substr(cut + 2);
  const auto [end, error] = std::from_chars(number.data(), number.data() + number.size(), limit.end);
  if (error != std::errc{} || end != number.data() + number.size() || !std::isfinite(limit.end))
    return std::unexpected(shown + ": " + std::string(number) + " is not a finite number");
  return limit;
}

}  // namespace tandem::netsim
