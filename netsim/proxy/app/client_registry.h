#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "netsim/proxy/app/client_pool.h"
#include "netsim/proxy/app/live_delay_histogram.h"
#include "netsim/proxy/app/proxy_clients.h"
#include "netsim/proxy/app/proxy_status.h"
#include "netsim/proxy/proxy_core.h"
#include "netsim/quality/link_monitor.h"

namespace tandem::netsim {

/// Registry of a proxy's clients: it admits, recognises and removes them, and keeps the reports of those that left.
class ClientRegistry {
 public:
  /// All references must outlive the registry.
  ClientRegistry(ProxyCore& core, ProxyClients& clients, ClientDelays& delays, ProxyErrors& errors,
                 const ProxyOptions& options);

  /// Returns the place of the client with this address. Admits an unknown sender, or takes it as the reconnect of a
  /// silent client of the same host.
  /// @param local  local address to which the client sent
  /// @return empty if there is no place, or the system provides no sockets
  [[nodiscard]] std::optional<std::uint32_t> identify(const sockaddr_storage& from, const io::LocalAddress& local,
                                                      Duration now) noexcept;
  /// Removes idle clients and closes the sockets of dead addresses.
  void maintain(Duration now) noexcept;

  /// Adds connected clients and kernel drops to the status.
  void fill(ProxyStatus& status, Duration now) const noexcept;
  /// Returns all connected clients and the first 1024 clients that left.
  [[nodiscard]] std::vector<ProxyClientStatus> reports(Duration now) const;
  /// Returns the link quality of the first ProxyCore::kClientsMax clients.
  [[nodiscard]] std::vector<ProxyClientQuality> qualities() const;
  /// Returns the pool of prepared clients.
  [[nodiscard]] ClientPool& pool() noexcept { return pool_; }

 private:
  struct MonitoredClient {
    std::uint64_t number = 0;
    std::unique_ptr<LinkMonitor> monitor;
  };
  [[nodiscard]] std::optional<std::uint32_t> admit(const io::PeerKey& key, const sockaddr_storage& from,
                                                   const io::LocalAddress& local, Duration now) noexcept;
  void remove(std::uint32_t place, Duration now) noexcept;
  [[nodiscard]] ProxyClientStatus status_of(std::uint32_t place, Duration now) const noexcept;

  ProxyCore& core_;
  ProxyClients& clients_;
  ClientDelays& delays_;
  ProxyErrors& errors_;
  Duration idle_limit_;
  ClientPool pool_;
  std::vector<MonitoredClient> monitored_;  ///< by order of arrival; never above the reserved capacity, 0: none
  std::vector<ProxyClientStatus> departed_;
  std::uint64_t departed_drops_ = 0;  ///< kernel drops of clients that left
};

}  // namespace tandem::netsim
