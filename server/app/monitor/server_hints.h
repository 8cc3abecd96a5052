#pragma once

#include <string>

#include "common/auth/io/state_directory.h"
#include "common/base/command_hints.h"
#include "common/io/reachable_address.h"

namespace tandem::server {

/// Options with which printed commands find a server and its sessions.
class ServerHints {
 public:
  /// @param at              address of the control connections
  /// @param folder          the server's state directory
  /// @param ephemeral_keys  clients need no ticket, and `tandem-server` commands do not know this server
  /// @param several         it serves several sessions
  ServerHints(const io::SocketAddress& at, std::string folder, bool ephemeral_keys, bool several)
      : client_address_(shell_quote(io::reachable_address(at))),
        folder_(std::move(folder)),
        ephemeral_keys_(ephemeral_keys),
        several_(several) {}

  /// From now on the server serves several sessions.
  void set_several() noexcept { several_ = true; }
  [[nodiscard]] bool several() const noexcept { return several_; }

  /// Options with which a client command finds a session.
  [[nodiscard]] std::string client_options(const std::string& session) const {
    return " --server " + client_address_ + (several_ ? " --session " + session : "") +
           (ephemeral_keys_ ? "" : " --ticket-file FILE");
  }
  /// Command that lists all sessions of this server.
  [[nodiscard]] std::string list_command() const {
    return ephemeral_keys_ ? "tandem-client sessions --server " + client_address_
                           : "tandem-server sessions" + auth::server_state_option(folder_);
  }
  /// Start of a line about a session, which names it if there are several.
  [[nodiscard]] std::string prefix(const std::string& session) const { return several_ ? session + ": " : ""; }

 private:
  std::string client_address_, folder_;
  bool ephemeral_keys_, several_;
};

}  // namespace tandem::server
