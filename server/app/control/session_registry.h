#pragma once

#include <asio/io_context.hpp>
#include <asio/posix/stream_descriptor.hpp>
#include <atomic>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/io/server_keystore.h"
#include "common/auth/limiter.h"
#include "server/app/control/join_handler.h"
#include "server/app/process/live_session.h"
#include "server/app/process/shard.h"
#include "server/policy/admission_control.h"
#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Registry of the server's sessions: seat reservations, tickets, link-test slots and command dispatch. All members
/// run on the control plane's thread. Requests that only a session can execute are posted to its shard and completed
/// later.
class SessionRegistry final : public JoinHandler {
 public:
  /// @param trust   redeems tickets; used on the same thread
  /// @param limits  load of a shard above which its sessions reject new joins
  SessionRegistry(asio::io_context& context, auth::ServerKeystore& trust, const LoadLimits& limits = {});
  ~SessionRegistry() override;

  /// Session that clients can join. Call `add` before the context runs, or on its thread.
  struct Registration {
    std::string name;  ///< for users: 1 to 32 characters of A-Z a-z 0-9 _ -
    auth::Id16 id{};
    /// Session code, 10 characters of 0-9 A-Z, with which enrolled workstations may join. Empty: tickets only.
    std::string code;
    std::uint64_t epoch = 1;
    LiveSession* session = nullptr;             ///< valid until the session is over
    Shard* shard = nullptr;                     ///< serves the session, or will
    const SessionSnapshot* snapshot = nullptr;  ///< source of the restore, read by `add` only; null: a new session
    /// Receives the full list of removed workstations whenever one is added; null: the list is not stored.
    std::function<void(const std::vector<std::array<std::byte, 32>>&)> on_removed{};
    Time resume_until{};  ///< former participants can resume until then; only with `snapshot`
  };
  void add(Registration opening);
  /// The same as `add`, and posts the session to its running shard.
  void add_running(Registration opening);
  /// Removes a session that is over; it gets no more requests. `gone` is called when nothing refers to it any more.
  void remove(const auth::Id16& id, std::function<void()> gone);
  /// Releases all hands of a session and ends it.
  void end_session(const auth::Id16& id);
  /// Rejects new joins from now on.
  void drain() noexcept { draining_ = true; }
  /// Rejects new joins from now on; all hands are released in `grace_s`. @param who requested it
  void drain_in(std::uint32_t grace_s, const std::string& who);
  /// Sets the receiver of executed commands, one line each, called on the control plane's thread. Call it before the
  /// context runs.
  void on_message(std::function<void(const std::string&)> say) { on_message_ = std::move(say); }
  /// Time at which all hands are to be released, as an operator requested; nullopt without a request. Thread-safe.
  [[nodiscard]] std::optional<Time> drain_due() const noexcept;
  /// Progress of the drain.
  [[nodiscard]] rpc::StatusDrain drain_progress() const;
  /// Releases the seats and link-test slots of revoked workstations.
  void disconnect_revoked();

  // ---- Status queries, on the control plane's thread ----
  [[nodiscard]] ServingSpec serving() const;
  [[nodiscard]] bool draining() const noexcept { return draining_; }
  [[nodiscard]] std::vector<const Registration*> registrations() const;
  [[nodiscard]] std::vector<const Shard*> shards() const;
  [[nodiscard]] static rpc::SessionPhase phase_of(wire::SessionState state) noexcept;
  /// Waits for completed requests of the shard.
  void watch_completions(Shard& shard);
  /// Stops waiting for all shards, so that the context can end.
  void stop_watching();

  void admit(const JoinRequest& request, std::function<void(JoinReply)> answer) override;
  void on_joined(const JoinRequest& request, const rpc::Welcome& welcome,
                 const Secret<auth::kExportSize>& secrets) override;
  void on_join_failed(const rpc::Welcome& welcome) override;
  [[nodiscard]] rpc::SessionList list(const WorkstationRow& workstation) override;
  void command(const rpc::Welcome& standing, const WorkstationRow& workstation, const rpc::Body& command,
               std::function<void(rpc::Body)> answer) override;
  [[nodiscard]] bool is_current(const rpc::Welcome& standing) const override;
  void on_disconnected(const rpc::Welcome& standing, bool in_vain) override;

