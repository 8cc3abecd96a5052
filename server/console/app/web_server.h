#pragma once

#include <expected>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "common/io/socket_address.h"
#include "server/console/app/gateway.h"
#include "server/console/app/tls_files.h"

namespace tandem::console {

struct WebOptions {
  io::SocketAddress listen;       ///< without `tls`: loopback only
  std::optional<TlsFiles> tls{};  ///< empty: plain HTTP
  int signals = -1;               ///< signalfd that ends the server
  Gateway::Options gateway{};
};

/// Serves the page, signing in and the WebSocket /live until a signal arrives. One thread, the caller's.
/// @param started  called once the port is open. token: of the first URL, empty without a connection of its own; url:
/// without it
/// @return error: the port cannot be opened
[[nodiscard]] std::expected<void, std::string> run_web_server(
    const WebOptions& options, GatewayLinks links,
    const std::function<void(const std::string& url, const std::string& token)>& started);

}  // namespace tandem::console
