#pragma once

#include <string>

#include "proto/checker.h"
#include "proto/profile_spec.h"

namespace tandem::pb {
class ProfileOutage;
}

/// Private to proto/*.cpp: an outage, in a profile or in a script.
namespace tandem {

/// Mistakes between numbers go to `checker` under `key`.
[[nodiscard]] ProfileOutage outage_from(const pb::ProfileOutage& in, text::Checker& checker, const std::string& key);

}  // namespace tandem
