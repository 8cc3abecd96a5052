#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "common/control/authority.h"
#include "proto/spec/access_role.h"
#include "proto/wire/wire_messages.h"
#include "server/policy/load_shedder.h"
#include "server/report/audit_event.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

class Session;

/// A command from a control connection, as plain data. The control plane creates it, the session's thread executes it
/// between two ticks. The control plane has checked that the role may use such a command at all (roles.h). The session
/// checks what only it knows: versions, stop numbers and the parties of an authority change.
struct SessionCommand {
  enum class What : std::uint8_t { kQueryStatus, kStop, kPause, kResume, kSetAuthority, kRemove };
  What what = What::kQueryStatus;
  AccessRole role = AccessRole::kObserver;
  std::uint8_t seat = AuditEvent::kNoSeat;  ///< seat of the participant, AuditEvent::kNoSeat for a console
  std::uint32_t cid = 0;                    ///< of the participant's datagrams: they must still own the seat
  std::uint32_t number = 0;                 ///< kResume: number of the stop to end
  wire::AuthorityMessage authority{};       ///< kSetAuthority
  std::uint8_t target_seat = 0;             ///< kRemove: seat to free
  std::uint32_t target_cid = 0;             ///< kRemove: only if the seat still has this connection; 0: any
  wire::CloseReason close_reason = wire::CloseReason::kRemoved;
};

/// Result of a command, and the state of the session afterwards.
struct CommandOutcome {
  enum class Result : std::uint8_t {
    kDone,
    kForbidden,     ///< the role may not do this, or not to these seats
    kSeatLost,      ///< the participant does not own the seat any more
    kOutdated,      ///< the number or version is not the newest
    kHeldByOthers,  ///< kResume: the participant's own pause is withdrawn, other seats' pauses are on
    kNothingToDo,   ///< nothing to resume, or no participant to remove
    kInvalid,       ///< no such tool or seat, or a different number of masters
    kStaleLink,     ///< a party to the change has a stale link
  };
  struct Seat {
    bool taken = false, heard = false;
  };
  Result result = Result::kSeatLost;
  wire::SessionState state = wire::SessionState::kEnding;
  StopLatch stop_latch{};             ///< includes the seat that stopped, and the rules for ending the stop
  double stop_age = 0;                ///< age of the newest stop [s]; 0 if there was none
  std::uint32_t connected_seats = 0;  ///< connected seats, bit i for seat i
  bool recovering = false;  ///< waiting after a restart: a resume by an instructor continues without the missing seats
  std::uint32_t stops = 0, authority_version = 0, tick = 0;
  double time = 0;  ///< session clock [s]
  ShedLevel shed_level = ShedLevel::kNone;
  std::uint8_t masters = 0, tools = 0;
  control::MasterArray before{};  ///< kSetAuthority: scheduled authority over the tool before the command
  /// Scheduled authority, which `authority_version` stands for; in force 50 ticks later.
  std::array<control::MasterArray, kToolsMax> alpha{};
  std::array<Seat, kSeatsMax> seats{};
};
static_assert(std::is_trivially_copyable_v<SessionCommand> && std::is_trivially_copyable_v<CommandOutcome>);

[[nodiscard]] CommandOutcome execute_command(Session& session, Time now, const SessionCommand& command) noexcept;

}  // namespace tandem::server
