#pragma once

#include <fcntl.h>
#include <sys/resource.h>
#include <sys/socket.h>

#include <algorithm>
#include <string>

#include "common/io/fd.h"
#include "common/io/socket_address.h"

namespace tandem::server::test {

/// Returns a silent TCP connection from a given address of this computer; all of 127.0.0.0/8 is local.
inline io::Fd silent_from(const std::string& host, const io::SocketAddress& to) {
  io::Fd fd{::socket(AF_INET, SOCK_STREAM | SOCK_CLOEXEC | SOCK_NONBLOCK, 0)};
  const linger at_once{1, 0};  // no port stays in TIME_WAIT
  setsockopt(fd.get(), SOL_SOCKET, SO_LINGER, &at_once, sizeof at_once);
  const auto from = *io::parse_address(host + ":0", 0);
  if (::bind(fd.get(), from.get(), from.size) != 0) return {};
  static_cast<void>(::connect(fd.get(), to.get(), to.size));
  return fd;
}

/// Raises the descriptor limit, for both ends of many connections in one process. @return the new limit
inline std::size_t many_descriptors() {
  rlimit limit{};
  getrlimit(RLIMIT_NOFILE, &limit);
  limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, 16384);
  setrlimit(RLIMIT_NOFILE, &limit);
  return limit.rlim_cur;
}

}  // namespace tandem::server::test
