#pragma once

#include <string_view>

#include "netsim/path_spec.h"

namespace tandem::netsim {

/// For `problems`: a body under the name `key`, and the delay models besides it.
void check_body(std::string_view key, const BodySpec& body, Findings& found);
void check_delay_models(const PathSpec& spec, Findings& found);

}  // namespace tandem::netsim
