#pragma once

#include <string>

#include "netsim/path_spec.h"

namespace tandem::netsim {

/// Every model of one direction that is in force, with its numbers, in the order in which a datagram meets them:
/// "loss 2 %, delay 20 ms, jitter uniform 0 to 5 ms"; "perfect" when nothing is. ASCII, one line.
[[nodiscard]] std::string path_words(const PathSpec& path);

/// Both directions: one line when they are alike, else `up: ...` and `down: ...`. Lines begin with `indent`.
[[nodiscard]] std::string link_words(const LinkSpec& link, const std::string& indent);

}  // namespace tandem::netsim
