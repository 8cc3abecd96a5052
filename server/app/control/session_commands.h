#pragma once

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/auth/io/server_keystore.h"
#include "server/app/control/session_note.h"
#include "server/app/control/session_orders.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {

/// Executes the commands of joined control connections: drain here, orders about whole sessions on the thread that
/// takes them from SessionOrders, all others on the session's shard. It replies to
/// the client, and reports each executed or forbidden command to the other participants, the audit log, the log and the
/// operator of the server. All members run on the control plane's thread.
class SessionCommands {
 public:
  /// @param audit       writes the audit log
  /// @param on_message  receives executed commands, one line each, for the operator of the server
  SessionCommands(SessionRegistry& registry, auth::ServerKeystore& audit,
                  std::function<void(const std::string&)> on_message = {});

  /// Sets the queue of orders to create, end and record sessions, before any command. Without it, such orders are
  /// rejected.
  void set_orders(SessionOrders& orders) noexcept { orders_ = &orders; }
  /// Sets the receiver of marks and sheets, called on the control plane's thread. It returns why a note could not be
  /// stored; then the note is rejected.
  void set_on_note(std::function<std::string(const SessionNote&)> on_note) { on_note_ = std::move(on_note); }

  /// Executes a command whose role and kind have been checked (roles.h). @param joined the connection's Welcome
  void execute(const rpc::Welcome& joined, const WorkstationRow& workstation, rpc::Body command,
               std::function<void(rpc::Body)> answer);
  /// Rejects new joins from now on; all hands are released in `grace_s`. @param who requested it
  void drain(std::uint32_t grace_s, const std::string& who);
  /// Releases the seats and link-test slots of revoked workstations.
  void disconnect_revoked();

 private:
  /// Queues an order to create, end or record a session.
  void order(rpc::Body command, const std::string& who, const std::function<void(rpc::Body)>& answer);
  /// Adds the tickets of the named workstations to the reply of a created session, and audits both.
  void complete(rpc::SessionCreated& created, const rpc::CreateSession& wanted, const std::string& who);
  /// Tells participants, operator and audit log of a recording that was started or ended by an order.
  void conclude_recording(const rpc::RecordSession& order, const std::string& who);
  [[nodiscard]] std::optional<rpc::ErrorReply> holder_problem(const rpc::CreateSession& wanted) const;
  /// Replies to an executed command.
  /// @param who   workstation, role and seat of the client
  [[nodiscard]] rpc::Body conclude(SessionEntry& entry, const rpc::Welcome& joined, const std::string& workstation,
                                   const std::string& who, const ShardRequest& executed);
  void record(SessionEntry& entry, const std::string& who, const SessionCommand& command,
              const CommandOutcome& outcome);
  [[nodiscard]] rpc::Status status_of(const SessionEntry& entry, const rpc::Welcome& joined,
                                      const CommandOutcome& outcome) const;
  void release_seat(SessionEntry& entry, std::size_t seat);

  SessionRegistry& registry_;
  auth::ServerKeystore& audit_;
  std::function<void(const std::string&)> on_message_;
  std::function<std::string(const SessionNote&)> on_note_;
  SessionOrders* orders_ = nullptr;
};

}  // namespace tandem::server
