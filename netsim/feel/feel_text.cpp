#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "common/base/wrap_words.h"
#include "netsim/feel/feel_report.h"
#include "netsim/feel/noticeable.h"

namespace tandem::netsim {
namespace {

constexpr std::size_t kWidth = 80;

/// Returns a number with three significant digits.
std::string shown(double value) {
  if (std::isnan(value)) return "none";
  const double size = std::abs(value);
  return format(size >= 99.95 ? "%.0f" : size >= 9.995 ? "%.1f" : size >= 0.9995 || size == 0 ? "%.2f" : "%.3f", value);
}

std::string wrapped_lines(const std::string& text, const std::string& indent) {
  std::string out;
  for (const std::string& line : wrap_words(text, kWidth, indent.size() + 2, indent.size()))
    out += (out.empty() ? indent : "") + line + "\n";
  return out;
}

std::string row(const FeelKey& key, const FeelNumber& number) {
  return format("  %-42s %9s %9s  %s\n", std::string(key.description).c_str(), shown(number.mean * key.factor).c_str(),
                shown(number.worst * key.factor).c_str(), std::string(key.unit).c_str());
}

}  // namespace

const FeelNumber* FeelReport::find(std::string_view key) const {
  const auto it = numbers.find(std::string(key));
  return it == numbers.end() ? nullptr : &it->second;
}

bool FeelReport::holds(const FeelLimit& limit) const {
  const FeelNumber* const number = find(limit.key);
  return number != nullptr && limit.holds(*number);
}

std::vector<std::pair<const FeelKey*, FeelNumber>> FeelReport::rows(const FeelSection& section) const {
  std::vector<std::pair<const FeelKey*, FeelNumber>> out;
  for (const FeelKey& key : section.keys)
    if (const FeelNumber* const number = find(key.key)) out.emplace_back(&key, *number);
  return out;
}

std::vector<const FeelLimit*> FeelReport::broken() const {
  std::vector<const FeelLimit*> out;
  for (const FeelLimit& limit : limits)
    if (!holds(limit)) out.push_back(&limit);
  return out;
}

std::string feel_text(const FeelReport& r) {
  std::string out = wrapped_lines(
      format("%s over %s, law %s, %zu %s", r.scene.c_str(), r.network.c_str(), r.channel.c_str(), r.seeds.size(),
             r.seeds.size() == 1 ? "seed" : "seeds") +
          (r.plain_hands ? ", plain hands: no tremor, no noise, one impedance" : ", hands of different people"),
      "");
  for (const std::string& note : r.notes) out += wrapped_lines("note: " + note, "");
  out += format("  %-42s %9s %9s\n", "", "mean", "worst");
  for (const FeelSection& section : feel_sections()) {
    std::string rows;
    for (const auto& [key, number] : r.rows(section)) rows += row(*key, number);
    if (!rows.empty()) out += std::string(section.title) + "\n" + rows;
  }
  const std::vector<std::string> words = noticeable_text(r.spec, r.numbers, r.one_way_s);
  if (!words.empty()) out += "Perception by a person (a step is a just-noticeable difference)\n";
  for (const std::string& sentence : words) out += wrapped_lines(sentence, "  ");
  for (const std::string& trouble : r.troubles) out += wrapped_lines("could not be measured: " + trouble, "");
  for (const FeelLimit* limit : r.broken()) {
    const FeelNumber* const number = r.find(limit->key);
    const std::string unit = si_unit(limit->key).empty() ? "" : " " + std::string(si_unit(limit->key));
    const std::string got = number == nullptr ? "was not measured"
                            : std::isnan(number->mean)
                                ? "does not exist in every seed"
                                : format("mean %.4g, worst %.4g%s (seed %llu)", number->mean, number->worst,
                                         unit.c_str(), static_cast<unsigned long long>(number->worst_seed));
    out += wrapped_lines(
        format("FAIL %s: ", limit->key.c_str()) + got +
            format("; must be at %s %g, the worst seed %g", limit->at_least ? "least" : "most", limit->end,
                   limit->at_least ? limit->end / FeelLimit::kWorstFactor : limit->end * FeelLimit::kWorstFactor),
        "");
  }
  if (!r.limits.empty())
    out += format("%s: %zu of %zu limits hold\n", r.passed() ? "pass" : "FAIL", r.limits.size() - r.broken().size(),
                  r.limits.size());
  out += format("%.0f s of sessions in %.1f s: %.0f x real time\n", r.lived_s, r.wall_s,
                r.wall_s > 0 ? r.lived_s / r.wall_s : 0.0);
  return out;
}

std::string feel_csv(const FeelReport& r) {
  std::string out = "key,unit,mean,worst,worst_seed\n";
  const auto value = [](double v) { return std::isfinite(v) ? format("%.9g", v) : std::string(); };
  for (const FeelSection& section : feel_sections())
    for (const auto& [key, number] : r.rows(section))
      out += std::string(key->key) + "," + std::string(si_unit(key->key)) + "," + value(number.mean) + "," +
             value(number.worst) + "," + std::to_string(number.worst_seed) + "\n";
  return out;
}

}  // namespace tandem::netsim
