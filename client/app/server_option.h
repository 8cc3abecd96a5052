#pragma once

#include <optional>
#include <string>
#include <vector>

#include "common/io/socket_address.h"

namespace tandem::client {

/// What a person gave as `--server`; nullopt and one more mistake if it cannot be used.
[[nodiscard]] inline std::optional<io::SocketAddress> server_option(const std::string& text, std::vector<std::string>& mistakes) {
  const auto server = io::parse_address(text, 1);
  if (!server) {
    mistakes.push_back("--server: " + server.error());
    return std::nullopt;
  }
  if (!server->loopback()) {
    mistakes.push_back("--server: " + io::to_text(*server) +
                       " is not on this computer and is refused: sealed sessions do not exist yet, nobody could tell the server "
                       "from somebody else who moves your hand. Use the 127.0.0.1:PORT that tandem-server prints");
    return std::nullopt;
  }
  return *server;
}

}  // namespace tandem::client
