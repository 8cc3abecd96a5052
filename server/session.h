#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "common/base/time.h"
#include "proto/scene_spec.h"
#include "proto/wire_codec.h"
#include "common/control/hub.h"
#include "server/reception.h"
#include "server/audit.h"
#include "server/checkpoint.h"
#include "server/leading_hand.h"
#include "server/load_ladder.h"
#include "server/path_tokens.h"
#include "server/seat_port.h"
#include "server/stop_lane.h"
#include "server/tick_record.h"
#include "server/tool.h"
#include "server/visitors.h"

namespace tandem::server {

/// People sharing tools: seats, authority, tools and springs, once per tick. Sans-I/O: it sees time and bytes; the same core runs
/// over UDP and in virtual time. Order within a tick: authority, references of all seats, tools, send (design notes, control 4).
class Session {
 public:
  /// @param slaves  one per tool, null for tools whose slave is a seat of its own.
  /// @param scale   tip gain to port gain at the working pose, per axis.
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale);

  /// The session a server that died had left behind, one epoch later: everybody has to come back. Nobody is engaged until the
  /// instructors and all seats with weight that were there are, or an instructor goes on without (`press_resume` at his seat).
  /// @param slaves  standing where `from` says (Checkpoint::Tool::slave)  @pre unfit(from, scene) is empty
  Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale, const Checkpoint& from);

  /// What a new session could go on from; twice a second and whenever `authority_version` or `stops` changed is often enough.
  [[nodiscard]] Checkpoint checkpoint() const noexcept TANDEM_REALTIME;
  [[nodiscard]] std::uint64_t epoch() const noexcept { return epoch_; }
  /// Session time runs, or ran before a restart. A checkpoint from before the session began asks for nobody back.
  [[nodiscard]] bool begun() const noexcept { return begun_ || gathering_; }
  /// Back from a checkpoint and not everybody needed is there.
  [[nodiscard]] bool gathering() const noexcept { return gathering_; }

  /// Where surfaces near a tool come from beside the scene's own (server/contact_source.h). Before the first tick, or between ticks.
  /// @return false: no such tool, or it is not one that meets surfaces itself: law REPLICA, with a VIRTUAL slave or a SLAVE seat
  bool set_contact_source(std::size_t tool, std::unique_ptr<ContactSource> source);

  /// What never changes: for whoever answers those who ask for a seat, on any thread.
  [[nodiscard]] const Reception& reception() const noexcept { return reception_; }
  /// Whether a client could be put into a seat: it is free, or its owner fell silent 2 s ago, or (`same_owner`) is himself.
  /// @return kAccepted, kSeatTaken, kNoSuchSeat or kSessionOver
  [[nodiscard]] JoinResult may_admit(Time now, std::size_t seat, bool same_owner) const noexcept;
  /// Puts a client into a seat if he may be.
  /// @param entry  holds afterwards what was in the seat before, to be given back elsewhere  @return as `may_admit`
  [[nodiscard]] JoinResult admit(Time now, std::size_t seat, Entry& entry, bool same_owner) noexcept;
  /// One who only judges his link (proto/visit.h). @return as above
  /// @param place  afterwards: which of Visitors::kMax he has
  [[nodiscard]] JoinResult admit_visitor(Time now, std::unique_ptr<link::Link>& link, std::size_t* place = nullptr) noexcept;

  void on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes) noexcept;
  /// Where path challenges take their tokens. Whoever hosts the session fills it, before the first datagram and between ticks.
  [[nodiscard]] PathTokens& path_tokens() noexcept { return path_tokens_; }
  /// From the next tick on: what is gone without, and whether hands are let go, because the thread has too much to do.
  void relieve(const Relief& relief) noexcept { relief_ = relief; }
  [[nodiscard]] const Relief& relief() const noexcept { return relief_; }
  /// Ticks between two FORCEs for this seat now: 1 for whoever holds a tool, or is waited for.
  [[nodiscard]] std::uint32_t told_every(std::size_t seat) const noexcept;
  /// @param missed  ticks whose time passed without a call; they are lived through now, silently, up to a bound.
  void on_tick(Time now, std::uint32_t missed) noexcept TANDEM_REALTIME;

  /// Writes the next datagram into `buffer`; nullopt when nothing is due.
  [[nodiscard]] std::optional<Transmit> poll_transmit(Time now, std::span<std::byte> buffer) noexcept;

  /// Stops or pauses all hands, as the role may (roles.h), or resumes them; by a control connection. Seats do it by their STATE.
  /// @return whether the role may  @param number  of the stop to be ended, see `stops`
  bool stop_hands(Time now, AccessRole who, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  bool pause_hands(Time now, AccessRole who, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  /// @param seat  he sits on, AuditEvent::kNoSeat: none. His own pause may be taken back while others' last: then the session stays paused
  bool resume_hands(Time now, AccessRole who, std::uint32_t number, std::uint8_t seat = AuditEvent::kNoSeat) noexcept;
  [[nodiscard]] const StopLane& stop_lane() const noexcept { return stop_lane_; }
  /// Seats whose client is heard, bit i: seat i.
  [[nodiscard]] std::uint32_t there(Time now) const noexcept;
  [[nodiscard]] std::uint32_t stops() const noexcept { return stop_lane_.stops(); }
  [[nodiscard]] StopLane::Level stop_level() const noexcept { return stop_lane_.level(); }

  /// Weights over a tool, compared and set: only if `wish.version` is the session's. Decided now, announced to whom it concerns, and
  /// carried out `Handover::kNotice` ticks later, if those who gain are still heard from then (audit: kAuthorityCalledOff).
  /// @param seat   he sits on, AuditEvent::kNoSeat: none  @param noted  who is written down
  enum class AuthorityResult : std::uint8_t {
    kAnnounced,
    kOutdated,
    kForbidden,
    kWrong,
    kOutOfTouch,  ///< somebody whose weight it would change is not heard from
  };
  AuthorityResult set_authority(Time now, AccessRole who, std::size_t seat, std::uint8_t noted, const wire::AuthorityMessage& wish) noexcept;

  /// Takes a seat away: its gate ramps out, then its client is told and the seat is free. @return false: nobody sits there
  bool dismiss(std::size_t seat, wire::CloseReason why) noexcept;
  /// Somebody was told to leave and is being let go.
  [[nodiscard]] bool leaving(std::size_t seat) const noexcept { return farewells_[seat].ticks > 0; }
  /// The same for one who judges his link, in this place.
  bool dismiss_visitor(std::size_t place, std::uint32_t cid, wire::CloseReason why) noexcept { return visitors_.dismiss(place, cid, why); }
  [[nodiscard]] std::size_t visitors_free(Time now) const noexcept { return visitors_.free(now); }

  /// What happened since the last call; whoever hosts the session asks after every tick. At most AuditQueue::kCapacity wait.
  [[nodiscard]] std::optional<AuditEvent> poll_audit() noexcept { return audit_.poll(); }
  [[nodiscard]] std::uint64_t audit_dropped() const noexcept { return audit_.dropped(); }

  /// Ends the session: all gates ramp out for `kFarewell`, then every client is told.
  void stop(wire::CloseReason why) noexcept;
  [[nodiscard]] bool over() const noexcept { return over_; }

  [[nodiscard]] wire::SessionState state() const noexcept { return state_; }
  /// The session clock: since all required seats engaged, without the time it stood still [s].
  [[nodiscard]] double time() const noexcept { return session_tick_ * dt_; }
  /// Clock and timeline stand still: the session is ENDING, or it is STOPPED or PAUSED and its scene does not want them to run on.
  [[nodiscard]] bool clock_stands() const noexcept {
    return begun_ && (state_ == wire::SessionState::kEnding || (stop_lane_.on() && !scene_->clock_runs_while_stopped));
  }
  [[nodiscard]] std::uint64_t stood() const noexcept { return stood_; }  ///< ticks for which the clock stood still, in this epoch
  [[nodiscard]] Time last_tick() const noexcept { return last_tick_; }
  [[nodiscard]] std::uint32_t session_tick() const noexcept { return session_tick_; }
  [[nodiscard]] const TickRecord& record() const noexcept { return record_; }
  [[nodiscard]] const SceneSpec& scene() const noexcept { return *scene_; }
  [[nodiscard]] const SeatPort& seat(std::size_t i) const noexcept { return seats_[i]; }
  [[nodiscard]] const Tool& tool(std::size_t j) const noexcept { return tools_[j]; }
  /// The hand that leads this seat, as of the last tick; leader 0: none. @pre a master's seat
  [[nodiscard]] const wire::Ghost& ghost(std::size_t master) const noexcept { return ghost_[master]; }
  [[nodiscard]] std::vector<std::size_t> missing(Time now) const;                 ///< required seats that are not ready
  [[nodiscard]] std::uint64_t stray() const noexcept { return stray_; }           ///< datagrams for no connection
  [[nodiscard]] std::uint64_t slipped() const noexcept { return slipped_; }       ///< ticks given up after a long stall
  [[nodiscard]] std::uint32_t authority_version() const noexcept { return authority_version_; }

 private:
  // People (session_people.cpp).
  void hear(Time now, std::size_t seat, const SeatPort::Heard& heard) noexcept TANDEM_REALTIME;
  void hear_wishes(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  bool press_stop(Time now, AccessRole who, std::uint8_t seat, StopLane::Level wanted) noexcept;
  void wait_for_people(Time now) noexcept TANDEM_REALTIME;
  void look_after_people(Time now) noexcept TANDEM_REALTIME;
  void look_after(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  void forbid(Time now, std::size_t seat) noexcept;
  /// The session waits for it before it begins, or goes on after a restart.
  [[nodiscard]] bool needed(std::size_t seat) const noexcept;
  void go_on(Time now) noexcept;
  void note(Time now, AuditEvent::What what, std::size_t seat, std::uint32_t version = 0) noexcept;
  void say_farewell(Time now) noexcept TANDEM_REALTIME;

  /// Nobody is engaged now: somebody stopped the session, or it does not keep its time.
  [[nodiscard]] bool lets_go() const noexcept { return stop_lane_.on() || relief_.passive; }
  [[nodiscard]] bool due_to_be_told(std::size_t seat) noexcept TANDEM_REALTIME;
  /// Everybody is told CLOSE now; or this seat is.
  [[nodiscard]] bool closing() const noexcept;
  [[nodiscard]] bool closing(std::size_t seat) const noexcept;
  // Authority (session_authority.cpp).
  enum class Moment : std::uint8_t { kDecision, kCarryingOut };
  void hear_authority(Time now, std::size_t seat, const wire::AuthorityMessage& wish) noexcept TANDEM_REALTIME;
  void begin_authority(std::size_t tool, const control::Weights& wanted) noexcept;
  void decide_authority(Time now, std::uint8_t who, std::size_t tool, const control::Weights& wanted, std::uint32_t ahead) noexcept;
  void refuse_authority(Time now, std::uint8_t who, std::size_t tool, const control::Weights& wanted, std::size_t party) noexcept;
  void follow_timeline(Time now) noexcept TANDEM_REALTIME;
  void move_handovers_on() noexcept TANDEM_REALTIME;
  void hand_over(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::optional<std::size_t> out_of_touch(Time now, std::size_t tool, const control::Weights& weights, Moment moment) const noexcept;
  void tell_called_off(std::size_t seat) noexcept;
  [[nodiscard]] wire::HandoverParties parties(std::size_t tool, std::size_t seat) const noexcept TANDEM_REALTIME;
  void tell_handover(std::size_t seat, wire::ForceMessage& message) noexcept TANDEM_REALTIME;
  void note_authority(Time now, AuditEvent::What what, std::uint8_t who, std::size_t tool, const control::Weights& before,
                      const control::Weights& after, std::size_t party = AuditEvent::kNoSeat) noexcept;
  [[nodiscard]] control::Weights weights_of(const AuthorityRow& row) const noexcept;

  [[nodiscard]] bool slave_present(std::size_t tool) const noexcept;
  void live_one_tick(Time now) noexcept TANDEM_REALTIME;
  void change_state(Time now) noexcept;
  void settle_state() noexcept;
  void share_authority() noexcept TANDEM_REALTIME;
  void tie_seats() noexcept TANDEM_REALTIME;
  void move_references(Time now) noexcept TANDEM_REALTIME;
  void move_predictions(Time now, std::size_t seat) noexcept TANDEM_REALTIME;
  void step_offset(std::size_t seat, bool engaged) noexcept TANDEM_REALTIME;
  void credit_seat(std::size_t seat) noexcept TANDEM_REALTIME;
  void step_tools() noexcept TANDEM_REALTIME;
  void look_for_contacts(std::size_t tool) noexcept TANDEM_REALTIME;
  [[nodiscard]] double slave_pull(std::size_t seat, std::size_t tool) const noexcept TANDEM_REALTIME;
  void step_following() noexcept TANDEM_REALTIME;
  void follow_tools(std::size_t seat) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool told_of_others(std::size_t i) const noexcept { return replica_ && i < masters_; }
  void grant_following(std::size_t i) noexcept TANDEM_REALTIME;
  void follow_others(std::size_t i) noexcept TANDEM_REALTIME;
  void follow_others(std::size_t i, std::size_t j, wire::TieForce& told) const noexcept TANDEM_REALTIME;
  void tell_ties(std::size_t i) noexcept TANDEM_REALTIME;
  void tell_tools(std::size_t i) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool touching(Time now, std::size_t tool) const noexcept TANDEM_REALTIME;
  void see_leaders() noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t leader_of(std::size_t seat) const noexcept TANDEM_REALTIME;
  [[nodiscard]] bool leads(std::size_t master) const noexcept TANDEM_REALTIME;
  void fill_force_messages(Time now) noexcept TANDEM_REALTIME;
  [[nodiscard]] std::size_t first_tool(std::size_t seat) const noexcept;

  const SceneSpec* scene_;
  double dt_;
  Duration tick_length_;
  AxisArray scale_;
  AxisArray root_scale_{};
  std::vector<SeatPort> seats_;
  std::vector<Tool> tools_;
  std::size_t masters_;
  bool replica_;  ///< law of the channel: seats are told of the others, not of the tool
  std::uint32_t watcher_every_;    ///< ticks between two FORCEs for who feels nothing
  std::uint32_t feeler_every_max_; ///< at most, for who only feels: six intervals fit into the gates' silence limit
  Relief relief_;
  bool passive_ = false;           ///< as last written down
  Reception reception_;
  Visitors visitors_;
  PathTokens path_tokens_;

  wire::SessionState state_ = wire::SessionState::kWaiting;
  bool engage_ = false;                  ///< all required seats were ready: springs may be loaded
  bool begun_ = false;                   ///< all of them were engaged: session time goes on
  bool held_ = false;                    ///< since then, nobody has weight over any tool
  StopLane stop_lane_;
  Checkpoint::Hash scene_hash_;
  std::uint64_t epoch_ = 1;
  bool gathering_ = false;
  std::array<bool, kSeatsMax> awaited_{};  ///< while gathering
  StopLane::Level stop_before_ = StopLane::Level::kNone;  ///< that was on when the server died
  AuditQueue audit_;
  struct Watch {  ///< what was last said of a seat's person
    bool lost = false, isolated = false, own_stop = false, away = false;
    Time lost_at{};
  };
  std::array<Watch, kSeatsMax> watch_{};
  std::uint64_t not_finite_ = 0;         ///< steps that gave what is no number, as far as judged
  std::optional<Time> last_fault_;
  std::uint32_t session_tick_ = 0, tick_ = 0;
  std::uint64_t stood_ = 0;
  Time started_{}, last_tick_{};
  bool ticked_ = false, elapsed_any_ = false, over_ = false;
  wire::CloseReason close_reason_ = wire::CloseReason::kDone;
  std::uint32_t farewell_ = 0;           ///< ticks left in ENDING
  struct Farewell {  ///< of one seat whose person was removed
    std::uint32_t ticks = 0;  ///< left until it is free
    wire::CloseReason why = wire::CloseReason::kRemoved;
  };
  std::array<Farewell, kSeatsMax> farewells_{};
  std::size_t next_event_ = 0;           ///< of the timeline
  std::uint32_t authority_version_ = 1;
  std::array<std::uint32_t, kSeatsMax> called_off_{};  ///< ticks in which FORCE still says so
  std::optional<Time> refused_at_;                     ///< written down last
  /// What binds a seat to a tool during this tick. A slave is bound to its own, wholly.
  struct Tie {
    double alpha = 0;   ///< authority
    double follow = 0;  ///< C_ij: how far its target follows the tool
    double share = 0;   ///< the greater of both: of its spring
  };
  std::array<std::array<Tie, kToolsMax>, kSeatsMax> ties_{};
  std::array<AxisArray, kSeatsMax> absolute_{};     ///< y_i: where each seat's tool is
  std::array<AxisArray, kSeatsMax> offset_{};       ///< hand minus tool, on its way to 0
  std::array<std::uint32_t, kSeatsMax> engaged_for_{};  ///< ticks
  std::array<AxisArray, kSeatsMax> offset_step_{};  ///< during this tick
  std::array<AxisArray, kSeatsMax> reference_before_{};
  std::array<SeatPort::Near, kToolsMax> near_{};    ///< room for `move_predictions`
  std::array<std::uint64_t, kToolsMax> slave_heard_{};  ///< generation of the SLAVE seat's newest sample that a source of contacts saw
  std::array<bool, kSeatsMax> present_{};
  std::array<LeadingHand, kMastersMax> leading_{};
  std::array<wire::Ghost, kMastersMax> ghost_{};
  TickRecord record_{};

  std::array<bool, kSeatsMax> send_due_{};
  std::array<std::uint32_t, kSeatsMax> turns_;  ///< the last interval in which each seat was due
  std::size_t next_to_tell_ = 0;  ///< seat that `poll_transmit` asks next
  std::uint64_t stray_ = 0, slipped_ = 0;
};

}  // namespace tandem::server
