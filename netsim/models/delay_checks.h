#pragma once

#include <string_view>

#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Checks for `problems`: `check_body` validates a body under the name `key`, `check_delay_models` the other delay
/// models.
void check_body(std::string_view key, const BodySpec& body, SpecErrors& found);
void check_delay_models(const PathSpec& spec, SpecErrors& found);

}  // namespace tandem::netsim
