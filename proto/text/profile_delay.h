#pragma once

#include <string>

#include "proto/spec/profile_spec.h"
#include "proto/text/message_validator.h"

namespace tandem::pb {
class NetworkPath;
}

/// Private to proto/text/profile*.cpp: the delay models of one direction.
namespace tandem {

/// Reads body, regimes, boundary and slots into `path`. Errors between numbers go to `validator` under `key`.
void delay_from(const pb::NetworkPath& in, ProfilePath& path, text::MessageValidator& validator,
                const std::string& key);

}  // namespace tandem
