#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/socket_address.h"
#include "netsim/engine/decision_log.h"
#include "netsim/engine/schedule.h"
#include "netsim/models/path_spec.h"
#include "netsim/proxy/proxy_core.h"
#include "netsim/quality/link_summary.h"

/// Options and status of the live proxy.
namespace tandem::netsim {

/// Options of the live proxy.
struct ProxyOptions {
  io::SocketAddress listen;
  io::SocketAddress to;
  LinkSpec link;
  std::uint64_t seed = 1;
  Duration duration{};                  ///< 0: until `stop`
  Duration idle_limit{60'000'000'000};  ///< a client without a datagram for this time is removed
  std::vector<NetworkEvent> events;     ///< clients by number in order of arrival, from "1"
  bool monitor_quality = true;          ///< monitor the link quality of each client
  DecisionSink* sink = nullptr;         ///< receives every decision, on the packet thread
  Duration spin{};                      ///< busy-wait this long before a deadline instead of sleeping
  /// Minimum time between two rounds of sending, part of the lateness. Waking up costs more than sending, and datagrams
  /// of many clients are due at any time.
  Duration coalesce{80'000};
  Duration late_limit{100'000};  ///< a datagram sent later than this after its due time counts as late
};

/// Error counters that are not part of the simulated network.
struct ProxyErrors {
  std::uint64_t too_many_clients = 0;  ///< datagrams of clients beyond the 64th
  std::uint64_t too_long = 0;          ///< datagrams above 1500 bytes
  std::uint64_t kernel_drops = 0;      ///< the kernel's receive buffers were full
  std::uint64_t no_room = 0;           ///< the kernel's send buffers were full
  std::uint64_t refused = 0;           ///< the remote port was closed
  std::uint64_t other = 0;             ///< any other socket error
};

/// Status of one client.
struct ProxyClientStatus {
  std::uint64_t number = 0;  ///< by order of arrival, from 1
  std::uint32_t place = 0;   ///< index of its place, [0, ProxyCore::kClientsMax)
  sockaddr_storage address{};
  bool present = false;
  Duration arrived{};              ///< time at which its first datagram was read, since the proxy's start
  std::uint64_t kernel_drops = 0;  ///< its receive buffer was full: it sends more than this computer can carry
  std::array<PathCounters, kDirections> counters;
  std::array<Duration, kDirections> queue{};  ///< queue wait of a datagram that arrives now
};

/// Counters of the live proxy at one time.
struct ProxyStatus {
  Duration since_start{};
  std::uint64_t clients = 0;
  std::uint64_t clients_seen = 0;
  std::array<PathCounters, kDirections> total;
  ProxyErrors errors;
  std::uint64_t released = 0;  ///< datagrams handed to the kernel for sending
  std::uint64_t late = 0;      ///< number of these sent later than ProxyOptions::late_limit
  /// Connected clients in order of place; the first `clients` entries are valid.
  std::array<ProxyClientStatus, ProxyCore::kClientsMax> client{};
};

/// Link quality of one client for force feedback.
struct ProxyClientQuality {
  std::uint64_t number = 0;
  LinkSummary link;
};

}  // namespace tandem::netsim
