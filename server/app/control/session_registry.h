#pragma once

#include <functional>
#include <list>
#include <string>
#include <variant>
#include <vector>

#include "proto/rpc/rpc_messages.h"
#include "proto/spec/registry_spec.h"
#include "server/app/control/drain_schedule.h"
#include "server/app/control/session_entry.h"
#include "server/app/control/shard_requests.h"
#include "server/app/monitor/rejected_datagrams.h"

namespace tandem::server {

/// Registry of the server's sessions. All members run on the control plane's thread, except `drain().due()`.
class SessionRegistry {
 public:
  explicit SessionRegistry(asio::io_context& context) : requests_(context) {}

  /// Adds a session. Call it before the context runs, or on its thread.
  void add(SessionRegistration opening);
  /// The same as `add`, and posts the session to its running shard.
  /// @param done  called when the shard has the request; false: it does not serve the session
  void add_running(SessionRegistration opening, std::function<void(bool)> done = [](bool) {});
  /// Removes a session that is over; it gets no more requests. `gone` is called when nothing refers to it any more.
  void remove(const rpc::Id& id, std::function<void()> gone);
  /// Releases all hands of a session and ends it. A full queue of its shard delays this.
  /// @param why  told to its clients
  void end(const rpc::Id& id, wire::CloseReason why = wire::CloseReason::kServerStops);
  /// Moves a session to another shard of its tick rate, between two ticks. Requests of the session wait meanwhile.
  /// @param there, before  kernel's program with the session at `to`, and the one in force; valid until `done`
  /// @param done           false: its shard still serves it, or it is over; try again later
  void move(const rpc::Id& id, Shard& to, const io::SteeringProgram& there, const io::SteeringProgram& before,
            std::function<void(bool)> done);
  /// Number of moves so far.
  [[nodiscard]] std::uint64_t moves() const noexcept { return moves_; }
  /// Rejected datagrams of all sessions, also of those that were removed.
  [[nodiscard]] RejectedDatagrams rejected() const;
  /// Posts a request to the shard of a session, as `ShardRequests::post`.
  void post(const SessionEntry& entry, ShardRequest request);

  /// The session with this id; null if there is none or it is being removed.
  [[nodiscard]] SessionEntry* find(const rpc::Id& id);
  [[nodiscard]] const SessionEntry* find(const rpc::Id& id) const;
  /// The session that a client chose, or the reply if it cannot be joined.
  [[nodiscard]] std::variant<SessionEntry*, rpc::ErrorReply> choose(const rpc::SessionChoice& choice);

  /// All sessions; those with `closing` are being removed.
  [[nodiscard]] std::list<SessionEntry>& entries() noexcept { return entries_; }
  [[nodiscard]] const std::list<SessionEntry>& entries() const noexcept { return entries_; }
  /// One session of `list`. @pre entry.open()
  [[nodiscard]] static rpc::ListedSession listed(const SessionEntry& entry);
  /// One page of the list of open sessions for clients. @param after  `last` of the page before; 0: the first page
  [[nodiscard]] rpc::SessionList list(std::uint32_t after = 0) const;
  /// List of the sessions for commands on the server's computer.
  [[nodiscard]] ServingSpec serving() const;

  [[nodiscard]] ShardRequests& requests() noexcept { return requests_; }
  [[nodiscard]] const ShardRequests& requests() const noexcept { return requests_; }
  [[nodiscard]] DrainSchedule& drain() noexcept { return drain_; }
  [[nodiscard]] const DrainSchedule& drain() const noexcept { return drain_; }
  /// Progress of the drain.
  [[nodiscard]] rpc::StatusDrain drain_progress() const;

 private:
  ShardRequests requests_;
  DrainSchedule drain_;
  std::list<SessionEntry> entries_;  ///< with ascending numbers
  std::uint32_t numbers_ = 0;        ///< given so far
  std::uint64_t moves_ = 0;
  RejectedDatagrams rejected_;  ///< of removed sessions
};

/// Phase of a session for clients.
/// @param may_act  false: this server may not act for the session now, because the directory of the service is silent
[[nodiscard]] rpc::SessionPhase phase_of(wire::SessionState state, bool may_act) noexcept;

/// Session codes. `code_text` shows a code as two groups of 5 characters with a dash. Dashes, spaces and lower case do
/// not matter in input.
[[nodiscard]] std::string make_session_code();
[[nodiscard]] std::string code_text(const std::string& code);

}  // namespace tandem::server
