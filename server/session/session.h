#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_codec.h"
#include "server/policy/load_shedder.h"
#include "server/report/audit_event.h"
#include "server/report/tick_record.h"
#include "server/session/checkpoint.h"
#include "server/session/leading_hands.h"
#include "server/session/link_test_peers.h"
#include "server/session/path_tokens.h"
#include "server/session/seat_catalogue.h"
#include "server/session/seat_endpoint.h"
#include "server/session/shared_control.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// One session: seats share tools, coupled by springs under an authority that may change. `on_tick` advances it once
/// per tick of 1 / `tick_hz`. Sans-I/O: the session receives times and bytes only. The same code runs over UDP and in
/// the simulation. Order within a tick: authority, references of all seats, tools, targets, FORCE messages (design
/// notes, control 4).
class Session {
 public:
  /// @param slaves  one per tool; null for a tool whose slave is a seat, and for a tool without a slave
  /// @param scale   tip gain to port gain at the working pose, per axis
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale);

  /// Restores the session that a failed server left behind, with the next epoch. All clients have to join again. No
  /// seat is engaged until all required seats are ready: taken instructors' seats and taken seats with authority. An
  /// instructor can resume earlier, without the missing seats (`resume_stop` in STATE, or `resume`).
  /// @param slaves  at the joint positions of `from` (Checkpoint::Tool::slave)
  /// @pre incompatibility(from, scene) is empty
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale,
          const Checkpoint& from);

  /// State from which a new server process can restore the session. Twice per second is often enough, and whenever
  /// `authority_version` or `stops` changed.
  [[nodiscard]] Checkpoint checkpoint() const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }
  /// True once session time runs, or if it ran before a restart. A session restored from a checkpoint with `begun`
  /// false requires no seats to come back.
  [[nodiscard]] bool begun() const noexcept { return begun_ || recovering_; }
  /// True after a restore until all required seats are ready, or until an instructor or operator resumes without them.
  [[nodiscard]] bool recovering() const noexcept { return recovering_; }

  /// Sets the source of surfaces near a tool, in addition to the scene's own (server/session/contact_source.h). Call
  /// it before the first tick, or between ticks.
  /// @return false if there is no such tool, or if the tool does not meet surfaces itself: only tools under law
  /// REPLICA with a VIRTUAL slave or a SLAVE seat do
  bool set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source);

  /// The constant part of the session, readable on any thread: the control plane answers join requests from it.
  [[nodiscard]] const SeatCatalogue& seat_catalogue() const noexcept { return seat_catalogue_; }
  /// Whether a client can take a seat now. A seat is available if it is free, or if its client has been silent for
  /// more than 2 s, or if `same_owner` is true.
  /// @param same_owner  the request comes from the current owner of the seat
  /// @return kAccepted, kSeatTaken, kNoSuchSeat or kSessionOver
  [[nodiscard]] JoinResult may_admit(Time now, std::size_t seat, bool same_owner) const noexcept;
  /// Attaches a client to a seat if `may_admit` accepts it.
  /// @param entry  in: the client's connection; out: the previous contents of the seat, to be freed on another thread
  /// @return as `may_admit`
  [[nodiscard]] JoinResult admit(Time now, std::size_t seat, SeatConnection& entry, bool same_owner) noexcept;
  /// Admits a link-test peer (proto/wire/link_test_report.h).
  /// @param place  out: index of its slot, below LinkTestPeers::kMax
  /// @return kAccepted, kSeatTaken (all slots are in use) or kSessionOver
  [[nodiscard]] JoinResult admit_link_test_peer(Time now, std::unique_ptr<transport::SecureChannel>& link,
                                                std::size_t* place = nullptr) noexcept;

  void on_datagram(Time now, const PeerAddress& from, std::span<const std::byte> bytes) noexcept;
  /// Random tokens for path challenges. The thread that runs the session fills the store before the first datagram and
  /// between ticks.
  [[nodiscard]] PathTokens& path_tokens() noexcept { return path_tokens_; }
  /// Sets the load-shedding level, effective from the next tick. If `overloaded`, all hands are disengaged.
  void set_load_state(const LoadState& relief) noexcept { load_state_ = relief; }
  [[nodiscard]] const LoadState& load_state() const noexcept { return load_state_; }
  /// Ticks between two FORCE datagrams to this seat at the current shed level. It is above 1 only for seats that
  /// receive no force, and for evaluators whose seat is not required.
  [[nodiscard]] std::uint32_t send_interval(std::size_t seat) const noexcept;
  /// Advances the session to `now` and marks the datagrams that are due.
  /// @param missed  ticks whose time passed without a call; the session runs at most 50 of them now, without sending,
  /// and skips the rest
  void on_tick(Time now, std::uint32_t missed) noexcept TANDEM_REALTIME;

  /// Writes the next datagram into `buffer`. @return its destination and size; nullopt when nothing is due
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;

  /// Stops, pauses or resumes all hands on behalf of a control connection. Seats request the same by flags in STATE.
  /// The role decides (roles.h): a role that may only pause gets a pause.
  /// @param seat    seat of the participant who asks; AuditEvent::kNoSeat for a console
  /// @return false if the role may not
  bool stop(Time now, AccessRole who, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  bool pause(Time now, AccessRole who, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  /// Ends the stop, or ends the waiting after a restart.
  /// @param number  number of the stop to end, see `stops`
  /// @param seat    seat of the participant who asks; AuditEvent::kNoSeat for a console
  /// @return false if the role may not. With true the session can still be paused: other seats' pauses are on
  bool resume(Time now, AccessRole who, std::uint32_t number, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  [[nodiscard]] const StopLatch& stop_latch() const noexcept { return stop_latch_; }
  /// Seats whose client is alive, bit i for seat i.
  [[nodiscard]] std::uint32_t connected_seats(Time now) const noexcept;
  [[nodiscard]] std::uint32_t stops() const noexcept { return stop_latch_.stops(); }
  [[nodiscard]] StopLatch::Level stop_level() const noexcept { return stop_latch_.level(); }

  /// Schedules new authority over a tool, as a compare-and-set: `wish.version` must be the session's version. All
  /// parties are notified; the change takes effect `AuthorityTransfer::kNotice` ticks later. It is cancelled if a
  /// party that gains authority has a stale link then (audit: kAuthorityCancelled).
  /// @param seat   seat of the participant who asks; AuditEvent::kNoSeat for a console
  /// @param noted  seat, or AuditEvent::kControlPlane, that the audit event names
  enum class AuthorityResult : std::uint8_t {
    kScheduled,
    kOutdated,
    kForbidden,
    kInvalid,
    kStaleLink,  ///< a party to the change has a stale link
  };
  AuthorityResult set_authority(Time now, AccessRole who, std::size_t seat, std::uint8_t noted,
                                const wire::AuthorityMessage& wish) noexcept;

  /// Removes a participant: the gate ramps out, the client receives CLOSE, then the seat is free.
  /// @return false if the seat is free or is closing already
  bool remove_seat(std::size_t seat, wire::CloseReason why) noexcept;
  /// The seat's participant was removed and its close-out is in progress.
  [[nodiscard]] bool closing_out(std::size_t seat) const noexcept { return close_outs_[seat].ticks_left > 0; }
  /// Removes the link-test peer in a slot. @return false if the slot does not hold connection `cid`
  bool remove_link_test_peer(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept {
    return link_test_peers_.remove(place, cid, why);
  }
  [[nodiscard]] std::size_t link_test_places_free(Time now) const noexcept { return link_test_peers_.places_free(now); }

  /// Next audit event, in order; nullopt when there is none. The thread that runs the session calls it after every
  /// tick. The queue holds AuditQueue::kCapacity events.
  [[nodiscard]] std::optional<AuditEvent> poll_audit() noexcept { return audit_.poll(); }
  [[nodiscard]] std::uint64_t audit_dropped() const noexcept { return audit_.dropped(); }

  /// Ends the session: all gates ramp out for `kCloseOutTime`, then every client receives CLOSE.
  void end(wire::CloseReason why) noexcept;
  [[nodiscard]] bool over() const noexcept { return over_; }

  [[nodiscard]] wire::SessionState state() const noexcept { return state_; }
  /// Session clock [s]: ticks since all required seats were engaged, without the time for which the clock was stopped.
  [[nodiscard]] double time() const noexcept { return session_tick_ * dt_; }
  /// Clock and timeline are stopped: the session is ENDING, or it is STOPPED or PAUSED and `clock_runs_while_stopped`
  /// is false in its scene.
  [[nodiscard]] bool clock_stopped() const noexcept {
    return begun_ &&
           (state_ == wire::SessionState::kEnding || (stop_latch_.latched() && !scene_->clock_runs_while_stopped));
  }
  /// Ticks of this epoch for which the clock was stopped.
  [[nodiscard]] std::uint64_t stopped_ticks() const noexcept { return stopped_ticks_; }
  [[nodiscard]] Time last_tick() const noexcept { return last_tick_; }
  [[nodiscard]] std::uint32_t session_tick() const noexcept { return session_tick_; }
  [[nodiscard]] const TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const SeatEndpoint& seat(std::size_t i) const noexcept { return seats_[i]; }
  [[nodiscard]] const control::EscHub& hub() const noexcept { return control_.hub(); }
  [[nodiscard]] const Tool& tool(std::size_t j) const noexcept { return tools()[j]; }
  /// The hand that leads this seat, as of the last tick; its `leader` is 0 if there is none. @pre a master's seat
  [[nodiscard]] const wire::Ghost& ghost(std::size_t master) const noexcept { return leading_hands_.ghost(master); }
  [[nodiscard]] std::vector<std::size_t> missing(Time now) const;  ///< required seats that are not ready
  /// Datagrams without a valid header, or for no current connection.
  [[nodiscard]] std::uint64_t unmatched_datagrams() const noexcept { return unmatched_datagrams_; }
  /// Missed ticks that were skipped, because a stall exceeded the catch-up limit.
  [[nodiscard]] std::uint64_t dropped_ticks() const noexcept { return dropped_ticks_; }
  [[nodiscard]] std::uint32_t authority_version() const noexcept { return authority_version_; }

 private:
  // Participants (session_lifecycle.cpp).
  void handle_message(Time now, std::size_t seat, const SeatEndpoint::Received& heard) noexcept TANDEM_REALTIME;
  void handle_requests(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  bool request_stop(Time now, AccessRole who, std::uint8_t seat, StopLatch::Level wanted) noexcept;
  void check_start_condition(Time now) noexcept TANDEM_REALTIME;
  void monitor_seats(Time now) noexcept TANDEM_REALTIME;
  void monitor_seat(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  void reject_forbidden(Time now, std::size_t seat) noexcept;
  /// The session waits for this seat before it begins, or before it resumes after a restart.
  [[nodiscard]] bool is_required(std::size_t seat) const noexcept;
  void resume_after_restart(Time now) noexcept;
  void emit_event(Time now, AuditEvent::What what, std::size_t seat, std::uint32_t version = 0) noexcept;
  void finish_close_out(Time now) noexcept TANDEM_REALTIME;

  /// No seat may be engaged now: the session is stopped, paused or overloaded.
  [[nodiscard]] bool disengages_all() const noexcept { return stop_latch_.latched() || load_state_.overloaded; }
  [[nodiscard]] bool send_turn_begins(std::size_t seat) noexcept TANDEM_REALTIME;
  /// CLOSE is due now: to every client, or to this seat.
  [[nodiscard]] bool sends_close() const noexcept;
  [[nodiscard]] bool sends_close(std::size_t seat) const noexcept;
  // Authority (session_authority.cpp).
  enum class TransferStage : std::uint8_t { kScheduling, kExecution };
  void handle_authority_request(Time now, std::size_t seat,
                                const wire::AuthorityMessage& wish) noexcept TANDEM_REALTIME;
  void set_initial_authority(std::size_t tool, const control::MasterArray& wanted) noexcept;
  void schedule_authority(Time now, std::uint8_t who, std::size_t tool, const control::MasterArray& wanted,
                          std::uint32_t ahead) noexcept;
  void reject_authority(Time now, std::uint8_t who, std::size_t tool, const control::MasterArray& wanted,
                        std::size_t party) noexcept;
  void schedule_timeline_events(Time now) noexcept TANDEM_REALTIME;
  void advance_transfers() noexcept TANDEM_REALTIME;
  void execute_transfers(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::optional<std::size_t> stale_party(Time now, std::size_t tool, const control::MasterArray& weights,
                                                       TransferStage moment) const noexcept;
  void report_cancelled_transfer(std::size_t seat) noexcept;
  [[nodiscard]] wire::TransferParties transfer_parties(std::size_t tool,
                                                       std::size_t seat) const noexcept TANDEM_REALTIME;
  void fill_transfer_message(std::size_t seat, wire::ForceMessage& message) noexcept TANDEM_REALTIME;
  void emit_authority_event(Time now, AuditEvent::What what, std::uint8_t who, std::size_t tool,
                            const control::MasterArray& before, const control::MasterArray& after,
                            std::size_t party = AuditEvent::kNoSeat) noexcept;
  [[nodiscard]] control::MasterArray weights_of(const AuthorityRow& row) const noexcept;

  void run_one_tick(Time now) noexcept TANDEM_REALTIME;
  void update_state(Time now) noexcept;
  void derive_session_state() noexcept;
  [[nodiscard]] bool touching(Time now, std::size_t tool) const noexcept TANDEM_REALTIME;
  void fill_force_messages(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::span<Tool> tools() noexcept { return control_.tools(); }
  [[nodiscard]] std::span<const Tool> tools() const noexcept { return control_.tools(); }

  const SceneSpec* scene_;
  double dt_;
  Duration tick_length_;
  std::size_t masters_;
  bool replica_;                     ///< law `replica`: masters receive the other hands' motion, not the tool's
  std::uint32_t observer_interval_;  ///< ticks between two FORCEs to a seat that receives no force
  /// Upper bound for evaluators: six intervals fit into the gates' silence limit.
  std::uint32_t evaluator_interval_max_;
  std::array<bool, kSeatsMax> present_{};
  std::vector<SeatEndpoint> seats_;
  SharedControl control_;
  LeadingHands leading_hands_;
  LoadState load_state_;
  bool overloaded_ = false;  ///< as of the last audit event
  SeatCatalogue seat_catalogue_;
  LinkTestPeers link_test_peers_;
  PathTokens path_tokens_;

  wire::SessionState state_ = wire::SessionState::kWaiting;
  bool engage_ = false;  ///< all required seats are ready: springs may be loaded
  bool begun_ = false;   ///< all required seats were engaged: session time runs
  bool held_ = false;    ///< no present seat has authority over any tool, since `begun_`
  StopLatch stop_latch_;
  Checkpoint::Hash scene_hash_;
  std::uint64_t epoch_ = 1;
  bool recovering_ = false;
  std::array<bool, kSeatsMax> required_for_resume_{};       ///< while recovering
  StopLatch::Level stop_before_ = StopLatch::Level::kNone;  ///< level that was latched when the last server failed
  AuditQueue audit_;
  struct SeatMonitorState {  ///< state of a seat as of its last audit events
    bool lost = false, quarantined = false, local_stop = false, away = false;
    Time lost_at{};
  };
  std::array<SeatMonitorState, kSeatsMax> seat_monitor_{};
  std::uint64_t not_finite_ = 0;  ///< tool steps with a non-finite result, as of the last check
  std::optional<Time> last_fault_;
  std::uint32_t session_tick_ = 0, tick_ = 0;
  std::uint64_t stopped_ticks_ = 0;
  Time started_{}, last_tick_{};
  bool ticked_ = false, elapsed_any_ = false, over_ = false;
  wire::CloseReason close_reason_ = wire::CloseReason::kDone;
  std::uint32_t ending_ticks_left_ = 0;  ///< ticks left in ENDING
  struct CloseOut {                      ///< of a seat whose participant was removed
    std::uint32_t ticks_left = 0;        ///< until the seat is free
    wire::CloseReason why = wire::CloseReason::kRemoved;
  };
  std::array<CloseOut, kSeatsMax> close_outs_{};
  std::size_t next_event_ = 0;  ///< next event of the timeline
  std::uint32_t authority_version_ = 1;
  /// Ticks for which FORCE still reports the cancellation.
  std::array<std::uint32_t, kSeatsMax> cancelled_transfer_ticks_{};
  std::optional<Time> refused_at_;  ///< time of the last audit event of a rejected transfer
  TickRecord record_{};

  std::array<bool, kSeatsMax> send_due_{};
  std::array<std::uint32_t, kSeatsMax> last_interval_;  ///< last send interval in which a FORCE to the seat was due
  std::size_t next_send_ = 0;                           ///< next seat for `poll_transmit`
  std::uint64_t unmatched_datagrams_ = 0, dropped_ticks_ = 0;
};

}  // namespace tandem::server
