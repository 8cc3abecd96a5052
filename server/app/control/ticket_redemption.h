#pragma once

#include <expected>
#include <functional>
#include <optional>
#include <string>

#include "common/auth/io/server_keystore.h"
#include "server/app/control/join_handler.h"
#include "server/app/control/session_entry.h"
#include "server/app/control/ticket_uses.h"

namespace tandem::server {

/// Id in a ticket; not authenticated.
[[nodiscard]] std::optional<auth::Id16> claimed_id(const rpc::TicketCredential& ticket);

/// Redeems the tickets of joins, and makes them valid again if a join had no effect: at this server, and in its
/// service. Control plane's thread.
class TicketRedemption {
 public:
  /// @param trust       must outlive this
  /// @param on_message  receives failures of the server itself, one line each, for its operator
  TicketRedemption(auth::ServerKeystore& trust, std::function<void(const std::string&)> on_message)
      : trust_(trust), on_message_(std::move(on_message)) {}

  /// @param uses  of tickets in the service; must outlive this object; null: tickets are used at this server alone
  void set_uses(TicketUses* uses) noexcept { uses_ = uses; }
  /// Null: tickets are used at this server alone.
  [[nodiscard]] TicketUses* uses() const noexcept { return uses_; }

  /// @param role  of the seat; nullopt: any role, for a console
  /// @param now   of the monotonic clock
  [[nodiscard]] std::expected<auth::Ticket, rpc::ErrorReply> redeem(const SessionEntry& entry,
                                                                    const JoinRequest& request,
                                                                    const rpc::TicketCredential& ticket,
                                                                    std::optional<AccessRole> role, Time now);
  /// Error reply if the ticket is right in all else and was used before; nullopt if not. Uses nothing.
  [[nodiscard]] std::optional<rpc::ErrorReply> used(const SessionEntry& entry, const JoinRequest& request,
                                                    const rpc::TicketCredential& ticket, AccessRole role) const;
  /// @param person  name in the ticket, for the audit log  @param event  of the audit log
  void restore(const std::optional<auth::Id16>& ticket, const std::string& session, const std::string& person,
               const char* event = "ticket_unused");

 private:
  auth::ServerKeystore& trust_;
  TicketUses* uses_ = nullptr;
  std::function<void(const std::string&)> on_message_;
};

}  // namespace tandem::server
