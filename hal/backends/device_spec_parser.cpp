#include "hal/backends/device_spec_parser.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "common/base/format.h"
#include "common/base/suggestions.h"

namespace tandem::hal {
namespace {

constexpr std::size_t kShown = 60;  // characters of user input shown in messages

std::string shown(std::string_view text) { return std::string(text.substr(0, kShown)); }

}  // namespace

std::optional<std::string> DeviceSpec::find(std::string_view key) const {
  const auto found = std::ranges::find(options, key, &Option::key);
  return found == options.end() ? std::nullopt : std::optional{found->value};
}

Result<DeviceSpec> parse_device_spec(std::string_view spec) {
  DeviceSpec choice;
  const auto colon = spec.find(':');
  choice.backend = spec.substr(0, colon);
  if (choice.backend.empty())
    return std::unexpected(
        DeviceError{Errc::kUnsupported, "device: the kind is missing in '" + std::string(spec) + "'"});
  if (colon == std::string_view::npos) return choice;
  std::string_view rest = spec.substr(colon + 1);
  for (bool first = true, more = true; more; first = false) {
    const auto comma = rest.find(',');
    more = comma != std::string_view::npos;
    const std::string_view part = rest.substr(0, comma);
    rest.remove_prefix(more ? comma + 1 : rest.size());
    const auto equals = part.find('=');
    if (part.empty() || equals == 0) {
      choice.errors.push_back("a name or KEY=VALUE is missing in '" + std::string(spec) + "'" +
                              (part.empty() ? "" : " before '" + shown(part) + "'"));
    } else if (equals == std::string_view::npos) {
      if (first) {
        choice.name = part;
      } else {
        choice.errors.push_back("'" + shown(part) + "' has no value; the name of a device comes first, then KEY=VALUE");
      }
    } else {
      DeviceSpec::Option option{std::string(part.substr(0, equals)), std::string(part.substr(equals + 1))};
      if (option.value.empty()) {
        choice.errors.push_back("option " + shown(option.key) + " needs a value: " + shown(option.key) + "=...");
      } else if (choice.find(option.key)) {
        choice.errors.push_back(shown(option.key) + " = '" + shown(option.value) + "': " + shown(option.key) +
                                " is given twice");
      } else {
        choice.options.push_back(std::move(option));
      }
    }
  }
  return choice;
}

OptionParser::OptionParser(const DeviceSpec& choice, const std::vector<std::string>& known) : choice_(&choice) {
  for (const std::string& words : choice.errors) add_error(words);
  for (const DeviceSpec::Option& option : choice.options) {
    if (std::ranges::find(known, option.key) != known.end()) continue;
    add_error("has no option '" + shown(option.key) + "' (= '" + shown(option.value) + "'); " +
              suggest(option.key, known));
  }
}

std::string OptionParser::one_of(std::string_view key, std::initializer_list<std::string_view> allowed) {
  const auto value = choice_->find(key);
  if (!value) return std::string(*allowed.begin());
  if (std::ranges::find(allowed, *value) != allowed.end()) return *value;
  std::string words;
  for (const std::string_view word : allowed)
    words += (words.empty() ? "'" : word == *std::prev(allowed.end()) ? " or '" : ", '") + std::string(word) + "'";
  add_error(std::string(key) + " = '" + shown(*value) + "': must be " + words);
  return std::string(*allowed.begin());
}

bool OptionParser::yes_or_no(std::string_view key, bool otherwise) {
  const auto value = choice_->find(key);
  if (value == "yes") return true;
  if (value && *value != "no") add_error(std::string(key) + " = '" + shown(*value) + "': must be 'yes' or 'no'");
  return value ? false : otherwise;
}

std::optional<double> OptionParser::number(std::string_view key, double lo, double hi, std::string_view unit) {
  const auto text = choice_->find(key);
  if (!text) return std::nullopt;
  double value = 0;
  const auto [end, error] = std::from_chars(text->data(), text->data() + text->size(), value);
  const bool read = error == std::errc{} && end == text->data() + text->size() && std::isfinite(value);
  if (read && value >= lo && value <= hi) return value;
  add_error(std::string(key) + " = '" + shown(*text) + "': must be a number in " + format("[%g, %g] ", lo, hi) +
            std::string(unit));
  return std::nullopt;
}

void OptionParser::add_error(std::string what) {
  mistakes_.push_back("device: " + choice_->backend + ": " + std::move(what));
}

void OptionParser::add_lines(std::string lines) {
  while (lines.ends_with('\n')) lines.pop_back();
  mistakes_.push_back(std::move(lines));
}

Result<> OptionParser::result() const {
  if (mistakes_.empty()) return {};
  std::string all;
  for (const std::string& words : mistakes_) all += (all.empty() ? "" : "\n") + words;
  return std::unexpected(DeviceError{Errc::kUnsupported, std::move(all)});
}

}  // namespace tandem::hal
