#pragma once

#include <expected>
#include <string_view>
#include <vector>

#include "netsim/decision_log.h"
#include "proto/input_error.h"

namespace tandem::netsim {

/// Reads what `decision_csv` wrote, in any order of rows, and sorts it.
/// @return the rows, or every mistake with its line: unknown words, times before 0, t_out before t_in, a datagram twice
[[nodiscard]] std::expected<std::vector<Decision>, InputErrors> parse_decision_csv(std::string_view text,
                                                                                   std::string_view file_name);

}  // namespace tandem::netsim
