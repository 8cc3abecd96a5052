#pragma once

#include <array>
#include <cstdint>
#include <limits>

#include "common/base/axes.h"
#include "proto/wire/wire_messages.h"

/// The state of a session for screens and recordings: TELEMETRY, from the server to watchers. A watcher is a console
/// that sees a session, and that keeps its slot with WATCH. No control law uses any of it. Values that are not known
/// are NaN, never 0.
namespace tandem::wire {

inline constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Watcher to server, ten times per second.
struct WatchMessage {};
inline constexpr double kWatchHz = 10;

struct WatchedSeatState {
  bool taken = false;    ///< a client has the seat
  bool heard = false;    ///< heard within its hold limit
  bool engaged = false;  ///< its sample acts on tools
  bool stopped = false;  ///< local stop by the participant
  GateState gate = GateState::kOff;
  /// MASTER seats: tip [m], and force delivered to the hand [N]. The tip of a SLAVE seat is that of its tool.
  std::array<double, 3> x{kUnknown, kUnknown, kUnknown}, f{kUnknown, kUnknown, kUnknown};
};

struct WatchedToolState {
  bool touching = false;
  bool braked = false;                                    ///< no seat controls the tool
  std::array<double, 3> x{kUnknown, kUnknown, kUnknown};  ///< tip of the slave, or position of a virtual tool [m]
  std::array<double, 3> f{kUnknown, kUnknown, kUnknown};  ///< force of the environment on it [N]
  double depth = kUnknown;                                ///< in the environment [m]
};

/// Link and device of one seat.
struct WatchedLink {
  std::uint32_t seat = 0;
  double rtt_p50_ms = kUnknown;
  double loss_up_percent = kUnknown, gap_up_ms = kUnknown;  ///< client to server; longest time without a datagram
  double loss_down_percent = kUnknown, gap_down_ms = kUnknown, age_p99_ms = kUnknown;  ///< server to client
  double margin_min_j = kUnknown;  ///< least energy margin so far [J]
  std::uint32_t gate_trips = 0, late_ticks = 0;
};

/// Authority over one tool.
struct WatchedAuthority {
  std::uint32_t tool = 0;
  std::uint32_t transfer_ticks = 0;  ///< until an announced change begins, at most kTransferNoticeTicks; 0: none
  std::uint32_t transfer_by = TransferParties::kScene;  ///< its origin, as TransferParties::by; 0 if none
  std::array<double, kMastersMax> wanted{}, applied{};  ///< of each master: decided, and in force [0, 1]
};

/// Server to watchers, at wire::kTelemetryHz, and at every tick to recorders. Seats take turns in `link`, tools in
/// `authority`, one per datagram, so that the largest scene fits into one.
struct SessionTelemetry {
  std::uint32_t session_tick = 0;
  SessionState state = SessionState::kWaiting;
  std::uint32_t shed_level = 0;  ///< server/policy/load_shedder.h
  std::uint32_t authority_version = 0, stops = 0;
  std::array<WatchedSeatState, kSeatsMax> seats{};
  std::array<WatchedToolState, kToolsMax> tools{};
  WatchedLink link;
  WatchedAuthority authority;
};
inline constexpr std::uint32_t kShedLevelMax = 6;

}  // namespace tandem::wire
