#pragma once

#include <expected>
#include <string>
#include <vector>

#include "netsim/replay/recorded_part.h"

namespace tandem::netsim {

/// Finds the files of one recording, in their order.
/// @param named  all files of it; or one file, whose other parts are looked for in its folder; or a folder with the
/// files of one recording
/// @return the parts, `file` being their path; or the error, with the name of the file
[[nodiscard]] std::expected<std::vector<RecordedPart>, std::string> find_parts(const std::vector<std::string>& named);

}  // namespace tandem::netsim
