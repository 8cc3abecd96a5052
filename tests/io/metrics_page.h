#pragma once

#include <sys/socket.h>
#include <sys/time.h>

#include <array>
#include <string>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::test {

/// Response of a metrics server, with its header; empty: none.
inline std::string page(const std::string& address, const std::string& path = "/metrics") {
  const auto to = io::parse_address(address, 1);
  const io::Fd socket{::socket(to->family(), SOCK_STREAM | SOCK_CLOEXEC, 0)};
  if (::connect(socket.get(), to->get(), to->size) != 0) return "";
  const timeval limit{5, 0};  // a server that was stopped accepts, and does not answer
  ::setsockopt(socket.get(), SOL_SOCKET, SO_RCVTIMEO, &limit, sizeof limit);
  const std::string ask = "GET " + path + " HTTP/1.1\r\nHost: localhost\r\n\r\n";
  ::send(socket.get(), ask.data(), ask.size(), MSG_NOSIGNAL);
  std::string answer;
  std::array<char, 4096> part;
  for (ssize_t n = 0; (n = ::recv(socket.get(), part.data(), part.size(), 0)) > 0;)
    answer.append(part.data(), static_cast<std::size_t>(n));
  return answer;
}

}  // namespace tandem::test
