#pragma once

#include <string>

#include "netsim/models/path_spec.h"
#include "proto/text/message_validator.h"

namespace tandem::pb {
class ProfileOutage;
}

/// Private to proto/text: an outage of a profile or a script.
namespace tandem::netsim {

/// Converts an outage. Errors between numbers go to `validator` under `key`.
[[nodiscard]] OutageSpec outage_from(const pb::ProfileOutage& in, text::MessageValidator& validator,
                                     const std::string& key);

}  // namespace tandem::netsim
