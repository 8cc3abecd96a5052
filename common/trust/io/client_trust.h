#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/trust/books.h"
#include "common/trust/io/state_folder.h"
#include "common/trust/ticket_key.h"
#include "common/trust/tls_key.h"

namespace tandem::trust {

/// What a workstation has: its key, and the servers it was enrolled at.
class ClientTrust {
 public:
  static constexpr const char* kKeyFile = "workstation_key.pem";
  static constexpr const char* kCertificateFile = "workstation_cert.pem";
  static constexpr const char* kServersFile = "servers.textproto";

  /// Opens the folder; makes it and the workstation's key where they are missing.
  [[nodiscard]] static std::expected<ClientTrust, std::string> open_or_make(const std::string& path, std::int64_t now);
  /// @return nothing if the folder or the key is not there: this workstation was never enrolled
  [[nodiscard]] static std::expected<std::optional<ClientTrust>, std::string> open(const std::string& path);

  [[nodiscard]] const Identity& identity() const noexcept { return identity_; }
  [[nodiscard]] std::expected<std::vector<ServerRow>, std::string> servers() const;
  /// @return what is wrong, empty if it is on disk
  [[nodiscard]] std::string remember(const ServerRow& server) const;

 private:
  ClientTrust(StateFolder folder, Identity identity) : folder_(std::move(folder)), identity_(std::move(identity)) {}
  static std::expected<std::optional<ClientTrust>, std::string> read(StateFolder folder);

  StateFolder folder_;
  Identity identity_;
};

/// What a server on loopback lays down for clients of the same user on the same machine: the key of a workstation it enrolled itself,
/// and the key that tickets are signed with, so that such a client writes itself a ticket. One file per server, `HEX-OF-PIN.local`.
struct LocalKeys {
  Identity workstation;
  TicketKey ticket_key;
};

/// The server's side: the file is there as long as this is.
class LocalRuntime {
 public:
  [[nodiscard]] static std::expected<LocalRuntime, std::string> publish(const std::string& folder, const Pin& server, const LocalKeys& keys);
  ~LocalRuntime();
  LocalRuntime(LocalRuntime&& other) noexcept : folder_(std::move(other.folder_)), name_(std::exchange(other.name_, {})) {}
  LocalRuntime& operator=(LocalRuntime&&) = delete;

 private:
  LocalRuntime(StateFolder folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {}
  StateFolder folder_;
  std::string name_;
};

/// The client's side, once it has seen the server's key. @return nothing if that server laid nothing down here
[[nodiscard]] std::expected<std::optional<LocalKeys>, std::string> find_local(const std::string& folder, const Pin& server);

}  // namespace tandem::trust
