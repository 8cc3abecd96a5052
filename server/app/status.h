#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "common/io/text_layout.h"
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
  bool stopped = false;  ///< the person stopped the own hand (key s)
  double weight = 0;     ///< the greatest authority over any tool that is decided for it; 1 for a seat that is a tool's slave
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
  std::uint64_t audit_dropped = 0;  ///< events that nobody took in time: they are not in the audit log
  std::array<SeatStatus, kSeatsMax> seats{};
  MachineStatus machine;
  StopLane stop;
  bool waits = false;  ///< for people: it has not begun, or gathers them after a restart; also while it is stopped
};
/// Bit i: seat i is heard.
[[nodiscard]] std::uint32_t seats_heard(const SessionStatus& status) noexcept;

/// Why nobody leads any tool, in one sentence for people: `trainer left; ...`. Only seats that have authority, or carry a tool, are named.
[[nodiscard]] std::string why_held(const SessionStatus& status, const SceneSpec& scene);

/// What a screen shows of a session, the important first: its state and who leads in `row`, then its seats in the row after that.
/// @param reach  options by which a `tandem-client control` command finds the session
[[nodiscard]] std::vector<io::ScreenItem> status_items(const SessionStatus& status, const SceneSpec& scene, const std::string& session = {}, std::size_t row = 0,
                                                       const std::string& reach = {});

struct SessionOnScreen {
  std::string name;
  SessionStatus status;
  const SceneSpec* scene = nullptr;
  std::string reach{};  ///< as for `status_items`
};
/// A server's screen: two lines per session, or one where `rows` are too few; then how many sessions are left out.
/// @param drain  shown first; empty: the server does not drain  @param list  the command that lists all sessions of this server
[[nodiscard]] std::vector<io::ScreenItem> screen_items(std::span<const SessionOnScreen> sessions, const std::string& drain, std::size_t rows, const std::string& list);

/// `trainee (nobody joined), slave (not ready)`: the required seats a session waits for; empty if for none.
[[nodiscard]] std::string waiting_for(const SessionStatus& status, const SceneSpec& scene);

}  // namespace tandem::server
