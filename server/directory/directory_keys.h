#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace tandem::directory {

/// Names of the directory's keys below a prefix, such as "/tandem/v1/":
///
///     live/servers/SERVER            text of the server, under its lease
///     live/sessions/SESSION/owner    name of the owner, under its lease
///     live/sessions/SESSION/standby  name of the server that takes over, under that server's lease
///     tickets/TICKET                 attempt that used the ticket
class DirectoryKeys {
 public:
  /// @param prefix  begins and ends with "/"
  explicit DirectoryKeys(std::string prefix = "/tandem/v1/") : prefix_(std::move(prefix)) {}

  [[nodiscard]] std::string live() const { return prefix_ + "live/"; }
  [[nodiscard]] std::string server(std::string_view name) const { return live() + "servers/" + std::string(name); }
  [[nodiscard]] std::string owner(std::string_view session) const { return session_key(session, "/owner"); }
  [[nodiscard]] std::string standby(std::string_view session) const { return session_key(session, "/standby"); }
  [[nodiscard]] std::string ticket(std::string_view id) const { return prefix_ + "tickets/" + std::string(id); }

  struct Parsed {
    enum class Kind : std::uint8_t { kServer, kOwner, kStandby } kind = Kind::kServer;
    std::string name;  ///< of the server or of the session
  };
  /// Reads the name of a key below live(). Returns nothing for any other key.
  [[nodiscard]] std::optional<Parsed> parse(std::string_view key) const;

  /// Returns whether `name` can name a server, a session or a ticket: 1 to 64 of A-Z a-z 0-9 . _ -
  [[nodiscard]] static bool valid_name(std::string_view name) noexcept;

 private:
  [[nodiscard]] std::string session_key(std::string_view session, const char* end) const {
    return live() + "sessions/" + std::string(session) + end;
  }
  std::string prefix_;
};

}  // namespace tandem::directory
