#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_codec.h"
#include "server/report/tick_record.h"
#include "server/session/audit_trail.h"
#include "server/session/authority_control.h"
#include "server/session/checkpoint.h"
#include "server/session/fault_monitor.h"
#include "server/session/input_journal.h"
#include "server/session/leading_hands.h"
#include "server/session/link_test_peers.h"
#include "server/session/participants.h"
#include "server/session/path_tokens.h"
#include "server/session/requester.h"
#include "server/session/seat_catalogue.h"
#include "server/session/seat_endpoint.h"
#include "server/session/send_schedule.h"
#include "server/session/session_clock.h"
#include "server/session/session_lifecycle.h"
#include "server/session/shared_control.h"
#include "server/session/start_condition.h"
#include "server/session/stop_control.h"
#include "server/session/watchers.h"

namespace tandem::server {

/// One session: seats share tools, coupled by springs under an authority that may change. `on_tick` advances it once
/// per tick of 1 / `tick_hz`. Sans-I/O: the session receives times and bytes only. The same code runs over UDP and in
/// the simulation. Its parts have the state; this class routes datagrams to them and calls them in the order of a tick:
/// slaves at the server, participants, session clock, authority, references of all seats, tools, leading hands, targets
/// (ARCHITECTURE.md, "Order within a tick"). `on_tick` then fills the FORCE messages once, also after ticks that it
/// catches up.
class Session {
 public:
  /// @param slaves  one per tool; null for a tool whose slave is a seat, and for a tool without a slave
  /// @param scale   tip gain to port gain at the working pose, per axis
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale);

