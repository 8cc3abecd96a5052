#pragma once

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/directory/ownership.h"
#include "server/directory/placement/server_record.h"
#include "server/service/fenced_writer.h"
#include "server/service/service_catalogue.h"
#include "server/service/service_keys.h"
#include "server/service/service_tickets.h"

namespace tandem::server {

/// Begins a request, and returns its number.
using BeginRequest = std::function<directory::OperationId(const directory::Request&)>;

/// The directory of a service as one server knows it: the names of its keys, copies of them, and the parts that write
/// there for this server.
struct ServiceDirectory {
  ServiceDirectory(std::string server, const std::string& prefix, directory::LeaseTimes times);
  ServiceDirectory(const ServiceDirectory&) = delete;  // `tickets` refers to `ownership`
  ServiceDirectory& operator=(const ServiceDirectory&) = delete;
  ~ServiceDirectory() = default;

  /// Name of this server.
  [[nodiscard]] const std::string& server() const noexcept { return ownership.server(); }
  /// The copies follow the store.
  [[nodiscard]] bool follows() const noexcept { return ownership.view().follows() && catalogue.follows(); }
  /// The copies follow the store, and this server is registered there.
  [[nodiscard]] bool ready() const noexcept { return ownership.keeper().registered() && follows(); }
  /// The copies were complete at least once.
  [[nodiscard]] bool known() const noexcept { return ownership.view().readings() > 0 && catalogue.readings() > 0; }
  /// Records of all servers by name, those that cannot be read left out.
  [[nodiscard]] std::map<std::string, directory::ServerRecord> members() const;
  /// Name of a session's owner, as far as known; empty: none.
  [[nodiscard]] std::string owner_of(std::string_view session) const;

  /// Takes a reply to a request of catalogue, tickets or writer. Returns whether it is one.
  bool on_reply(const directory::Reply& reply) {
    return catalogue.on_reply(reply) || tickets.on_reply(reply) || writer.on_reply(reply);
  }

  directory::DirectoryKeys names;
  ServiceKeys keys;
  directory::Ownership ownership;
  ServiceCatalogue catalogue;
  ServiceTickets tickets;
  FencedWriter writer;
};

}  // namespace tandem::server
