#pragma once

#include <expected>
#include <string_view>

#include "netsim/path_spec.h"
#include "proto/input_error.h"

namespace tandem::netsim {

/// Reads a recorded capacity: the table `direction[...],t_ms[...],opportunities[...]` (direction `up` or `down`, times
/// of each ascending, whole milliseconds), or mahimahi's form: one whole millisecond per line and opportunity of 1500
/// bytes, never falling; then both directions are alike. The recording lasts until the millisecond after its last one.
/// @return a link whose rates play the recording without a queue limit, or every mistake with its line
[[nodiscard]] std::expected<LinkSpec, InputErrors> parse_capacity(std::string_view text, std::string_view file_name);

}  // namespace tandem::netsim
