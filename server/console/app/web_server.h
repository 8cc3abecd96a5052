#pragma once

#include <expected>
#include <functional>
#include <string>

#include "common/io/socket_address.h"
#include "server/console/app/live_source.h"

namespace tandem::console {

struct WebOptions {
  io::SocketAddress listen;  ///< loopback only
  int signals = -1;          ///< signalfd that ends the server
  std::string release;       ///< version of the program
};

/// Serves the page and the WebSocket /live until a signal arrives. One thread, the caller's.
/// @param started  called with the URL that has the one-time token, once the port is open
/// @return error: the port cannot be opened
[[nodiscard]] std::expected<void, std::string> run_web_server(
    const WebOptions& options, LiveSource& source, const std::function<void(const std::string& url)>& started);

}  // namespace tandem::console
