#pragma once

#include <string>

#include "netsim/models/path_spec.h"
#include "proto/text/message_validator.h"

namespace tandem::pb {
class NetworkPath;
}

/// Private to proto/text/profile*.cpp: the loss models of one direction.
namespace tandem::netsim {

[[nodiscard]] constexpr double probability(double percent) noexcept { return percent / 100; }

/// Reads the loss models of a direction. Errors between numbers go to `validator` under `key`.
[[nodiscard]] LossSpec loss_from(const pb::NetworkPath& in, text::MessageValidator& validator, const std::string& key);

}  // namespace tandem::netsim
