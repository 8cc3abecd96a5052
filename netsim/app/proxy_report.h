#pragma once

#include <string>

#include "netsim/app/network_options.h"
#include "netsim/app/proxy.h"

namespace tandem::netsim {

/// One line for a terminal: clients, datagrams per second each way since `before`, lost, mean delay.
[[nodiscard]] std::string status_line(const ProxyStatus& now, const ProxyStatus& before);

/// What happened, in words first.
[[nodiscard]] std::string summary_text(const Proxy& proxy);

/// The same for machines; keys carry their units and are only ever added to.
[[nodiscard]] std::string summary_json(const Proxy& proxy, const ProxyOptions& options, const NetworkChoice& network);

}  // namespace tandem::netsim
