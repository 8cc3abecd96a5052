#pragma once

#include <span>
#include <string>
#include <vector>

#include "netsim/app/proxy_status.h"
#include "netsim/event_times.h"

namespace tandem::netsim {

/// What became of something that the command line or its script asked of a proxy.
struct ProxyEvent {
  enum class Fate : std::uint8_t {
    kCame,
    kGoesOn,      ///< was not over when the proxy ended
    kMetNobody,   ///< its time came, but none of those it was for was there
    kNeverCame,   ///< the proxy ended before
  };
  EventTime event;
  Fate fate = Fate::kCame;
  std::string why;  ///< for people, of all fates but kCame
};
/// `came`, `goes on`, `met nobody`, `never came`
[[nodiscard]] const char* name(ProxyEvent::Fate fate) noexcept;

/// By time.
/// @param clients  all there ever were; those beyond the first thousand that left are not known and count as there
/// @param seen     how many there ever were
/// @param end      of the proxy, since its start
[[nodiscard]] std::vector<ProxyEvent> proxy_events(const ProxyOptions& options, std::span<const ProxyClientStatus> clients,
                                                   std::uint64_t seen, Duration end);

/// One line each: `  event at 12.000 s: outage of 400 ms, for client 1`, and why when it did not come.
[[nodiscard]] std::string events_text(std::span<const ProxyEvent> events);

}  // namespace tandem::netsim
