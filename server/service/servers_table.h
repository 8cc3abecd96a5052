#pragma once

#include <map>
#include <string>

#include "server/directory/directory_view.h"
#include "server/service/service_catalogue.h"

namespace tandem::server {

/// Table of the servers of a service: address, version, zone, load, sessions, end of the voucher, and the sessions that
/// no server owns. Ends with a line break.
[[nodiscard]] std::string servers_table(const directory::DirectoryView& view, const ServiceCatalogue& catalogue);

}  // namespace tandem::server
