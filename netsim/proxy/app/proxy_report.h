#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>

#include "netsim/profiles/app/network_options.h"
#include "netsim/proxy/app/proxy.h"
#include "netsim/proxy/app/proxy_control.h"
#include "netsim/proxy/app/proxy_events.h"
#include "netsim/proxy/app/proxy_status.h"

namespace tandem::netsim {

/// Data of a report in addition to the proxy's counters.
struct ProxyReportNotes {
  std::span<const ProxyClientQuality> qualities = {};
  std::span<const ProxyControl::Change> changes = {};  ///< made at run time by commands
  std::span<const ProxyEvent> events = {};             ///< events of --script and --outage
  bool interrupted = false;                            ///< ended before --duration was over
  std::optional<Duration> lateness_max = {};           ///< limit of --max-lateness
  std::uint64_t log_rows = 0, log_missed = 0;          ///< rows of --log
};

/// Returns whether lateness can be judged: --max-lateness was given and a datagram was sent.
[[nodiscard]] bool judged(const Proxy& proxy, const ProxyReportNotes& notes);
/// Returns whether the 99th percentile of lateness is within --max-lateness. True without this option; false with it if
/// no datagram was sent.
[[nodiscard]] bool in_time(const Proxy& proxy, const ProxyReportNotes& notes);

/// Status of a running proxy, as text and as one line of JSON.
[[nodiscard]] std::string status_text(const ProxyStatus& status);
[[nodiscard]] std::string status_json(const ProxyStatus& status, std::span<const ProxyControl::Change> changes);

/// After `run`: report as text, words first.
[[nodiscard]] std::string summary_text(const Proxy& proxy, const ProxyReportNotes& notes);

/// The same as JSON. Keys contain their units; later versions only add keys.
[[nodiscard]] std::string summary_json(const Proxy& proxy, const ProxyOptions& options, const NetworkChoice& network,
                                       const ProxyReportNotes& notes);

}  // namespace tandem::netsim
