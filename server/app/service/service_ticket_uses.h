#pragma once

#include <functional>
#include <map>
#include <mutex>
#include <string>

#include "server/app/control/control_server.h"
#include "server/app/control/ticket_uses.h"
#include "server/app/service/service_thread.h"

namespace tandem::server {

/// Uses tickets through the directory of a service.
class ServiceTicketUses final : public TicketUses {
 public:
  /// Both must outlive this.
  ServiceTicketUses(ServiceThread& thread, ControlServer& control) : thread_(thread), control_(control) {}

  void use(const std::string& session, const auth::Id16& ticket, std::int64_t life_s, bool again,
           std::function<void(Outcome)> done) override;
  void restore(const std::string& session, const auth::Id16& ticket) override;
  /// Takes a result, on the service's thread.
  void on_result(const ServiceTickets::Result& result);

 private:
  ServiceThread& thread_;
  ControlServer& control_;
  std::mutex lock_;
  std::map<std::uint64_t, std::function<void(Outcome)>> waiting_;  ///< by order
  std::uint64_t newest_ = 0;
};

}  // namespace tandem::server
