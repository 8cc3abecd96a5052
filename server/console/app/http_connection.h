#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "common/auth/origin.h"
#include "server/console/app/gateway.h"
#include "server/console/app/http_slots.h"
#include "server/console/app/live_socket.h"
#include "server/console/app/tls_files.h"
#include "server/console/app/web_stream.h"

namespace tandem::console {

/// State that all connections share. It outlives them.
struct WebState {
  Gateway& gateway;
  const TlsFiles* tls;  ///< null: without TLS
  HttpSlots http;
  std::uint16_t port = 0;
  std::size_t live = 0, audience = 0, strangers = 0;  ///< open WebSockets; `strangers`: without a valid cookie
  LiveSockets sockets{};
};
inline constexpr std::size_t kHttpMax = 64, kLiveMax = 64;  ///< open connections, without those of the audience
inline constexpr std::size_t kStrangersMax = 16;            ///< WebSockets until their browser has read why they end

/// Serves the HTTP requests of one connection: the page, signing in, and the begin of a WebSocket.
/// @param from  address of the browser
void serve_http(WebStream stream, WebState& state, const auth::Origin& from);

}  // namespace tandem::console
