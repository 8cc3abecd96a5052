#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace tandem::server {

/// Place of a file in a recording of several files, as its metadata state it (server/recording/io/recording_files.h).
struct RecordedPart {
  static constexpr unsigned kNumberMax = 9999;

  std::string file;                          ///< its name, for messages
  std::string session_id, epoch, recording;  ///< equal in all files of a recording; empty `recording`: it has one file
  unsigned number = 1;                       ///< from 1
  std::optional<bool> last;                  ///< no file follows; nullopt: the file has no end that says so
  std::string previous_file;                 ///< name of the file before, without its folder; empty: not stated
  friend bool operator==(const RecordedPart&, const RecordedPart&) = default;
};

/// Reads the place of a file in its recording from its metadata record `session`.
/// @return why the number is not valid, without the name of the file
[[nodiscard]] std::expected<RecordedPart, std::string> read_part(const std::map<std::string, std::string>& session,
                                                                 std::string file);

/// Reads the place of a file in its recording.
/// @param bytes  of an MCAP file, or its definitions without messages; any bytes are safe
/// @param file   its name
/// @return why it is no recording with a valid number, without the name of the file
[[nodiscard]] std::expected<RecordedPart, std::string> read_part(std::span<const std::byte> bytes, std::string file);

/// Returns whether both are files of one recording.
[[nodiscard]] bool same_recording(const RecordedPart& a, const RecordedPart& b) noexcept;

/// Sorts the files of one recording by their numbers.
/// @return why they are not one whole recording, with the name of the file or the number of the part that is wrong or
/// missing; empty: they are. A file without an end may be the last one.
[[nodiscard]] std::string order_parts(std::vector<RecordedPart>& parts);

}  // namespace tandem::server
