#pragma once

#include <cstdint>
#include <expected>
#include <string>

#include "common/io/fd.h"
#include "server/archive/recording_parts.h"

namespace tandem::server {

/// A recording that is open for reading in parts.
class RecordingFile {
 public:
  /// @return error: why the file cannot be read, without its name
  [[nodiscard]] static std::expected<RecordingFile, std::string> open(const std::string& path);

  [[nodiscard]] const RecordingParts& parts() const noexcept { return parts_; }
  [[nodiscard]] ReadAt read() const;
  /// Size [bytes] when it was opened.
  [[nodiscard]] std::uint64_t bytes() const noexcept { return bytes_; }
  /// Whether the file is still as it was opened: neither changed nor deleted.
  [[nodiscard]] bool unchanged() const noexcept;

 private:
  io::Fd file_;
  std::uint64_t bytes_ = 0;
  std::int64_t modified_ns_ = 0;
  RecordingParts parts_;
};

}  // namespace tandem::server
