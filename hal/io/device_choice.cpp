#include "hal/io/device_choice.h"

#include <algorithm>

#include "common/base/nearest.h"

namespace tandem::hal {
namespace {

DeviceError wrong(std::string message) { return {Errc::kUnsupported, "device: " + std::move(message)}; }

}  // namespace

std::optional<std::string> DeviceChoice::find(std::string_view key) const {
  const auto found = std::ranges::find(options, key, &Option::key);
  return found == options.end() ? std::nullopt : std::optional{found->value};
}

Result<DeviceChoice> parse_choice(std::string_view spec) {
  DeviceChoice choice;
  const auto colon = spec.find(':');
  choice.backend = spec.substr(0, colon);
  if (choice.backend.empty()) return std::unexpected(wrong("the kind is missing in '" + std::string(spec) + "'"));
  if (colon == std::string_view::npos) return choice;
  std::string_view rest = spec.substr(colon + 1);
  for (bool first = true; first || !rest.empty(); first = false) {
    const auto comma = std::min(rest.find(','), rest.size());
    const std::string_view part = rest.substr(0, comma);
    const auto equals = part.find('=');
    if (part.empty() || equals == 0)
      return std::unexpected(wrong("a name or KEY=VALUE is missing in '" + std::string(spec) + "'"));
    if (equals == std::string_view::npos) {
      if (!first)
        return std::unexpected(wrong("'" + std::string(part) + "' has no value; the name of a device stands first, then KEY=VALUE"));
      choice.name = part;
    } else {
      DeviceChoice::Option option{std::string(part.substr(0, equals)), std::string(part.substr(equals + 1))};
      if (option.value.empty()) return std::unexpected(wrong("option " + option.key + " needs a value: " + option.key + "=..."));
      if (choice.find(option.key)) return std::unexpected(wrong(option.key + " is given twice"));
      choice.options.push_back(std::move(option));
    }
    rest.remove_prefix(std::min(comma + 1, rest.size()));
  }
  return choice;
}

Result<> only_these(const DeviceChoice& choice, const std::vector<std::string>& known) {
  for (const DeviceChoice::Option& option : choice.options) {
    if (std::ranges::find(known, option.key) != known.end()) continue;
    return std::unexpected(wrong(choice.backend + " has no option '" + option.key.substr(0, 60) + "'; " +
                                 suggest(option.key, known)));
  }
  return {};
}

Result<bool> yes_or_no(const DeviceChoice& choice, std::string_view key, bool otherwise) {
  const auto value = choice.find(key);
  if (!value) return otherwise;
  if (*value == "yes") return true;
  if (*value == "no") return false;
  return std::unexpected(wrong(std::string(key) + " is 'yes' or 'no', not '" + value->substr(0, 60) + "'"));
}

}  // namespace tandem::hal