  /// Restores the session that a failed server left behind, with the next epoch. All clients have to join again. No
  /// seat is engaged until all required seats are ready: taken instructors' seats and taken seats with authority. An
  /// instructor can resume earlier, without the missing seats (StopControl::resume).
  /// @param slaves    at the joint positions of `from` (Checkpoint::Tool::slave)
  /// @param saved_at  time of the checkpoint, by the clock of this server
  /// @pre incompatibility(from, scene) is empty
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale,
          const Checkpoint& from, Time saved_at = {});
  Session(const Session&) = delete;  // its parts refer to each other
  Session& operator=(const Session&) = delete;

  /// State from which a new server process can restore the session. Twice per second is often enough, and whenever
  /// the version of the authority or the number of stops changed.
  [[nodiscard]] Checkpoint checkpoint() const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }

  /// Sets the source of surfaces near a tool, in addition to the scene's own (server/session/contact_source.h). Call
  /// it before the first tick, or between ticks.
  /// @return false if there is no such tool, or if the tool does not meet surfaces itself: only tools under law
  /// REPLICA with a VIRTUAL slave or a SLAVE seat do
  bool set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source);

  /// The constant part of the session, readable on any thread: the control plane answers join requests from it.
  [[nodiscard]] const SeatCatalogue& seat_catalogue() const noexcept { return seat_catalogue_; }
  /// Writes all inputs from now on to a journal, so that netsim/replay can repeat the session. Call it right after the
  /// constructor; the caller then polls all datagrams directly after each tick, with the time of that tick.
  /// @param journal  must outlive this
  /// @param start    time at which the slaves were made
  /// @param build    version and build of the program
  /// @param from     as given to the constructor; null: none
  /// @return false if something has entered the session already: then nothing is written
  bool attach_journal(InputJournal& journal, Time start, std::string_view build, const Checkpoint* from = nullptr);
  /// The journal of this session; null: none.
  [[nodiscard]] InputJournal* journal() noexcept { return journal_; }
  /// Ends the session for all clients, as Participants::end.
  void end(wire::CloseReason why) noexcept;
  /// Removes the client of a seat, as Participants::remove.
  bool remove(std::size_t seat, wire::CloseReason why) noexcept;
  /// Attaches a client to a seat, as Participants::admit. Requests of the client before are withdrawn.
  [[nodiscard]] JoinResult admit(Time now, std::size_t seat, SeatConnection& entry, bool same_owner) noexcept;
  [[nodiscard]] LinkTestPeers& link_test_peers() noexcept { return link_test_peers_; }
  [[nodiscard]] Watchers& watchers() noexcept { return watchers_; }

  void on_datagram(Time now, const PeerAddress& from, std::span<const std::byte> bytes) noexcept;
  /// Sets whether clients send telemetry at every tick (default), or at wire::kTelemetryHz. A session whose ticks
  /// nothing records does not need more. No law uses telemetry.
  void set_telemetry_every_tick(bool on) noexcept { telemetry_every_tick_ = on; }
  /// Sets how often `record` is made: at every tick (default), or at every `interval`-th one.
  /// @param interval  [ticks], at least 1
  void set_record_interval(std::uint32_t interval) noexcept { record_interval_ = interval; }
  /// The last call of `on_tick` made a record.
  [[nodiscard]] bool recorded() const noexcept { return recorded_; }
  /// Random tokens for path challenges. The thread that runs the session fills the store before the first datagram and
  /// between ticks.
  [[nodiscard]] PathTokens& path_tokens() noexcept { return path_tokens_; }
  /// Advances the session to `now` and marks the datagrams that are due.
  /// @param missed  ticks whose time passed without a call; the session runs at most SessionClock::kCatchUpMax of them
  /// now, without sending, and skips the rest
  void on_tick(Time now, std::uint32_t missed) noexcept TANDEM_REALTIME;
  /// Writes the next datagram into `buffer`. @return its destination and size; nullopt when nothing is due
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;

  /// No client has a seat, watches, or tests its link.
  [[nodiscard]] bool idle() const noexcept;
  /// All clients have received CLOSE: no tick does anything any more.
  /// Its clients are being closed, or it is over.
  [[nodiscard]] bool ends() const noexcept { return participants_.closing().session.begun(); }
  [[nodiscard]] bool over() const noexcept { return participants_.closing().session.over(); }
  [[nodiscard]] wire::SessionState state() const noexcept { return lifecycle_.state(); }

  [[nodiscard]] SessionLifecycle& lifecycle() noexcept { return lifecycle_; }
  [[nodiscard]] const SessionLifecycle& lifecycle() const noexcept { return lifecycle_; }
  [[nodiscard]] Participants& participants() noexcept { return participants_; }
  [[nodiscard]] const Participants& participants() const noexcept { return participants_; }
  [[nodiscard]] const StartCondition& start_condition() const noexcept { return start_; }
  [[nodiscard]] StopControl& stop_control() noexcept { return stop_; }
  [[nodiscard]] const StopControl& stop_control() const noexcept { return stop_; }
  [[nodiscard]] AuthorityControl& authority() noexcept { return authority_; }
  [[nodiscard]] const AuthorityControl& authority() const noexcept { return authority_; }
  [[nodiscard]] const SessionClock& clock() const noexcept { return clock_; }
  [[nodiscard]] AuditTrail& audit() noexcept { return audit_; }
  [[nodiscard]] const TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const SeatEndpoint& seat(std::size_t i) const noexcept { return seats_[i]; }
  [[nodiscard]] const Tool& tool(std::size_t j) const noexcept { return control_.tools()[j]; }
  /// The slave of a tool touches something; for display.
  [[nodiscard]] bool touching(Time now, std::size_t tool) const noexcept { return control_.touching(now, tool); }
  [[nodiscard]] const control::EscHub& hub() const noexcept { return control_.hub(); }
  /// Datagrams without a valid header, or for no current connection.
  [[nodiscard]] std::uint64_t unmatched_datagrams() const noexcept { return unmatched_datagrams_; }

 private:
  void handle_message(Time now, std::size_t seat, const SeatEndpoint::Received& heard) noexcept TANDEM_REALTIME;
  void handle_requests(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  void run_one_tick(Time now) noexcept TANDEM_REALTIME;
  void fill_force_messages(Time now) noexcept TANDEM_REALTIME;
  void serve_watchers(Time now) noexcept TANDEM_REALTIME;
  /// Clients are to send telemetry at every tick.
  [[nodiscard]] bool telemetry_due() const noexcept {
    return telemetry_every_tick_ || watchers_.record_every_tick(lifecycle_.load_state().level);
  }

  const SceneSpec* scene_;
  std::size_t masters_;
  std::vector<SeatEndpoint> seats_;
  SeatCatalogue seat_catalogue_;
  PathTokens path_tokens_;
  SessionClock clock_;
  AuditTrail audit_;
  Participants participants_;
  LinkTestPeers link_test_peers_;
  Watchers watchers_;
  SharedControl control_;
  StartCondition start_;
  StopControl stop_;
  SessionLifecycle lifecycle_;
  AuthorityControl authority_;
  LeadingHands leading_hands_;
  SendSchedule send_;
  FaultMonitor faults_;
  Checkpoint::Hash scene_hash_;
  std::uint64_t epoch_ = 1;
  std::uint64_t unmatched_datagrams_ = 0;
  bool telemetry_every_tick_ = true;
  std::uint32_t record_interval_ = 1, since_record_ = 0;  ///< [ticks]
  bool recorded_ = false;                                 ///< the last tick made a record
  TickRecord record_{};
  InputJournal* journal_ = nullptr;
};

}  // namespace tandem::server
