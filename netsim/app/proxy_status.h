#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "common/base/time.h"
#include "common/io/socket_address.h"
#include "netsim/decision_log.h"
#include "netsim/path_spec.h"
#include "netsim/proxy_core.h"
#include "netsim/quality_summary.h"
#include "netsim/script.h"

/// What goes into the live proxy and what it tells about itself.
namespace tandem::netsim {

struct ProxyOptions {
  io::SocketAddress listen;
  io::SocketAddress to;
  LinkSpec link;
  std::uint64_t seed = 1;
  Duration duration{};                  ///< 0: until told to stop
  Duration idle_limit{60'000'000'000};  ///< a client without a datagram for so long is forgotten
  std::vector<NetworkEvent> events;     ///< clients by number in order of arrival, from "1"
  bool watch_quality = true;            ///< judge what each client's link was like
  DecisionSink* sink = nullptr;         ///< told every decision, on the packet thread
  Duration spin{};                      ///< so long before a deadline it watches the clock instead of sleeping
  /// After a round of sending the next begins so much later at the earliest: waking up costs more than sending, and
  /// datagrams of many clients are due at any moment. Part of the lateness.
  Duration coalesce{80'000};
  Duration late_limit{100'000};  ///< a datagram released later than this after its moment counts as late
};

/// What the proxy met besides the network it plays.
struct ProxyTroubles {
  std::uint64_t too_many_clients = 0;  ///< datagrams of clients beyond the 64th
  std::uint64_t too_long = 0;          ///< datagrams above 1500 bytes
  std::uint64_t kernel_drops = 0;      ///< the kernel's receive buffers were full
  std::uint64_t no_room = 0;           ///< the kernel's send buffers were full
  std::uint64_t refused = 0;           ///< nobody listened at the other end
  std::uint64_t other = 0;             ///< anything else a socket said
};

/// One client, in numbers.
struct ProxyClientStatus {
  std::uint64_t number = 0;  ///< in order of arrival, from 1
  std::uint32_t place = 0;   ///< in the house, [0, ProxyCore::kClientsMax)
  sockaddr_storage address{};
  bool present = false;
  Duration came{};                 ///< when its first datagram was read, since the proxy's start
  std::uint64_t kernel_drops = 0;  ///< its socket's buffer was full: it sends more than this computer can carry
  std::array<PathCounters, kDirections> counters;
  std::array<Duration, kDirections> queue{};  ///< how long what comes now would wait in the rate's queue
};

struct ProxyStatus {
  Duration since_start{};
  std::uint64_t clients = 0;
  std::uint64_t clients_seen = 0;
  std::array<PathCounters, kDirections> total;
  ProxyTroubles troubles;
  std::uint64_t released = 0;  ///< datagrams handed to the kernel for sending
  std::uint64_t late = 0;      ///< of these, later than ProxyOptions::late_limit
  /// Those present, in order of place; the first `clients` entries count.
  std::array<ProxyClientStatus, ProxyCore::kClientsMax> client{};
};

/// How good one client's link was for force feedback.
struct ProxyClientQuality {
  std::uint64_t number = 0;
  LinkSummary link;
};

}  // namespace tandem::netsim
