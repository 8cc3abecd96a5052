#pragma once

#include <string>

#include "proto/checker.h"
#include "proto/woodenhaptics_spec.h"

namespace tandem {

namespace pb {
class WoodenHapticsFile;
}

/// Private to proto/*.cpp. Numbers are within their limits already; rules between them are judged here.
/// @param key  path of `in`, for mistakes
[[nodiscard]] WoodenHapticsSpec woodenhaptics_from(const pb::WoodenHapticsFile& in, text::Checker& checker,
                                                   const std::string& key);

}  // namespace tandem
