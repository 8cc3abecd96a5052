#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>

#include "common/auth/io/client_keystore.h"
#include "common/auth/io/server_keystore.h"

namespace tandem::auth {

/// Selects the identity that a client presents to a server (ClientTls::IdentityCallback). The server's key is known
/// before the client's is due, so one handshake suffices. The selector first searches the servers at which this
/// workstation is enrolled, by key: a server that moved keeps its key. A server with another key is accepted if it
/// belongs to a service that this workstation knows. It then searches the keys published by servers of the same user in
/// the runtime directory.
class IdentitySelector {
 public:
  /// @param address  the address the client connects to  @param own  nullopt: this workstation was never enrolled
  /// @param runtime  runtime_path()
  IdentitySelector(std::string address, std::optional<ClientKeystore> own, std::string runtime)
      : address_(std::move(address)), own_(std::move(own)), runtime_(std::move(runtime)) {}

  [[nodiscard]] std::expected<const Identity*, std::string> operator()(const PresentedKey& server);
  /// Sets the address of the next server, for errors.
  void set_address(std::string address) { address_ = std::move(address); }
  /// Returns the servers at which this workstation is enrolled; none if the list cannot be read.
  [[nodiscard]] std::vector<ServerRow> known() const {
    return own_ ? own_->servers().value_or(std::vector<ServerRow>{}) : std::vector<ServerRow>{};
  }
  /// Returns the key that was selected. @pre the selector was called and returned an identity
  [[nodiscard]] const KeyFingerprint& selected() const noexcept { return selected_; }
  /// Returns the published keys if they were selected, so that the client signs its own tickets; else null.
  [[nodiscard]] const LocalKeys* local() const noexcept { return local_ ? &*local_ : nullptr; }
  /// Returns the service of the newest accepted server, with the keys that it has proved; nullopt: it belongs to none.
  [[nodiscard]] const std::optional<ServicePin>& service() const noexcept { return service_; }
  /// Stores the service of the newest accepted server for later connections.
  /// @param members  HOST:PORT of servers of the service; empty: those known stay
  /// @return the error; empty if there is none, or nothing to store
  [[nodiscard]] std::string store_service(const std::vector<std::string>& members) const;

 private:
  [[nodiscard]] std::expected<const Identity*, std::string> find(const PresentedKey& server);
  /// Accepts a server by its service. @return nullopt: it is of none that this workstation knows, or why it is rejected
  [[nodiscard]] std::optional<std::expected<const Identity*, std::string>> find_member(
      const PresentedKey& server, const std::vector<ServerRow>& known);

  std::string address_;
  std::optional<ClientKeystore> own_;
  std::string runtime_;
  std::optional<LocalKeys> local_;
  KeyFingerprint selected_, server_;
  std::optional<ServicePin> service_, service_before_;  ///< with the newest handshake, and before it
};

/// Workstation that stands for all clients of the same user, at a server with ephemeral keys.
inline constexpr const char* kLocalWorkstation = "local";

/// The server's side on loopback: creates the workstation kLocalWorkstation, enrols it, and publishes its keys in
/// `runtime` until the result is destroyed.
[[nodiscard]] std::expected<RuntimeDirectory, std::string> publish_local_keys(ServerKeystore& server,
                                                                              const std::string& runtime,
                                                                              std::int64_t now);

}  // namespace tandem::auth
