#pragma once

#include <cstdint>
#include <string>

#include "server/recording/io/recording_files.h"

namespace tandem::server {

/// Where and how a session is recorded, validated.
struct RecordingOptions {
  std::string target{};     ///< folder, or first file NAME.mcap; empty: the session is not recorded
  bool pseudonyms = false;  ///< P1, P2 ... instead of names of participants and workstations
  bool from_start = true;   ///< starts with the session; false: by an order only
  RecordingLimits limits{};
  std::uint64_t inputs_bytes = std::uint64_t{1} << 30U;  ///< kept per session for later recordings, at most; 0: none
};

/// Returns why nothing can be recorded there; empty: a folder that this user may write, or a file NAME.mcap in one.
[[nodiscard]] std::string recording_target_problem(const std::string& target);

/// Returns the name of the first file of a recording. In a folder: SESSION-20261126T134500Z-0f3a9c11.mcap. A file that
/// exists is never replaced: NAME.mcap becomes NAME-2.mcap and so on.
/// @param id      digits that distinguish sessions of one second
/// @param wall_s  time of the start [s since 1970]
[[nodiscard]] std::string recording_path(const std::string& target, const std::string& session, const std::string& id,
                                         std::int64_t wall_s);

/// Folder of a target, to look for files that an earlier server left.
[[nodiscard]] std::string recording_folder(const std::string& target);

}  // namespace tandem::server
