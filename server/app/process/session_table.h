#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "server/app/control/control_server.h"
#include "server/app/monitor/server_hints.h"
#include "server/app/monitor/server_output.h"
#include "server/app/process/checkpoint_store.h"
#include "server/app/process/owned_session.h"
#include "server/app/process/server_process.h"
#include "server/app/process/shard_pool.h"
#include "server/policy/shard_balancer.h"

namespace tandem::server {

/// Use of the processors by a session.
struct SessionUse {
  std::string name;
  double measured = 0;   ///< [cores]
  double expected = 0;   ///< when all its seats are taken [cores]
  bool waiting = false;  ///< no seat is taken
};

/// The sessions of a server process: opened or restored, announced, serviced while they run, then finished with a
/// report and perhaps replaced. All members belong to the thread of the main loop.
class SessionTable {
 public:
  /// @param checkpoints  null: no client could resume after a restart
  /// All references must outlive this.
  SessionTable(const ServerOptions& options, ShardPool& shards, ControlServer& control, CheckpointStore* checkpoints,
               ServerOutput& output);

  /// Opens all sessions, and restores those that the last server left. A member of a service opens none: those that
  /// it owns come with `open_owned`. @return exit code; 0: no error
  [[nodiscard]] int open();
  /// Passes the sessions to the shards and the control server, before either runs.
  void begin();
  /// Prints how to join the sessions.
  void announce_all();

  /// Sessions that are running, or over but not yet completed.
  [[nodiscard]] const std::vector<std::unique_ptr<SessionInstance>>& all() const noexcept { return sessions_; }
  [[nodiscard]] const ServerHints& hints() const noexcept { return hints_; }
  /// Sessions for the status line.
  [[nodiscard]] std::vector<SessionScreenEntry> screen_entries() const;
  /// Reports the events of all sessions, ends those without participants, and finishes those that are over.
  void service(Time now);
  /// Moves a session to another shard if its own is strained.
  void balance(Time now);
  /// Moves a session to another shard of its tick rate, and waits for it: one tick, at most 65.
  /// @return whether that shard serves it; false: the former one does, or the session is over
  [[nodiscard]] bool move(SessionInstance& session, std::size_t to);
  /// Executes an operator's order: creates a session, or begins to end one. Its reply follows on the control thread,
  /// for an end when the session is over.
  void execute(SessionOrder order);
  /// Takes the orders that ended a session, whose reply is then the caller's. For `OwnedSession::on_over`.
  [[nodiscard]] std::vector<SessionOrder> take_endings(const auth::Id16& id);
  /// Has the control thread answer an order.
  void reply(const SessionOrder& order, rpc::Body body);
  /// Why no operator may create another session now; nullopt: one may.
  [[nodiscard]] std::optional<rpc::ErrorReply> creation_problem() const;
  /// Why this server has no room for one more session of this rate [Hz]; nullopt: it has.
  [[nodiscard]] std::optional<rpc::ErrorReply> load_problem(double tick_hz) const;
  /// Opens a session that this server owns in its service, and serves it. @return why it cannot; empty: it is served
  [[nodiscard]] std::string open_owned(OwnedSession owned);
  /// Ends a session of a service that another server may own by now: releases all hands at once and tells the clients
  /// to join again; its snapshot stays. Nothing happens if this server does not serve it.
  void give_up(const std::string& name);
  /// The same, because the session moves to another server. @param text  says so to the operator
  /// @return false: the session ends already, and does not go on elsewhere; or this server does not serve it
  bool hand_over(const std::string& name, std::string text);
  /// Use of the processors by each session that is not over.
  [[nodiscard]] std::vector<SessionUse> uses() const;
  /// Reports about recordings, also of sessions that are over, and forgets those that are complete.
  void service_recordings();
  /// Recordings of sessions that are over are not complete yet.
  [[nodiscard]] bool recordings_busy() const noexcept;
  /// The server ends: all sessions count as ended by a signal, and none is replaced.
  void drain();
  /// Greatest exit code of the sessions that were not replaced.
  [[nodiscard]] int exit_code() const noexcept { return exit_code_; }
  /// Whether the next start of this server restores the sessions.
  [[nodiscard]] bool will_resume() const noexcept { return options_.sessions_resume && checkpoints_ != nullptr; }

