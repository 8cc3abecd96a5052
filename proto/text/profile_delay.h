#pragma once

#include <string>

#include "netsim/models/path_spec.h"
#include "proto/text/message_validator.h"

namespace tandem::pb {
class NetworkPath;
}

/// Private to proto/text/profile*.cpp: the delay models of one direction.
namespace tandem::netsim {

/// Reads body, regimes, boundary and slots into `path`. Errors between numbers go to `validator` under `key`.
void delay_from(const pb::NetworkPath& in, PathSpec& path, text::MessageValidator& validator, const std::string& key);

}  // namespace tandem::netsim
