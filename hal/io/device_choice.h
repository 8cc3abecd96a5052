#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "hal/device.h"

namespace tandem::hal {

/// What a person means by `--device BACKEND[:NAME][,KEY=VALUE]...`, for all devices but simulated ones.
struct DeviceChoice {
  struct Option {
    std::string key, value;
  };
  std::string backend;
  std::string name;  ///< which of several: what `doctor` prints; empty: the only one
  std::vector<Option> options;

  [[nodiscard]] std::optional<std::string> find(std::string_view key) const;
};

/// Error: what is wrong with the words themselves; the options are the backend's business.
[[nodiscard]] Result<DeviceChoice> parse_choice(std::string_view spec);
/// Refuses options a backend does not have: names the wrong one, the nearest and all there are.
[[nodiscard]] Result<> only_these(const DeviceChoice& choice, const std::vector<std::string>& known);
/// `yes` or `no`. Error: names the option and both words.
[[nodiscard]] Result<bool> yes_or_no(const DeviceChoice& choice, std::string_view key, bool otherwise);

}  // namespace tandem::hal
