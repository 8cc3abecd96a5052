#pragma once

#include <cstddef>

#include "common/io/datagram_batch.h"
#include "netsim/proxy/app/arrival_buffer.h"
#include "netsim/proxy/app/client_registry.h"
#include "netsim/proxy/app/proxy_clock.h"

namespace tandem::netsim {

/// Reads the sockets of a proxy and enters the datagrams into its core, with the kernel's times of arrival. Datagrams
/// of unknown senders enter in order of arrival, after the registry knows their clients.
class ProxyReceiver {
 public:
  /// All references must outlive the receiver.
  ProxyReceiver(ProxyCore& core, ProxyClients& clients, ClientRegistry& registry, const ProxyClock& clock,
                ProxyErrors& errors)
      : core_(core), clients_(clients), registry_(registry), clock_(clock), errors_(errors) {}

  /// Reads one batch of a socket, or all that unknown senders sent.
  /// @param now  time of reading, since the proxy's start
  /// @return number of datagrams read
  std::size_t read(ProxySource source, Duration now) noexcept;

 private:
  std::size_t read_unknown_senders(Duration now) noexcept;
  std::size_t receive_unknown_senders(int fd, Duration now) noexcept;
  std::size_t receive(int fd) noexcept;

  ProxyCore& core_;
  ProxyClients& clients_;
  ClientRegistry& registry_;
  const ProxyClock& clock_;
  ProxyErrors& errors_;
  io::ReceiveBatch in_;
  Duration
      read_at_{};  ///< time after the newest batch was read: datagrams may arrive while the thread pauses before it
  ArrivalBuffer arrivals_;
};

}  // namespace tandem::netsim
