#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "proto/rpc/rpc_limits.h"
#include "proto/spec/registry_spec.h"

/// Structs of the lists of sessions on the control connection (proto/schema/rpc.proto).
namespace tandem::rpc {

/// Phase of a session for clients. kHeld: its server does not reach the directory of the service, so no hand is
/// engaged. Peers of before this phase get kRunning (older_peers.h).
enum class SessionPhase : std::uint8_t { kWaiting, kRunning, kPaused, kStopped, kEnding, kOverloaded, kHeld };
inline constexpr std::size_t kSessionPhases = static_cast<std::size_t>(SessionPhase::kHeld) + 1;
[[nodiscard]] constexpr const char* to_text(SessionPhase phase) noexcept {
  constexpr std::array<const char*, kSessionPhases> kNames{"waiting", "running",    "paused", "stopped",
                                                           "ending",  "overloaded", "held"};
  const auto i = static_cast<std::size_t>(phase);
  return i < kNames.size() ? kNames[i] : "?";
}
/// Returns the phase of this name; nothing: no phase has it.
[[nodiscard]] constexpr std::optional<SessionPhase> session_phase_named(std::string_view name) noexcept {
  for (std::size_t i = 0; i < kSessionPhases; ++i)
    if (name == to_text(static_cast<SessionPhase>(i))) return static_cast<SessionPhase>(i);
  return std::nullopt;
}
using ListedSeat = OpenSeat;
struct ListedSession {
  Id id{};
  std::string name;
  SessionPhase phase = SessionPhase::kWaiting;
  std::vector<ListedSeat> seats;  ///< at most kListedSeatsMax
  std::string server{};           ///< name of its server in the service; empty: no service, or not asked for
  friend bool operator==(const ListedSession&, const ListedSession&) = default;
};
struct SessionListRequest {
  std::uint32_t after = 0;  ///< `last` of the page before; 0: the first page
  bool service = false;     ///< sessions of the whole service; only for a server that shows a credential of a service
  friend bool operator==(const SessionListRequest&, const SessionListRequest&) = default;
};
struct SessionList {
  std::vector<ListedSession> sessions;  ///< at most kListedSessionsMax, in the order in which they were opened
  bool more = false;                    ///< another page follows
  std::uint32_t last = 0;               ///< for the request of the next page; 0 without one
  bool old = false;  ///< the sessions of other servers may have changed: the directory is not reached
  friend bool operator==(const SessionList&, const SessionList&) = default;
};

}  // namespace tandem::rpc
