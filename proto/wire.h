#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "common/base/axes.h"
#include "common/base/local_contact.h"
#include "common/base/port_sample.h"

/// Owned, fixed-size forms of what travels in a datagram. Bytes are made and read by proto/wire_codec.h.
namespace tandem::wire {

/// Wire type of a datagram, low four bits of its first byte (common/link/FORMAT.md). 1 and 2 joined people before joining went over TLS.
enum class Type : std::uint8_t {
  kState = 3, kForce = 4, kPathChallenge = 5, kPathResponse = 6, kPing = 7, kClose = 8,
  kAuthority = 9
};

using tandem::PortSample;

enum class GateState : std::uint8_t { kOff, kZero, kRampIn, kActive, kPassive, kDamped, kFault };
/// For people.
[[nodiscard]] constexpr const char* to_text(GateState gate) noexcept {
  constexpr const char* kNames[] = {"off", "zero", "ramp-in", "active", "passive", "DAMPED", "FAULT"};
  return gate <= GateState::kFault ? kNames[static_cast<std::size_t>(gate)] : "?";
}

/// What people and reports want to see of a hand; never used by a law. Single precision on the wire.
struct Telemetry {
  AxisArray q{};                     ///< joints [rad] or [m]
  std::array<double, 3> x{};         ///< tip [m]
  std::array<double, 3> f_cmd{};     ///< commanded at the tip before the gate [N]
  std::array<double, 3> f_out{};     ///< delivered at the tip [N]
  std::array<double, 3> f_env{};     ///< force of the environment on a slave, where known [N]
  double penetration_m = 0;          ///< of a slave in its environment, where known [m]
  EnergyArray e_out{};               ///< [nJ]
  double down_loss_percent = 0;      ///< of what the server sent, since the session began [%]
  double down_longest_gap_ms = 0;    ///< between two datagrams that acted [ms]
  double down_age_p99_ms = 0;        ///< of the newest datagram [ms]
  double dissipated_j = 0;           ///< all axes, cumulative [J]
  double refused_j = 0;              ///< energy the ledger refused, cumulative [J]
  double delivered_j = 0;            ///< energy the motor gave the hand, cumulative [J], sampled-device pairing
  double margin_min_j = 0;           ///< smallest ledger margin so far [J]
};

/// Client to server, every tick, 1 kHz. No reply but FORCE.
struct StateMessage {
  PortSample port;
  Telemetry telemetry;
  GateState gate = GateState::kOff;
  bool ready = false;   ///< the device streams valid readings and waits to be engaged
  bool engaged = false; ///< port sample may act on tools
  bool stop = false;      ///< his own hand is stopped by the person: never engaged while this lasts
  bool stop_all = false;  ///< the person wants the session stopped, or paused, as his role may: held until FORCE counts a new stop
  std::uint32_t resume_stop = 0;  ///< number of the stop the person wants to end; 0: none
  std::uint32_t gate_trips = 0;
  std::uint32_t late_ticks = 0;
  std::uint32_t seat_tick = 0;  ///< session tick at which the sample was taken, 0 before engage
};

/// In kPaused and kStopped nobody is engaged; a person resumes. In kPassive nobody is either: the server does not keep its time, and goes
/// on by itself once it does.
enum class SessionState : std::uint8_t { kWaiting, kRunning, kHeld, kPaused, kStopped, kEnding, kPassive };

/// What was decided about a seat's weight and is not carried out yet (design notes, security 2.5); or will not be.
enum class Handover : std::uint8_t { kNone, kComes, kGoes, kCalledOff };
inline constexpr std::uint32_t kHandoverNotice = 50;  ///< ticks from the decision until weights begin to move
/// Who decided it and who gains most by it, so that a person reads both. Zeros unless something comes or goes.
struct HandoverParties {
  static constexpr std::uint32_t kScene = 0, kOperator = 31, kSeveral = 0;
  std::uint32_t by = kScene;       ///< kScene: the timeline; kOperator: without a seat; else number of the seat, from 1
  std::uint32_t to = kSeveral;     ///< number of the master who gains, from 1; kSeveral: more than one
  std::uint32_t percent = 0;       ///< weight that this master will have, or this seat where several gain [%]
  std::uint32_t tool = 0;          ///< number of the tool
  friend bool operator==(const HandoverParties&, const HandoverParties&) = default;
};

/// The hand that leads: of the seat with most authority over the tool that the receiver follows. For screens, and for the pull of `assist`.
struct Ghost {
  std::uint32_t leader = 0;        ///< number of this master, from 1; 0: no other hand leads, and the rest is 0
  std::array<float, 3> x{};        ///< its tip, as the server believes it to be by now [m]
  std::array<float, 3> v{};        ///< its velocity without what shakes it [m/s]; 0 at JOINT ports
  friend bool operator==(const Ghost&, const Ghost&) = default;
};

/// What a seat is told of one tool that its hand is tied to.
struct TieForce {
  PortSample port;
  double alpha = 0;           ///< of this seat over that tool
  /// Law `replica`: how stiffly the slave of a SLAVE seat pulls at this seat's copy of the tool, by way of the reference, as a part of k_c [0, 1].
  double slave_pull = 0;
  LocalContactList contacts;  ///< surfaces near that tool, law `replica`
};

/// Server to client, every tick, 1 kHz. No reply. Of a hand that is tied to several tools, law `replica`, it begins with the first one; a
/// TieForce follows for each of the others, and a STATE has a PortSample more for each.
struct ForceMessage : TieForce {
  SessionState session = SessionState::kWaiting;
  bool engage = false;           ///< this seat shall be engaged
  std::uint32_t session_tick = 0;
  std::uint32_t authority_version = 0;
  std::uint32_t missing = 0;     ///< required seats that are not ready
  std::uint32_t stops = 0;       ///< how many stops so far: the number of the newest, which a resume must name
  Handover handover = Handover::kNone;
  std::uint32_t handover_ticks = 0;  ///< until it is carried out, kHandoverNotice at most; 0 unless something comes or goes
  HandoverParties handover_parties;
  bool touching = false;             ///< the slave of the tool that this seat follows presses against something; for people only
  Ghost ghost;                       ///< law `replica`; of the first tool's leader
};

inline constexpr std::size_t kFurtherTiesMax = kToolsMax - 1;
inline constexpr std::size_t kSeatNameMax = 32;
inline constexpr std::size_t kSetupMax = 8192;  ///< bytes of a serialized seat setup; the largest scene has room (proto/seat_setup.h)

/// Server to a client that was heard from a new address, up to five times in 250 ms; reply: PATH_RESPONSE with the same token, from
/// that address. Smaller than the STATE that caused it.
struct PathMessage {
  std::uint64_t token = 0;
};

/// Instructor to server, every 20 ms until FORCE shows the version. Weights of all masters over one tool; sum 1.
struct AuthorityMessage {
  std::uint32_t version = 0;  ///< the version it replaces: compare and set
  std::uint32_t tool = 0;
  std::uint32_t masters = 0;
  std::array<double, kMastersMax> alpha{};
};

/// kServerReturns: this server ends and means to go on from its checkpoint; who has a resume secret may come back.
/// kRemoved: somebody who may took the seat away; kRevoked: the workstation is no longer known to the server.
enum class CloseReason : std::uint8_t { kDone, kLeaving, kServerStops, kRefused, kServerReturns, kRemoved, kRevoked };
inline constexpr std::uint32_t kCloseReasonMax = static_cast<std::uint32_t>(CloseReason::kRevoked);
struct CloseMessage {
  CloseReason reason = CloseReason::kDone;
};

/// First bytes of every plaintext.
struct Preamble {
  std::uint64_t echo_counter = 0;  ///< newest counter of the peer that was used
  std::uint32_t echo_age_us = 0;   ///< time between its arrival and this datagram
  std::uint32_t tick = 0;          ///< sender's tick count
};

static_assert(std::is_trivially_copyable_v<StateMessage> && std::is_trivially_copyable_v<ForceMessage>);

}  // namespace tandem::wire
