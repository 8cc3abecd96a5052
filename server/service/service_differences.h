#pragma once

#include <map>
#include <string>
#include <vector>

#include "server/service/service_member.h"

namespace tandem::server {

/// Returns the differences of a session as a server's configuration has it and as the service runs it: duration, entry,
/// `restart`, and the first line of the scene that differs, for users. Empty: nothing. Ids and codes do not count.
[[nodiscard]] std::string difference_text(const ServiceSession& configured, const ServiceSession& running);

/// Finds configured sessions that other servers of the service run in another form. Pure.
class ServiceDifferences {
 public:
  struct Difference {
    std::string session;
    std::string text;  ///< the differences, the session that holds, and the next step
  };
  /// @param server      name of this server  @param configured  its sessions, by name
  ServiceDifferences(std::string server, std::map<std::string, ServiceSession> configured)
      : server_(std::move(server)), waiting_(std::move(configured)) {}

  /// Returns differences that were not known before: each session is compared once, when another server is known to
  /// own it. Costs nothing once all are compared.
  [[nodiscard]] std::vector<Difference> update(const ServiceMember& member);

 private:
  std::string server_;
  std::map<std::string, ServiceSession> waiting_;  ///< not compared yet
};

}  // namespace tandem::server
