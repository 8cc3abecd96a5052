#pragma once

#include <nlohmann/json.hpp>
#include <string>

namespace tandem::console {

/// Returns the JSON text of a message. Bytes of participants that are not UTF-8 are replaced.
[[nodiscard]] inline std::string json_text(const nlohmann::json& message) {
  return message.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace);
}

}  // namespace tandem::console
