#pragma once

#include <boost/beast/http.hpp>
#include <chrono>
#include <memory>
#include <set>
#include <string>

#include "server/console/app/connection_slot.h"
#include "server/console/app/gateway.h"
#include "server/console/app/web_stream.h"

namespace tandem::console {

using Request = boost::beast::http::request<boost::beast::http::string_body>;

/// The WebSocket of one page.
class LiveSocket : public std::enable_shared_from_this<LiveSocket> {
 public:
  virtual ~LiveSocket() = default;
  virtual void on_news() = 0;
  /// Called twenty times per second.
  virtual void on_period(std::chrono::steady_clock::time_point now) = 0;
};
using LiveSockets = std::set<LiveSocket*>;

/// Accepts a WebSocket and serves it until it ends.
/// @param sockets  has the socket while it lives
/// @param person   null: this browser has no access. The socket closes with code 4401, because a page sees no HTTP
/// status
/// @param cookie   secret of the cookie
void open_live_socket(WebStream stream, const Request& request, Gateway& gateway, LiveSockets& sockets,
                      std::shared_ptr<Person> person, std::string cookie, ConnectionSlot slot);

}  // namespace tandem::console
