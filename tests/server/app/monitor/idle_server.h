#pragma once

#include "server/app/control/session_joins.h"
#include "server/app/monitor/metrics.h"

namespace tandem::server::test {

/// The parts of a server of which its monitoring tells, without sessions, tick threads and clients.
struct IdleServer {
  /// @param service  null: the server is alone
  [[nodiscard]] HttpResponse page(std::string_view path, const ServiceStatus* service) const {
    return monitoring_page(path, registry, plane, audit, service);
  }

  asio::io_context context;
  auth::ServerKeystore keys = auth::ServerKeystore::ephemeral(auth::wall_seconds());
  SessionRegistry registry{context};
  SessionCommands commands{registry, keys};
  SessionJoins joins{registry, commands, keys};
  ControlPlane plane{context, keys, joins};
  AuditState audit;
};

/// Status of a member that serves a session, and whose directory answers.
[[nodiscard]] inline ServiceStatus status_of_member() {
  ServiceStatus status;
  status.registered = status.follows = status.answers = true;
  status.holding = false;
  status.lease_age_s = 0.25;
  status.owned = status.sessions = 1;
  status.members = 2;
  status.voucher_ends = 1798761599;
  return status;
}

}  // namespace tandem::server::test
