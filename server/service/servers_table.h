#pragma once

#include <map>
#include <optional>
#include <string>

#include "server/directory/directory_view.h"
#include "server/service/service_catalogue.h"

namespace tandem::server {

/// Rest of leases, as far as the directory has told it: nullopt: the lease has ended.
using LeaseRests = std::map<directory::LeaseId, std::optional<Duration>>;

/// Table of the servers of a service: address, version with a mark where another server has a newer one, zone, load,
/// number of sessions that it owns and of those for which it is the standby, rest of its lease, end of the voucher;
/// then the sessions that no server owns, and those without standby if there are several servers. Ends with a line
/// break.
[[nodiscard]] std::string servers_table(const directory::DirectoryView& view, const ServiceCatalogue& catalogue,
                                        const LeaseRests& rests);

}  // namespace tandem::server
