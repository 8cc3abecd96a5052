#pragma once

#include <string>

#include "proto/spec/woodenhaptics_spec.h"
#include "proto/text/message_validator.h"

namespace tandem {

namespace pb {
class WoodenHapticsFile;
}

/// Private to proto/text: converts WoodenHaptics parameters and checks the rules between them. @pre numbers are within
/// their limits
/// @param key  path of `in`, for errors
[[nodiscard]] WoodenHapticsSpec woodenhaptics_from(const pb::WoodenHapticsFile& in, text::MessageValidator& validator,
                                                   const std::string& key);

}  // namespace tandem
