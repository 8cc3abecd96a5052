#pragma once

#include <atomic>
#include <cstdint>
#include <optional>
#include <vector>

#include "common/base/time.h"
#include "netsim/proxy_core.h"
#include "netsim/script.h"

namespace tandem::netsim {

/// Something for the packet thread to do between two datagrams. Whoever posts it made it, waits for `done` and frees
/// it: memory is taken and given back outside the packet thread.
struct ProxyOrder {
  std::vector<LinkChange> links = {};       ///< new links, one after the other at the same moment
  std::vector<std::uint64_t> rebinds = {};  ///< clients by arrival, from 0, whose address changes
  Rebind rebind = {};
  Duration at{};            ///< answer: when it was carried out, since the proxy's start
  bool carried_out = true;  ///< answer: false: a client to rebind is not there (any more), or had too many addresses
  std::atomic<bool> done{false};
};

}  // namespace tandem::netsim
