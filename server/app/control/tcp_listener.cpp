#include "server/app/control/tcp_listener.h"

#include <asio/ip/v6_only.hpp>
#include <cstring>

namespace tandem::server {

using asio::ip::tcp;

io::SocketAddress socket_address_of(const tcp::endpoint& endpoint) noexcept {
  io::SocketAddress address{.size = static_cast<socklen_t>(endpoint.size())};
  std::memcpy(&address.storage, endpoint.data(), endpoint.size());
  return address;
}

std::expected<io::SocketAddress, std::string> start_listening(tcp::acceptor& acceptor, const io::SocketAddress& at,
                                                              int backlog, bool v6_only) {
  tcp::endpoint endpoint;
  endpoint.resize(at.size);
  std::memcpy(endpoint.data(), at.get(), at.size);
  asio::error_code error;
  acceptor.open(endpoint.protocol(), error);
  if (!error) acceptor.set_option(tcp::acceptor::reuse_address(true), error);
  if (!error && v6_only && endpoint.protocol() == tcp::v6()) acceptor.set_option(asio::ip::v6_only(true), error);
  if (!error) acceptor.bind(endpoint, error);
  if (!error) acceptor.listen(backlog, error);
  if (!error) acceptor.non_blocking(true, error);
  if (!error) endpoint = acceptor.local_endpoint(error);
  if (error) return std::unexpected("cannot listen on " + io::to_text(at) + ": " + error.message());
  return socket_address_of(endpoint);
}

}  // namespace tandem::server
