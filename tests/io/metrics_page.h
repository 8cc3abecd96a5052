#pragma once

#include <sys/socket.h>

#include <array>
#include <string>
#include <string_view>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::test {

/// A page of a metrics server; empty: none.
inline std::string page(const std::string& address) {
  const auto to = io::parse_address(address, 1);
  const io::Fd socket{::socket(to->family(), SOCK_STREAM | SOCK_CLOEXEC, 0)};
  if (::connect(socket.get(), to->get(), to->size) != 0) return "";
  constexpr std::string_view kAsk = "GET /metrics HTTP/1.1\r\nHost: x\r\n\r\n";
  ::send(socket.get(), kAsk.data(), kAsk.size(), MSG_NOSIGNAL);
  std::string answer;
  std::array<char, 4096> part;
  for (ssize_t n = 0; (n = ::recv(socket.get(), part.data(), part.size(), 0)) > 0;) answer.append(part.data(), static_cast<std::size_t>(n));
  return answer;
}

}  // namespace tandem::test
