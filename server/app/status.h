#pragma once

#include <array>
#include <cstdint>
#include <string>

#include "common/link/link.h"
#include "proto/scene_spec.h"
#include "proto/wire.h"
#include "server/load_ladder.h"
#include "server/report.h"
#include "server/stop_lane.h"

namespace tandem::server {

/// What people want to see of a seat while it runs: plain data, copied out of the shard now and then.
struct SeatStatus {
  bool taken = false;  ///< somebody sits here
  bool ever_taken = false;
  bool ready = false;  ///< its device waits to be engaged, or is
  bool alive = false;  ///< heard from just now
  wire::GateState gate = wire::GateState::kOff;
  double alpha = 0;
  double margin_j = 0;  ///< smallest energy margin of its ledger so far [J]
  std::uint32_t gate_trips = 0;
  std::uint32_t late_ticks = 0;  ///< of the client's machine
  double loop_age_s = 0;         ///< how old the newest echo is [s]; 0: none yet
  std::uint64_t accepted = 0, late = 0, lost = 0;  ///< datagrams of this connection
  std::array<std::uint64_t, static_cast<std::size_t>(link::Refusal::kCount)> refused{};  ///< by reason
  LinkReport link;
};

/// How punctual this machine was.
struct MachineStatus {
  std::uint64_t late_ticks = 0;    ///< began more than 1 ms after their time
  std::uint64_t missed_ticks = 0;  ///< whose time passed altogether; lived through afterwards
  bool realtime = false;           ///< the kernel granted real-time priority
  Relief relief;                   ///< what is gone without
};

struct SessionStatus {
  wire::SessionState state = wire::SessionState::kWaiting;
  double time = 0;  ///< session time [s]
  std::uint64_t stray = 0;      ///< datagrams to this session for no connection
  std::uint64_t violations = 0; ///< broken invariants that the law promises
  std::array<SeatStatus, kSeatsMax> seats{};
  MachineStatus machine;
  StopLane stop;
};
/// Bit i: seat i is heard.
[[nodiscard]] std::uint32_t seats_heard(const SessionStatus& status) noexcept;

/// Whose absence brakes the tools, for people.
[[nodiscard]] std::string why_held(const SessionStatus& status, const SceneSpec& scene);

/// One line for a terminal.
[[nodiscard]] std::string status_line(const SessionStatus& status, const SceneSpec& scene);

/// `trainee (nobody joined), slave (not ready)`: the required seats a session waits for; empty if for none.
[[nodiscard]] std::string waiting_for(const SessionStatus& status, const SceneSpec& scene);

}  // namespace tandem::server
