#pragma once

#include <expected>
#include <optional>
#include <string>

#include "common/io/socket_address.h"
#include "common/trust/io/client_trust.h"

namespace tandem::client {

/// Whether a server's key is one that this client may talk to, and which key it shows it: that of this workstation, where it was enrolled
/// there; or, at a loopback address, the one that the server laid down for its own user.
class KnownServers {
 public:
  /// @param state   folder as typed; empty: the usual place  @param server  where it was dialled
  KnownServers(std::string state, const io::SocketAddress& server) : state_(std::move(state)), server_(server) {}

  /// For ControlClient: called in the handshake, before anything of value was sent.
  [[nodiscard]] std::expected<const trust::Identity*, std::string> judge(const trust::Pin& pin);
  /// After `judge`: what was laid down; null where the workstation is enrolled.
  [[nodiscard]] const trust::LocalKeys* local() const noexcept { return local_ ? &*local_ : nullptr; }

 private:
  std::string state_;
  io::SocketAddress server_;
  std::optional<trust::ClientTrust> enrolled_;
  std::optional<trust::LocalKeys> local_;
};

}  // namespace tandem::client
