#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "netsim/app/network_options.h"
#include "netsim/app/proxy.h"
#include "netsim/app/proxy_control.h"
#include "netsim/app/proxy_events.h"
#include "netsim/app/proxy_status.h"

namespace tandem::netsim {

/// What a report tells besides what the proxy counted.
struct ProxyReportNotes {
  std::span<const ProxyClientQuality> qualities = {};
  std::span<const ProxyControl::Note> changes = {};  ///< made while it ran
  std::span<const ProxyEvent> events = {};           ///< of --script and --outage
  bool interrupted = false;                          ///< before the end of --duration
  std::optional<Duration> lateness_max = {};         ///< --max-lateness
  std::uint64_t log_rows = 0, log_missed = 0;        ///< --log
};

/// Whether there is something to judge: a --max-lateness and a datagram that was sent.
[[nodiscard]] bool judged(const Proxy& proxy, const ProxyReportNotes& notes);
/// Whether the 99th percentile of lateness is within what was asked. A limit that nothing was held against is not kept.
[[nodiscard]] bool in_time(const Proxy& proxy, const ProxyReportNotes& notes);

/// Of a proxy that runs: for people, and one line of JSON.
[[nodiscard]] std::string status_text(const ProxyStatus& status);
[[nodiscard]] std::string status_json(const ProxyStatus& status, std::span<const ProxyControl::Note> changes);

/// After `run`: what happened, in words first.
[[nodiscard]] std::string summary_text(const Proxy& proxy, const ProxyReportNotes& notes);

/// The same for machines; keys carry their units and are only ever added to.
[[nodiscard]] std::string summary_json(const Proxy& proxy, const ProxyOptions& options, const NetworkChoice& network,
                                       const ProxyReportNotes& notes);

}  // namespace tandem::netsim
