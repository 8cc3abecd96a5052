#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/engine/schedule.h"
#include "netsim/proxy/proxy_core.h"

namespace tandem::netsim {

/// Request to the packet thread, executed between two datagrams. The posting thread creates it, waits for `done` and
/// frees it, so that the packet thread allocates and frees nothing.
struct ProxyRequest {
  std::vector<LinkChange> changes = {};     ///< new links, applied in order at the same time
  std::vector<std::uint64_t> rebinds = {};  ///< clients by order of arrival, from 0, whose address changes
  Rebind rebind = {};
  Duration at{};          ///< result: time of execution since the proxy's start
  bool succeeded = true;  ///< result: false if a client to rebind is unknown or has too many addresses
  std::atomic<bool> done{false};
};

}  // namespace tandem::netsim
