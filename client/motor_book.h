#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::client {

/// What `doctor --confirm-motors` found of the motors of one device with one device file.
struct MotorRecord {
  std::string device;       ///< "serial:..." or "port:...", as the backend tells it; no space
  std::string file_sha256;  ///< of the device file, 64 hexadecimal digits
  bool confirmed = false;   ///< every motor was seen to push the way it is told
  std::int64_t at = 0;      ///< seconds since 1970, UTC
};

/// All such records of a workstation: one per device and file. Pure text in and out: one line per record,
///   motors 1 DEVICE SHA256 confirmed|refused SECONDS
class MotorBook {
 public:
  static constexpr std::size_t kRecordsMax = 256;  ///< the oldest goes first

  /// Error: the line that is not understood, from 1, and why. Nothing of such a file counts.
  [[nodiscard]] static std::expected<MotorBook, std::string> parse(std::string_view text);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const MotorRecord* find(std::string_view device, std::string_view file_sha256) const noexcept;
  /// Takes the place of what was known of this device with this file.
  void put(MotorRecord record);
  [[nodiscard]] const std::vector<MotorRecord>& records() const noexcept { return records_; }

 private:
  std::vector<MotorRecord> records_;
};

}  // namespace tandem::client