 private:
  /// State of a seat outside the session: the owner with resume secret, and a join in progress.
  struct SeatReservation {
    bool joining = false;
    std::optional<auth::Id16> ticket{};     ///< of the join in progress
    std::optional<WorkstationRow> owner{};  ///< current or last owner
    std::uint32_t cid = 0;                  ///< connection id of the owner's datagrams
    std::array<std::byte, 32> resume_hash{};
    /// The owner's last secret under which datagrams arrived. It stays valid because a Welcome may be lost.
    std::array<std::byte, 32> previous_hash{};
    std::array<std::byte, 32> next_previous_hash{};  ///< `previous_hash` if the join in progress succeeds
    bool resumable = false;
    double force_scale = 1;    ///< allowed by the ticket of the owner of `resume_hash`
    double offered_scale = 1;  ///< allowed by the ticket of the join in progress
    /// After a restart, until the owner is back. Otherwise the session knows for how long the owner is silent.
    std::optional<Time> resume_until{};
    std::uint32_t lost_cid = 0;  ///< connection from which the seat was taken away last
    std::string lost_why{};      ///< actor and reason of that
    Time reserved_until{};       ///< after a restart: reserved for the former owner until then
  };
  /// Reason that a console gave for the newest stop.
  struct StopReason {
    std::uint32_t number = 0;
    std::string workstation{}, text{};
  };
  /// Recent events for the status of all participants, and the console that resumed the session.
  struct StatusNotices {
    std::vector<rpc::StatusEvent> list{};
    std::uint32_t count = 0;            ///< number of events so far
    std::uint32_t resume_reported = 0;  ///< number of the newest stop whose end is in `list`
    std::uint32_t resumed = 0;          ///< number of the stop that `resumer` ended from a console
    std::string resumer{};
  };
  struct LinkTestSlot {
    std::optional<WorkstationRow> owner{};
    std::uint32_t cid = 0;
  };
  /// Redeemed ticket of a console, until its connection ends. The secret of its Welcome identifies the console.
  struct ConsoleTicket {
    Secret<32> secret;
    auth::Id16 ticket{};
  };
  struct SessionEntry {
    Registration registration;
    std::vector<SeatReservation> reservations;  ///< one per seat
    std::size_t pending_requests = 0;           ///< requests in progress
    std::function<void()> on_closed{};          ///< set: the session is over; called after its last pending request
    std::size_t link_tests_joining = 0;
    std::array<LinkTestSlot, LinkTestPeers::kMax> link_tests{};  ///< last admitted peer of each slot
    /// Fingerprints of the removed workstations.
    std::vector<std::array<std::byte, 32>> removed_workstations{};
    StopReason stop_reason{};
    StatusNotices notices{};
    std::vector<ConsoleTicket> consoles{};
    TokenBucket forbidden_events{1, 5};  ///< audit events of forbidden commands
  };
  struct WatchedShard {
    Shard* shard;
    asio::posix::stream_descriptor completions;
  };

