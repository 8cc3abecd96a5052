#pragma once

#include <expected>
#include <string_view>

#include "netsim/models/path_spec.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// Parses a recorded capacity in one of two forms. The table form has the columns
/// `direction[...],t_ms[...],opportunities[...]`; direction is `up` or `down`, times are whole milliseconds, ascending
/// per direction. mahimahi's form has one line per opportunity of 1500 bytes with its time in whole milliseconds, never
/// decreasing. Both directions then are equal. The recording ends 1 ms after its last entry.
/// @return link whose rates play the recording without a queue limit, or all errors with their lines
[[nodiscard]] std::expected<LinkSpec, InputErrors> parse_capacity(std::string_view text, std::string_view file_name);

}  // namespace tandem::netsim