 private:
  struct Ending {
    auth::Id16 session{};
    SessionOrder order;
  };
  [[nodiscard]] rpc::Body create_session(const rpc::CreateSession& wanted);
  /// Registers a session that was opened at run time, and passes it to its running shard.
  /// @return the session as lists have it; nullopt: the shard does not serve it, and it is gone
  [[nodiscard]] std::optional<rpc::ListedSession> serve_opened(std::unique_ptr<SessionInstance> opened);
  void end_here(const std::string& name, const PresenceTracker::Event& event);
  /// Why the server cannot record a session, and the remedy; empty: it can.
  [[nodiscard]] std::string no_recording(const SessionInstance& session) const;
  [[nodiscard]] rpc::Body record_session(const rpc::RecordSession& wanted);
  /// Starts the recording that the options of a new session want.
  void start_recording(SessionInstance& session);
  void report_recordings(SessionInstance& session);
  /// Words of the status line about a recording; empty: none runs.
  [[nodiscard]] static std::string recording_words(const SessionInstance& session);
  void end_session(SessionOrder order);
  /// Slot and shard for one more session of this scene, or why there are none.
  struct Place {
    std::size_t slot = 0, shard = 0;
  };
  /// A member of a service gets another shard if none has the tick rate of the scene.
  [[nodiscard]] std::expected<Place, rpc::ErrorReply> find_place(const SceneSpec& scene);
  [[nodiscard]] std::expected<std::size_t, rpc::ErrorReply> find_shard(double tick_hz);
  /// Measured loads of the shards.
  [[nodiscard]] std::vector<ShardView> shard_views() const;
  /// Measured costs of the sessions, as parts of the loads of their shards.
  [[nodiscard]] std::vector<SessionView> session_views(std::span<const ShardView> shards) const;
  /// Loads of the shards when all clients of their sessions have joined: the greater of measured and expected costs.
  [[nodiscard]] std::vector<ShardView> expected_loads() const;
  [[nodiscard]] std::string shard_text(std::size_t shard) const;
  [[nodiscard]] static rpc::ErrorReply goes_on_elsewhere(const SessionInstance& session);

  [[nodiscard]] std::expected<std::unique_ptr<SessionInstance>, int> open_session(
      const SessionOptions& options, std::size_t slot, std::uint64_t epoch, const SessionSnapshot* snapshot = nullptr);
  /// @param age_s  of the checkpoint; nullopt: unknown
  void report_restored(const SessionInstance& session, const CheckpointStore::Found& found,
                       std::optional<std::int64_t> age_s);
  [[nodiscard]] SessionRegistration registration_of(SessionInstance& session);
  void announce(const SessionInstance& session) const;
  void service_session(SessionInstance& session, Time now);
  /// Reports an event of a session with the time of its status.
  void report(const SessionInstance& session, const SessionStatus& status, const PresenceTracker::Event& event);
  void write_audit_events(SessionInstance& session);
  /// Completes a session that is over. @return true if another one replaced it
  [[nodiscard]] bool finish(std::unique_ptr<SessionInstance>& place);
  void summarize(const RunReport& report, SessionInstance& session);

  const ServerOptions& options_;
  ShardPool& shards_;
  ControlServer& control_;
  CheckpointStore* checkpoints_;
  ServerOutput& output_;
  ServerHints hints_;
  InputKeeper inputs_;  ///< before the sessions
  std::vector<std::unique_ptr<SessionInstance>> sessions_;
  std::vector<std::unique_ptr<SessionInstance>> finished_;  ///< completed, but still registered
  std::vector<std::unique_ptr<SessionInstance>> closing_;   ///< over, but a recording is not complete
  ShardBalancer balancer_;
  std::vector<Ending> endings_;  ///< orders to end sessions that are not over yet
  Time began_{};
  bool draining_ = false;
  int exit_code_ = 0;
};

}  // namespace tandem::server
