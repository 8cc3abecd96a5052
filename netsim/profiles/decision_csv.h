#pragma once

#include <expected>
#include <string_view>
#include <vector>

#include "netsim/engine/decision_log.h"
#include "proto/spec/input_error.h"

namespace tandem::netsim {

/// Parses and sorts the output of `decision_csv`, with rows in any order.
/// @return rows, or all errors with their lines: unknown words, times before 0, t_out before t_in, duplicate datagrams
[[nodiscard]] std::expected<std::vector<Decision>, InputErrors> parse_decision_csv(std::string_view text,
                                                                                   std::string_view file_name);

}  // namespace tandem::netsim
