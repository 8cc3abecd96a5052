#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "server/app/control/join_handler.h"

namespace tandem::server {

/// Uses of tickets in a service of several servers: each ticket once in the whole service. Control plane's thread.
class TicketUses {
 public:
  enum class Outcome : std::uint8_t {
    kAccepted,
    kUsed,      ///< used before, at another server of the service
    kNoAnswer,  ///< the directory does not answer; the ticket is as valid as before
  };
  virtual ~TicketUses() = default;
  /// Uses a ticket that this server has redeemed. @param life_s  for which it stays valid
  /// @param again  in the place of its use at a former owner of the session, which has ended
  /// @param done   called later on the control plane's thread, once
  virtual void use(const std::string& session, const auth::Id16& ticket, std::int64_t life_s, bool again,
                   std::function<void(Outcome)> done) = 0;
  /// Makes a ticket that this server has used valid again.
  virtual void restore(const std::string& session, const auth::Id16& ticket) = 0;
};

/// Returns the reply to a join as it is sent when the ticket of a Welcome is used in the whole service: later, and an
/// error if it was used before. Other replies pass at once.
/// @param uses    null: the server belongs to no service, and `answer` is returned
/// @param failed  frees the seat of a Welcome that is not sent
/// @param again   whether the ticket of a Welcome was used at a former owner of the session, and returns
[[nodiscard]] std::function<void(JoinReply)> used_once(TicketUses* uses, const JoinRequest& request,
                                                       std::function<void(JoinReply)> answer,
                                                       std::function<void(const rpc::Welcome&)> failed,
                                                       std::function<bool(const rpc::Welcome&)> again);

}  // namespace tandem::server
