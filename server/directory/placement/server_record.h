#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tandem::directory {

/// Record that a server publishes about itself under its lease: lines "name value".
struct ServerRecord {
  std::string address;  ///< "host:port" of its control connection
  std::string key;      ///< fingerprint of its key
  std::string version;  ///< of the program
  std::string zone;     ///< servers that fail together, such as a rack or a building; may be empty
  double capacity = 0;  ///< processor time that ticks may use, in cores
  double used = 0;      ///< of it, by the sessions that run
  bool drains = false;  ///< takes no further sessions
  double expected = 0;  ///< processor time when all seats of its sessions are taken [cores]; of older versions: `used`
  std::string voucher{};        ///< signed by the service's key, in hexadecimal digits; empty: none
  std::int64_t epoch_base = 0;  ///< highest one of a session that the server knows; of older versions: 0
  friend bool operator==(const ServerRecord&, const ServerRecord&) = default;
};

/// Longest text that is read.
inline constexpr std::size_t kServerRecordMax = 8192;

/// @pre no text of the record has a line break
[[nodiscard]] std::string to_text(const ServerRecord& record);
/// Reads the text of another server. Unknown lines are ignored: they are of a newer version. Returns nothing if a line
/// that is needed is missing or doubled, or if a number is not finite or negative.
[[nodiscard]] std::optional<ServerRecord> parse_server_record(std::string_view text);

}  // namespace tandem::directory
