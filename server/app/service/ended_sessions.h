#pragma once

#include <string>
#include <vector>

#include "server/app/process/session_table.h"
#include "server/app/service/service_thread.h"

namespace tandem::server {

/// Orders to end sessions of a service that are over at this server. They are answered when the directory does not have
/// the session any more: until then another server could begin it again, and the operator would believe it closed.
class EndedSessions {
 public:
  static constexpr Duration kConfirmedMax = std::chrono::seconds(4);  ///< then the reply says that it is not confirmed

  /// @param id  of the run that is over  @param orders  that ended it
  void add(const std::string& session, const rpc::Id& id, std::vector<SessionOrder> orders, Time now);
  /// Answers those that are confirmed, or have waited too long.
  void step(Time now, ServiceThread& service, SessionTable& sessions);

 private:
  struct Ended {
    std::string session;
    rpc::Id id{};
    Time until{};
    SessionOrder order;
  };
  std::vector<Ended> waiting_;
};

}  // namespace tandem::server
