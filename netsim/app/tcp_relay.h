#pragma once

#include <memory>

#include "common/io/socket_address.h"
#include "common/io/tcp_listener.h"

namespace tandem::netsim {

/// Passes TCP connections on to the server and back, bytes as they are: people join through the proxy's address, and its pinned key is
/// still the server's. The network that is played is that of the datagrams; these connections meet only the computer's own.
class TcpRelay {
 public:
  static constexpr std::size_t kConnectionsMax = 512;  ///< more wait in the system's queue

  /// Relays until it is destroyed, on a thread of its own.
  TcpRelay(io::TcpListener listener, const io::SocketAddress& to);
  ~TcpRelay();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tandem::netsim
