#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace tandem::client {

/// Result of `doctor --confirm-motors` for one device with one device file.
struct MotorRecord {
  std::string device;       ///< "serial:..." or "port:..." from the backend; no space
  std::string file_sha256;  ///< of the device file, 64 hexadecimal digits
  bool confirmed = false;   ///< every motor pushed in the commanded direction
  std::int64_t at = 0;      ///< time of the check, seconds since 1970, UTC
};

/// All motor records of a workstation, one per device and device file. Reads and writes text with one line per record:
///   motors 1 DEVICE SHA256 confirmed|refused SECONDS
class MotorRegistry {
 public:
  static constexpr std::size_t kRecordsMax = 256;  ///< a further record replaces the oldest

  /// Parses the text of a registry file. An invalid line invalidates the whole file.
  /// @return the registry, or the number of the invalid line, from 1, and the reason
  [[nodiscard]] static std::expected<MotorRegistry, std::string> parse(std::string_view text);
  [[nodiscard]] std::string text() const;
  [[nodiscard]] const MotorRecord* find(std::string_view device, std::string_view file_sha256) const noexcept;
  /// Adds the record; replaces an existing one of the same device and file.
  void put(MotorRecord record);
  [[nodiscard]] const std::vector<MotorRecord>& records() const noexcept { return records_; }

 private:
  std::vector<MotorRecord> records_;
};

}  // namespace tandem::client
