#pragma once

#include <expected>
#include <string>
#include <vector>

#include "server/archive/recorded_part.h"

namespace tandem::server {

/// Finds the files of one recording, in their order.
/// @param named  all files of it; or one file, whose other parts are looked for in its folder; or a folder with the
/// files of one recording
/// @return the parts, `file` being their path; or the error, with the name of the file
[[nodiscard]] std::expected<std::vector<RecordedPart>, std::string> find_parts(const std::vector<std::string>& named);

/// Why the files of a recording cannot be found.
struct PartsProblem {
  std::string text;         ///< with the name of the file
  bool incomplete = false;  ///< the named files can be read, but they are not one whole recording
};

/// Finds the files of one or more recordings, in the order in which they are named. Files of one recording belong
/// together; the other parts of a recording of which some are missing are looked for in the folder of the first one.
/// @return the parts of each recording in their order, `file` being their path; or the error
[[nodiscard]] std::expected<std::vector<std::vector<RecordedPart>>, PartsProblem> find_recordings(
    const std::vector<std::string>& named);

}  // namespace tandem::server
