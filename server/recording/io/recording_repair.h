#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace tandem::server {

/// Result of a repair.
struct RecordingRepair {
  enum class Kind : std::uint8_t {
    kRepaired,  ///< `path` is a complete file
    kComplete,  ///< it was complete; a name NAME.mcap.part became NAME.mcap
    kInUse,     ///< a program writes the file now; it is unchanged
    kFailed,    ///< the file is unchanged, also if it cannot be locked: a program may be writing it
  };
  Kind kind = Kind::kFailed;
  std::string path;  ///< of the complete file
  std::string text;  ///< for users: kept and missing parts, or the cause and remedy
};

/// Closes the file of a recording that was cut: it keeps all whole chunks, and gives the file a new index and end. The
/// original stays until the repaired file is complete on the disk, and then is replaced; NAME.mcap.part becomes
/// NAME.mcap, or NAME-2.mcap if that exists.
/// @param on_progress  called with texts for users while a large file is read and written; may be empty
[[nodiscard]] RecordingRepair repair_recording(const std::string& path,
                                               const std::function<void(const std::string&)>& on_progress = {});

/// Returns the files NAME.mcap.part in a folder that no program writes, sorted by name, at most 1000.
[[nodiscard]] std::vector<std::string> recording_leftovers(const std::string& folder);

}  // namespace tandem::server