  [[nodiscard]] std::variant<SessionEntry*, rpc::ErrorReply> resolve_session(const JoinRequest& request);
  [[nodiscard]] SessionEntry* find_entry(const rpc::Id& id);
  // Consoles, link tests and commands (session_commands.cpp).
  void join_console(SessionEntry& room, const JoinRequest& request, const std::function<void(JoinReply)>& answer);
  void join_link_test(SessionEntry& room, const JoinRequest& request, std::function<void(JoinReply)> answer);
  static void on_link_test_joined(SessionEntry& room, const ShardRequest& order, const WorkstationRow& by,
                                  std::uint32_t cid);
  /// Error reply for the client. Failures of the server itself are also reported to its operator.
  [[nodiscard]] rpc::ErrorReply ticket_refused(const auth::ServerKeystore::RedeemFailure& trouble) const;
  void restore_ticket(const auth::Id16& ticket, const SessionEntry& room);
  void release_console(SessionEntry& room, const rpc::Welcome& standing, bool ticket_is_good_again);
  void record_command(SessionEntry& room, const std::string& who, const std::string& why, const SessionCommand& command,
                      const CommandOutcome& outcome);
  [[nodiscard]] rpc::Status status_of(const SessionEntry& room, const rpc::Welcome& standing,
                                      const CommandOutcome& outcome) const;
  static void add_notice(SessionEntry& room, const std::string& text);
  static void report_resume(SessionEntry& room, const CommandOutcome& outcome);
  [[nodiscard]] static std::string seat_lost_text(const SessionEntry& room, const rpc::Welcome& standing);
  static void mark_removed(SessionEntry& room, std::size_t seat, std::string how);
  [[nodiscard]] static bool is_removed(const SessionEntry& room, const WorkstationRow& workstation);
  void release_seat(SessionEntry& room, std::size_t seat);
  void join_seat(SessionEntry& room, const JoinRequest& request, std::function<void(JoinReply)> answer);
  [[nodiscard]] std::optional<rpc::ErrorReply> check_credential(SessionEntry& room, const JoinRequest& request,
                                                                std::size_t seat, double& force_scale);
  /// @param device  of the seat; null for a console and for a link test
  [[nodiscard]] rpc::Welcome welcome(const SessionEntry& room, std::size_t seat, const rpc::DeviceFacts* device,
                                     std::uint8_t place, bool has_aes, double force_scale);
  /// Error reply if the shard or the machine is too busy for a new join; nullopt if not.
  [[nodiscard]] std::optional<rpc::ErrorReply> overload_reply(const SessionEntry& room) const;
  // Resume (resume.cpp).
  static void restore_reservations(SessionEntry& room);
  enum class ResumeMatch : std::uint8_t { kNone, kLatest, kPrevious };
  /// Key to which the resume secrets of this workstation are bound.
  [[nodiscard]] Checkpoint::Hash resume_binding(const WorkstationRow& workstation) const;
  [[nodiscard]] ResumeMatch verify_resume_secret(const SeatReservation& claim, const Secret<32>& secret,
                                                 const WorkstationRow& workstation) const;
  /// Whether the seat is reserved for its former owner, after a restart.
  [[nodiscard]] static bool reserved_for_owner(const SeatReservation& claim);
  /// Whether a resume secret is expired, which it is 10 min after its owner was lost. @param silence of the seat
  [[nodiscard]] static bool resume_expired(const SeatReservation& claim, Duration silence);
  /// Stores the new secret after a join. The previous secret stays valid until datagrams of the new connection arrive.
  void rotate_resume_secret(SeatReservation& claim, const Secret<32>& secret, const WorkstationRow& workstation,
                            SeatConnection& entry) const;
  void post(SessionEntry& room, ShardRequest order);
  void close_if_idle(SessionEntry& room);
  void await_completions(WatchedShard& watched);

  asio::io_context& context_;
  auth::ServerKeystore& trust_;
  LoadLimits limits_;
  bool draining_ = false;
  std::list<SessionEntry> entries_;
  std::list<WatchedShard> watched_shards_;
  std::list<ShardRequest> requests_;  ///< in progress
  std::uint8_t link_test_counter_ = 0;
  std::function<void(const std::string&)> on_message_{};
  std::atomic<std::int64_t> drain_due_{0};  ///< [ns] of the monotonic clock; 0: not requested
};

/// Session codes. `code_text` shows a code as two groups of 5 characters with a dash. Dashes, spaces and lower case do
/// not matter in input.
[[nodiscard]] std::string make_session_code();
[[nodiscard]] std::string code_text(const std::string& code);

}  // namespace tandem::server
