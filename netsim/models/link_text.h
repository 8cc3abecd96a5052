#pragma once

#include <string>

#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Returns every active model of one direction with its parameters, in processing order: "loss 2 %, delay 20 ms, jitter
/// uniform 0 to 5 ms". Returns "perfect" if no model is active. ASCII, one line.
[[nodiscard]] std::string path_text(const PathSpec& path);

/// Returns both directions: one line if they are equal, else `up: ...` and `down: ...`. Each line begins with `indent`.
[[nodiscard]] std::string link_text(const LinkSpec& link, const std::string& indent);

}  // namespace tandem::netsim
