#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/io/state_directory.h"
#include "common/auth/registry.h"
#include "common/auth/ticket_key.h"
#include "common/auth/tls_key.h"

namespace tandem::auth {

/// Key store of a workstation: its key, and the servers at which it is enrolled.
class ClientKeystore {
 public:
  static constexpr const char* kKeyFile = "workstation_key.pem";
  static constexpr const char* kCertificateFile = "workstation_cert.pem";
  static constexpr const char* kServersFile = "servers.textproto";

  /// Opens the directory; creates it and the workstation's key where they are missing.
  [[nodiscard]] static std::expected<ClientKeystore, std::string> open_or_make(const std::string& path,
                                                                               std::int64_t now);
  /// @return nullopt if the directory or the key is missing: this workstation was never enrolled
  [[nodiscard]] static std::expected<std::optional<ClientKeystore>, std::string> open(const std::string& path);

  [[nodiscard]] const Identity& identity() const noexcept { return identity_; }
  [[nodiscard]] std::expected<std::vector<ServerRow>, std::string> servers() const;
  /// @return the error, empty if the data are on disk
  [[nodiscard]] std::string store_server(const ServerRow& server) const;
  /// Stores what a server of a service has proved: its service's keys and, unless empty, the addresses of members. It
  /// changes the rows of the service that was pinned so far, and that of the server itself.
  /// @param before  the pin so far; nullopt: none
  /// @param server  key of the server
  /// @return the error; empty if the data are on disk, or were there already
  [[nodiscard]] std::string store_service(const std::optional<ServicePin>& before, const KeyFingerprint& server,
                                          const ServicePin& pin, const std::vector<std::string>& members) const;

 private:
  ClientKeystore(StateDirectory folder, Identity identity)
      : folder_(std::move(folder)), identity_(std::move(identity)) {}
  static std::expected<std::optional<ClientKeystore>, std::string> read(StateDirectory folder);

  StateDirectory folder_;
  Identity identity_;
};

/// Keys that a server on loopback publishes for clients of the same user on the same machine. They are the key of a
/// workstation that the server enrolled itself, and the key that signs tickets. Such a client signs its own ticket. One
/// file per server, `HEX-OF-FINGERPRINT.local`.
struct LocalKeys {
  Identity workstation;
  TicketKey ticket_key;
};

/// The server's side: the file exists as long as this object.
class RuntimeDirectory {
 public:
  [[nodiscard]] static std::expected<RuntimeDirectory, std::string> publish(const std::string& folder,
                                                                            const KeyFingerprint& server,
                                                                            const LocalKeys& keys);
  ~RuntimeDirectory();
  RuntimeDirectory(RuntimeDirectory&& other) noexcept
      : folder_(std::move(other.folder_)), name_(std::exchange(other.name_, {})) {}
  RuntimeDirectory& operator=(RuntimeDirectory&&) = delete;

 private:
  RuntimeDirectory(StateDirectory folder, std::string name) : folder_(std::move(folder)), name_(std::move(name)) {}
  StateDirectory folder_;
  std::string name_;
};

/// The client's side: finds the keys of the server with this fingerprint. @return nullopt if that server published none
/// here
[[nodiscard]] std::expected<std::optional<LocalKeys>, std::string> find_local_keys(const std::string& folder,
                                                                                   const KeyFingerprint& server);

}  // namespace tandem::auth
