#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/io/text_layout.h"
#include "common/transport/secure_channel.h"
#include "proto/spec/scene_spec.h"
#include "proto/wire/wire_messages.h"
#include "server/policy/load_shedder.h"
#include "server/report/report.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// Status of a seat for display and metrics: plain data, copied from the shard at intervals.
struct SeatStatus {
  bool taken = false;  ///< a client has the seat
  bool ever_taken = false;
  bool ready = false;    ///< its device is ready to be engaged, or is engaged
  bool alive = false;    ///< heard within the hold limit
  bool stopped = false;  ///< the participant stopped their own hand (key s)
  /// Greatest requested authority over any tool; 1 for a slave seat.
  double authority_max = 0;
  wire::GateState gate = wire::GateState::kOff;
  double alpha = 0;
  double margin_j = 0;  ///< smallest energy margin of the seat's ledger so far [J]
  std::uint32_t gate_trips = 0;
  std::uint32_t late_ticks = 0;          ///< of the client's machine
  double loop_age_s = 0;                 ///< age of the newest echo [s]; 0: none yet
  std::uint64_t accepted = 0, late = 0;  ///< datagrams of this connection
  std::uint64_t lost = 0;                ///< likewise; its maximum, because a late datagram lowers the number
  /// Rejected datagrams by reason, of all connections of the seat.
  std::array<std::uint64_t, static_cast<std::size_t>(transport::DropReason::kCount)> refused{};
  double recent_rtt_p99_ms = 0;  ///< of the last 1000 round trips
  LinkReport link;
};

/// Timing of this machine's ticks, and load state.
struct MachineStatus {
  std::uint64_t late_ticks = 0;    ///< ticks that began more than 1 ms late
  std::uint64_t missed_ticks = 0;  ///< ticks whose whole period passed; they are run later
  bool late = false;               ///< the current tick began more than 1 ms late
  bool started = false;            ///< the thread of the ticks runs, so that `realtime` is known
  bool realtime = false;           ///< the kernel granted real-time priority
  LoadState load_state;            ///< shed level and overload
};

struct SessionStatus {
  wire::SessionState state = wire::SessionState::kWaiting;
  double time = 0;                        ///< session clock [s]
  std::uint64_t unmatched_datagrams = 0;  ///< datagrams to this session that belong to no connection
  std::uint64_t violations = 0;           ///< 1 if an invariant that the law guarantees was violated; 0 otherwise
  std::uint64_t audit_dropped = 0;        ///< events missing in the audit log, because a queue was full
  std::array<SeatStatus, kSeatsMax> seats{};
  MachineStatus machine;
  StopLatch stop;
  /// The server knows for certain that no other one owns the session; false: all hands are disengaged.
  bool may_act = true;
  bool waiting = false;  ///< it has not begun, or waits for participants after a restart, even while it is stopped
};
/// Seats whose client is alive, bit i for seat i.
[[nodiscard]] std::uint32_t connected_seats_mask(const SessionStatus& status) noexcept;

/// Why the tools are braked, in one sentence for users: `trainer left; ...`. It names only seats that have authority
/// or a slave.
[[nodiscard]] std::string held_reason_text(const SessionStatus& status, const SceneSpec& scene);

/// Screen items of a session, the most important first. State and leading seats are in `row`, the seats in the next
/// row.
/// @param reach  options with which `tandem-client control` finds the session
[[nodiscard]] std::vector<io::ScreenItem> status_items(const SessionStatus& status, const SceneSpec& scene,
                                                       const std::string& session = {}, std::size_t row = 0,
                                                       const std::string& reach = {});

struct SessionScreenEntry {
  std::string name;
  SessionStatus status;
  const SceneSpec* scene = nullptr;
  std::string reach{};      ///< as for `status_items`
  std::string recording{};  ///< words about its recording; empty: none
};
/// Screen of a server: two lines per session, or one if `rows` are too few, then the number of sessions not shown.
/// @param drain  shown first; empty: the server does not drain
/// @param list   command that lists all sessions of this server
[[nodiscard]] std::vector<io::ScreenItem> screen_items(std::span<const SessionScreenEntry> sessions,
                                                       const std::string& drain, std::size_t rows,
                                                       const std::string& list);

/// Required seats for which a session waits, as `trainee (left), slave (not ready)`; empty if it waits for
/// none.
[[nodiscard]] std::string waiting_for(const SessionStatus& status, const SceneSpec& scene);

}  // namespace tandem::server
