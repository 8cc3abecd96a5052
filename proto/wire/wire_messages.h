#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <type_traits>

#include "common/base/axes.h"
#include "common/base/local_contact.h"
#include "common/base/port_sample.h"

/// Fixed-size structs of the datagram messages. proto/wire/wire_codec.h encodes and decodes them.
namespace tandem::wire {

/// Wire type of a datagram, the low four bits of its first byte (common/transport/FORMAT.md). Types 1 and 2 are unused:
/// they were the join messages before joining moved to TLS.
enum class Type : std::uint8_t {
  kState = 3,
  kForce = 4,
  kPathChallenge = 5,
  kPathResponse = 6,
  kPing = 7,
  kClose = 8,
  kAuthority = 9,
  kLinkProbe = 10,
  kLinkReport = 11,
  kTelemetry = 12,
  kWatch = 13
};
inline constexpr std::uint8_t kFirstType = 3, kLastType = 13;

using tandem::PortSample;

enum class GateState : std::uint8_t { kOff, kZero, kRampIn, kActive, kReleasing, kLatched, kFault };
/// Text for screens and reports.
[[nodiscard]] constexpr const char* to_text(GateState gate) noexcept {
  constexpr const char* kNames[] = {"off", "zero", "ramp-in", "active", "passive", "DAMPED", "FAULT"};
  return gate <= GateState::kFault ? kNames[static_cast<std::size_t>(gate)] : "?";
}

/// Values of a seat for screens and reports; no control law uses them. Single precision on the wire. STATE carries them
/// at 60 Hz, and at every tick while the server records the session (ForceMessage::telemetry_every_tick).
struct Telemetry {
  AxisArray q{};                   ///< joints [rad] or [m]
  std::array<double, 3> x{};       ///< tip [m]
  std::array<double, 3> f_cmd{};   ///< commanded at the tip before the gate [N]
  std::array<double, 3> f_out{};   ///< delivered at the tip [N]
  std::array<double, 3> f_env{};   ///< force of the environment on a slave, if known [N]
  double penetration_m = 0;        ///< of a slave in its environment, if known [m]
  EnergyArray e_out{};             ///< [nJ]
  double down_loss_percent = 0;    ///< loss from server to client since the session began [%]
  double down_longest_gap_ms = 0;  ///< between two datagrams that were used [ms]
  double down_age_p99_ms = 0;      ///< of the newest datagram [ms]
  double dissipated_j = 0;         ///< all axes, cumulative [J]
  double refused_j = 0;            ///< energy the ledger refused, cumulative [J]
  double delivered_j = 0;   ///< energy that the motor delivered to the hand, cumulative [J], sampled-device pairing
  double margin_min_j = 0;  ///< smallest ledger margin so far [J]
  std::uint32_t gate_trips = 0;
  std::uint32_t late_ticks = 0;
};
inline constexpr double kTelemetryHz = 60;  ///< rate of telemetry while no report, trace or recording is on [Hz]

/// Client to server, every tick, 1 kHz, unless the scene has `send`. No reply but FORCE.
struct StateMessage {
  PortSample port;
  Telemetry telemetry;
  bool with_telemetry = true;  ///< this datagram carries `telemetry`
  GateState gate = GateState::kOff;
  bool ready = false;             ///< the device delivers valid readings and waits for engagement
  bool engaged = false;           ///< the port sample may act on tools
  bool stop = false;              ///< local stop by the operator: the seat is not engaged while it lasts
  bool stop_all = false;          ///< request to stop or pause the session, per role; held until FORCE counts it
  std::uint32_t resume_stop = 0;  ///< number of the stop that the operator requests to end; 0: none
  std::uint32_t seat_tick = 0;    ///< session tick at which the sample was taken; 0 before engagement
};

/// State of a session. In kPaused and kStopped no seat is engaged until a participant or console resumes. In
/// kOverloaded no seat is engaged because the server misses its tick deadlines; it continues by itself once it meets
/// them.
enum class SessionState : std::uint8_t { kWaiting, kRunning, kHeld, kPaused, kStopped, kEnding, kOverloaded };

/// Notice to a seat about a decided change of its authority that is pending (ARCHITECTURE.md, invariant 53) or
/// cancelled.
enum class TransferNotice : std::uint8_t { kNone, kGaining, kLosing, kCancelled };
inline constexpr std::uint32_t kTransferNoticeTicks = 50;  ///< ticks from the decision until authority begins to move
/// Origin and main receiver of a change of authority, for display. Zeros unless a change is pending.
struct TransferParties {
  static constexpr std::uint32_t kScene = 0, kOperator = 31, kSeveral = 0;
  std::uint32_t by = kScene;    ///< kScene: the timeline; kOperator: a console; else seat number, from 1
  std::uint32_t to = kSeveral;  ///< number of the master that gains, from 1; kSeveral: more than one
  std::uint32_t percent = 0;    ///< future authority of that master, or of this seat if several gain [%]
  std::uint32_t tool = 0;       ///< number of the tool
  friend bool operator==(const TransferParties&, const TransferParties&) = default;
};

/// Tip of the leading master: the seat with most authority over the tool that the receiver follows. For display and for
/// the force of `assist`.
struct Ghost {
  std::uint32_t leader = 0;  ///< number of this master, from 1; 0: no other seat leads, and the rest is 0
  std::array<float, 3> x{};  ///< predicted present position of its tip [m]
  std::array<float, 3> v{};  ///< its velocity without tremor [m/s]; 0 at JOINT ports
  friend bool operator==(const Ghost&, const Ghost&) = default;
};

/// Command of one tool for a seat that is coupled to it.
struct ToolForce {
  PortSample port;
  double alpha = 0;  ///< authority of this seat over that tool
  /// Law REPLICA: stiffness of the spring between the slave of a SLAVE seat and this seat's copy of the tool, as a
  /// fraction of k_c [0, 1]. It acts through the reference.
  double slave_pull = 0;
  LocalContactList contacts;  ///< surfaces near that tool, law REPLICA
};

/// Server to client, every tick, 1 kHz, unless the scene has `send`. No reply. For a seat that is coupled to several
/// tools, law REPLICA, it holds the first tool. One ToolForce follows for each of the others, and a STATE has one more
/// PortSample for each.
struct ForceMessage : ToolForce {
  SessionState session = SessionState::kWaiting;
  bool engage = false;  ///< the server requests engagement of this seat
  std::uint32_t session_tick = 0;
  std::uint32_t authority_version = 0;
  std::uint32_t missing = 0;  ///< required seats that are not ready
  std::uint32_t stops = 0;    ///< number of stops so far, which is the number of the newest; a resume must name it
  TransferNotice transfer = TransferNotice::kNone;
  std::uint32_t transfer_ticks = 0;  ///< until authority begins to move, at most kTransferNoticeTicks; 0 unless pending
  TransferParties transfer_parties;
  bool telemetry_every_tick = true;  ///< the server records: each STATE should carry telemetry
  bool touching = false;  ///< the slave of the tool that this seat follows touches something; for display only
  Ghost ghost;            ///< law REPLICA; leader of the first tool
};

inline constexpr std::size_t kFurtherToolsMax = kToolsMax - 1;
inline constexpr std::size_t kSeatNameMax = 32;
inline constexpr std::size_t kSetupMax = 8192;  ///< bytes of a serialized SeatSetup; enough for the largest scene

/// Server to client after an authentic datagram from a new address, up to five times in 250 ms. Reply: PATH_RESPONSE
/// with the same token, from that address. It is smaller than the STATE that caused it.
struct PathMessage {
  std::uint64_t token = 0;
};

/// Instructor to server, every 20 ms until FORCE carries the version. Authority of all masters over one tool; sum 1.
struct AuthorityMessage {
  std::uint32_t version = 0;  ///< the version that it replaces: compare and set
  std::uint32_t tool = 0;
  std::uint32_t masters = 0;
  std::array<double, kMastersMax> alpha{};
};

/// Reason for closing a connection. kServerReturns: this server exits and will restart from its checkpoint; clients
/// with a resume secret may rejoin. kRemoved: an authorised role removed the seat. kRevoked: the server no longer
/// accepts the workstation's key.
enum class CloseReason : std::uint8_t { kDone, kLeaving, kServerStops, kRefused, kServerReturns, kRemoved, kRevoked };
inline constexpr std::uint32_t kCloseReasonMax = static_cast<std::uint32_t>(CloseReason::kRevoked);
struct CloseMessage {
  CloseReason reason = CloseReason::kDone;
};

/// The first bytes of every plaintext.
struct Preamble {
  std::uint64_t echo_counter = 0;  ///< newest counter of the peer that was used
  std::uint32_t echo_age_us = 0;   ///< time between its arrival and this datagram
  std::uint32_t tick = 0;          ///< sender's tick count
};

static_assert(std::is_trivially_copyable_v<StateMessage> && std::is_trivially_copyable_v<ForceMessage>);

}  // namespace tandem::wire
