#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <variant>
#include <vector>

#include "common/auth/exporter_context.h"
#include "common/auth/io/server_keystore.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Request to join. The workstation is enrolled at the time of the request and has proved its key.
struct JoinRequest {
  rpc::Hello hello;
  WorkstationRow workstation;
  std::string address;                            ///< of the peer, for logs
  std::uint32_t version = rpc::kProtocolVersion;  ///< of the protocol: the newest that both ends support
};

/// Elsewhere only for clients of version 3.
using JoinReply = std::variant<rpc::Welcome, rpc::ErrorReply, rpc::Elsewhere>;

/// Decides about sessions and seats. All calls come from the control plane's thread; none may block. A reply may come
/// at once or later, from any thread, exactly once, and only while the control plane's io_context exists. Tickets are
/// redeemed by `TicketRedeemer::redeem` on the control plane's thread, as late as possible. A redeemed ticket is used,
/// unless `TicketRedeemer::restore` makes it valid again after a failed join.
class JoinHandler {
 public:
  virtual ~JoinHandler() = default;

  /// Resolves session and seat and checks the credential. With a Welcome the seat is reserved from now on.
  virtual void admit(const JoinRequest& request, std::function<void(JoinReply)> answer) = 0;
  /// Called just before a Welcome is sent, with the secrets of the seat's datagrams. Datagrams under these keys may
  /// arrive from now on.
  virtual void on_joined(const JoinRequest& request, const rpc::Welcome& welcome,
                         const Secret<auth::kExportSize>& secrets) = 0;
  /// A Welcome could not be sent: the seat is free again.
  virtual void on_join_failed(const rpc::Welcome& welcome) = 0;

  /// Whether a server of the service is about to serve this session: a request for it is better decided a moment later.
  [[nodiscard]] virtual bool is_coming(const rpc::SessionChoice&) { return false; }
  /// Whether workstations that other servers of the service enrol become known here. A request of an unknown one is
  /// then better decided a moment later.
  [[nodiscard]] virtual bool learns_enrolments() const { return false; }
  /// One page of the list of sessions.
  [[nodiscard]] virtual rpc::SessionList list(const rpc::SessionListRequest& request) = 0;
  /// Addresses of the servers of the service, at most rpc::kMembersMax; empty: this server belongs to none.
  [[nodiscard]] virtual std::vector<std::string> members() const { return {}; }

  /// Executes a command of a joined connection: stop, pause, resume, authority, remove, status, drain. Replies with
  /// Ok, Status, AuthorityReply or ErrorReply.
  /// @param joined  the Welcome of the connection
  virtual void command(const rpc::Welcome& joined, const WorkstationRow& workstation, rpc::Body command,
                       std::function<void(rpc::Body)> answer) = 0;
  /// Whether a Welcome is still valid: the seat was not resumed elsewhere or taken away, and the session is not over.
  /// Otherwise the connection counts as one that never joined.
  [[nodiscard]] virtual bool is_current(const rpc::Welcome& joined) const = 0;
  /// The control connection of a joined client has ended. A seat stays occupied while its datagrams arrive.
  /// @param in_vain  all its commands except status queries were rejected, so its ticket may become valid again
  virtual void on_disconnected(const rpc::Welcome& joined, bool in_vain) = 0;
};

/// Reply to a rejected ticket.
[[nodiscard]] inline rpc::ErrorReply ticket_error_reply(const auth::TicketRedeemer::Failure& failure) {
  if (failure.fault) return {rpc::ErrorCode::kTicket, failure.text, 0};
  return {rpc::ErrorCode::kInternal,
          "the server cannot record that a ticket is used, so it accepts no tickets; the ticket stays valid. Ask the "
          "administrator of the server: its log has the cause",
          0};
}

}  // namespace tandem::server
