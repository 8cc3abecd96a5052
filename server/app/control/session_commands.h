#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>

#include "common/auth/io/server_keystore.h"
#include "common/base/time.h"
#include "common/io/clock.h"
#include "server/app/control/held_replies.h"
#include "server/app/control/session_note.h"
#include "server/app/control/session_orders.h"
#include "server/app/control/session_registry.h"

namespace tandem::server {

/// Executes the commands of joined control connections: drain and lists of notes here, orders about whole sessions on
/// the thread that takes them from SessionOrders, all others on the session's shard. It replies to the client, and
/// reports each executed or forbidden command to the other participants, the audit log, the log and the operator of the
/// server. All members run on the control plane's thread.
///
/// Stops, pauses and resumes act at once. Their replies wait until a restart would restore them, at most kStoredWait,
/// and say so if it would not.
class SessionCommands {
 public:
  static constexpr Duration kStoredWait = std::chrono::seconds(1);
  /// The same for a resume: a console sends its next order, perhaps a stop, after the reply.
  static constexpr Duration kResumeStoredWait = std::chrono::milliseconds(300);

  /// @param audit       writes the audit log
  /// @param on_message  receives executed commands, one line each, for the operator of the server
  /// @param clock       of the waits for the storage
  SessionCommands(SessionRegistry& registry, auth::ServerKeystore& audit,
                  std::function<void(const std::string&)> on_message = {},
                  std::function<Time()> clock = io::monotonic_now);

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
  /// Gives the replies that wait for the storage: the server ends.
  void give_replies() { held_.give_all(); }

 private:
  /// Queues an order about sessions, scenes or recordings.
  void order(rpc::Body command, const std::string& who, const std::function<void(rpc::Body)>& answer);
  /// Adds the tickets of the named workstations to the reply of a created session, and audits both.
  void complete(rpc::SessionCreated& created, const rpc::CreateSession& wanted, const std::string& who);
  /// Tells participants, operator and audit log of a recording that was started or ended by an order.
  void conclude_recording(const rpc::RecordSession& order, const std::string& who);
  [[nodiscard]] std::optional<rpc::ErrorReply> holder_problem(const rpc::CreateSession& wanted);
  /// Stores a note that the session has accepted. @return why it is rejected
  [[nodiscard]] std::optional<rpc::ErrorReply> store(SessionEntry& entry, const rpc::Welcome& joined,
                                                     const std::string& workstation, const rpc::Note& note,
                                                     const CommandOutcome& outcome);
  /// Logs the cause of a failure of the server: the reply to the client names only that there is one.
  /// @param session  its name; empty: none
  void report_failure(const std::string& session, const std::string& problem);
  /// Replies to an executed command.
  /// @param who   workstation, role and seat of the client
  [[nodiscard]] rpc::Body conclude(SessionEntry& entry, const rpc::Welcome& joined, const std::string& workstation,
                                   const std::string& who, const ShardRequest& executed);
  /// Gives the reply to an executed command, once its order is stored.
  void reply(const SessionEntry& entry, const ShardRequest& executed, rpc::Body body,
             const std::function<void(rpc::Body)>& answer);
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
  HeldReplies held_;
};

}  // namespace tandem::server
