#pragma once

#include <atomic>
#include <cstdint>

#include "common/base/time.h"
#include "netsim/proxy_core.h"
#include "netsim/script.h"

namespace tandem::netsim {

/// Something for the packet thread to do between two datagrams. Whoever posts it made it, waits for `done` and frees it:
/// memory is taken and given back outside the packet thread.
struct ProxyOrder {
  LinkChange links;                    ///< the new links; unused when `rebind` is there
  std::uint64_t number = 0;            ///< of the client whose address changes, by arrival, from 0
  std::optional<Rebind> rebind;        ///< the address changes
  Duration at{};                       ///< answer: when it was carried out, since the proxy's start
  bool carried_out = false;            ///< answer: false: there is no such client (any more)
  std::atomic<bool> done{false};
};

}  // namespace tandem::netsim
