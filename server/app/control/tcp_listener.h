#pragma once

#include <asio/ip/tcp.hpp>
#include <expected>
#include <string>

#include "common/io/socket_address.h"

namespace tandem::server {

/// Converts the address of a TCP socket.
[[nodiscard]] io::SocketAddress socket_address_of(const asio::ip::tcp::endpoint& endpoint) noexcept;

/// Makes an acceptor listen on an address; its sockets do not block.
/// @param backlog  number of connections that may wait for `accept`
/// @param v6_only  an IPv6 address accepts no IPv4 connections
/// @return the address with the chosen port, or the error
[[nodiscard]] std::expected<io::SocketAddress, std::string> start_listening(asio::ip::tcp::acceptor& acceptor,
                                                                            const io::SocketAddress& at, int backlog,
                                                                            bool v6_only);

}  // namespace tandem::server
