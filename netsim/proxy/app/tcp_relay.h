#pragma once

#include <cstddef>
#include <memory>

#include "common/io/socket_address.h"
#include "common/io/tcp_listener.h"

namespace tandem::netsim {

/// Relays TCP connections to the server and back, unchanged. Clients join through the proxy's address; the pinned key
/// is still the server's. The simulated network applies only to datagrams; these connections use the computer's own
/// network.
class TcpRelay {
 public:
  static constexpr std::size_t kConnectionsMax = 512;

  /// Relays on its own thread until destruction.
  /// @param connections_max  further connections wait in the system's queue, as all do without a free descriptor
  TcpRelay(io::TcpListener listener, const io::SocketAddress& to, std::size_t connections_max = kConnectionsMax);
  ~TcpRelay();

 private:
  struct Work;
  std::unique_ptr<Work> work_;
};

}  // namespace tandem::netsim
