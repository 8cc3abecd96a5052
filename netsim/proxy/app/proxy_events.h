#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/engine/event_times.h"
#include "netsim/proxy/app/proxy_status.h"

namespace tandem::netsim {

/// Result of an event requested by the command line or its script.
struct ProxyEvent {
  enum class Fate : std::uint8_t {
    kApplied,
    kStillActive,  ///< still active when the proxy ended
    kNoTarget,     ///< its time came while none of its clients was connected
    kNotReached,   ///< the proxy ended earlier
  };
  EventTime event;
  Fate fate = Fate::kApplied;
  std::string reason;  ///< text; empty for kApplied
};
/// Returns `applied`, `unfinished`, `no-target` or `not-reached`.
[[nodiscard]] const char* name(ProxyEvent::Fate fate) noexcept;

/// Returns the results of all events, sorted by time.
/// @param clients  all clients ever connected. Clients beyond the first 1024 that left are missing here and count
/// as connected
/// @param seen     number of clients ever connected
/// @param end      end of the proxy, since its start
[[nodiscard]] std::vector<ProxyEvent> proxy_events(const ProxyOptions& options,
                                                   std::span<const ProxyClientStatus> clients, std::uint64_t seen,
                                                   Duration end);

/// Returns one line per event, with the reason if it was not applied: `  event at 12.000 s: outage of 400 ms, for
/// client 1`.
[[nodiscard]] std::string events_text(std::span<const ProxyEvent> events);

}  // namespace tandem::netsim
