#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>

#include "common/control/authority.h"
#include "proto/rpc/rpc_messages.h"
#include "proto/spec/access_role.h"
#include "proto/wire/wire_messages.h"
#include "server/policy/load_shedder.h"
#include "server/report/audit_event.h"
#include "server/session/command_result.h"
#include "server/session/restore_counts.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

class Session;

/// A command of a joined control connection, as the client sent it. The control plane passes it to the session's
/// thread, which executes it between two ticks. The control plane has checked that the role may use such a command at
/// all (roles.h). The session checks what only it knows: versions, stop numbers and the parties of an authority change.
struct SessionCommand {
  ///  StatusRequest, StopSession, PauseSession, ResumeSession, SetAuthority, RemoveParticipant or Note.
  rpc::Body body = rpc::StatusRequest{};
  AccessRole role = AccessRole::kObserver;
  std::uint8_t seat = AuditEvent::kNoSeat;  ///< seat of the client, AuditEvent::kNoSeat for a console
  std::uint32_t cid = 0;                    ///< of the client's datagrams: they must still own the seat
  std::uint32_t order = 0;                  ///< number for the events that follow from it; changes nothing else
  std::string workstation{}, person{};      ///< of the client, for the words of a stop; person empty: not named
};

/// Result of a command, and the state of the session afterwards.
struct CommandOutcome {
  using Result = CommandResult;
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
  std::uint32_t orders = 0;                 ///< Checkpoint::orders of every checkpoint that has this command
  std::optional<RestoreCounts> restores{};  ///< of the session; nullopt: not known
  double time = 0;                          ///< session clock [s]
  bool may_act = true;  ///< false: the directory of the service is silent, so that no hand is engaged
  ShedLevel shed_level = ShedLevel::kNone;
  std::uint8_t masters = 0, tools = 0;
  std::uint8_t target_seat = 0;   ///< RemoveParticipant: the named seat
  control::MasterArray before{};  ///< SetAuthority: scheduled authority over the tool before the command
  /// Scheduled authority, which `authority_version` stands for; in force 50 ticks later.
  std::array<control::MasterArray, kToolsMax> alpha{};
  std::array<Seat, kSeatsMax> seats{};
};
static_assert(std::is_trivially_copyable_v<CommandOutcome>);

[[nodiscard]] CommandOutcome execute_command(Session& session, Time now, const SessionCommand& command) noexcept;

/// Removes the client of a seat: it releases its hand, then receives CLOSE.
/// @param cid  of its datagrams: another client keeps the seat; 0: any client
[[nodiscard]] CommandOutcome::Result remove_client(Session& session, std::size_t seat, std::uint32_t cid,
                                                   wire::CloseReason why) noexcept;

}  // namespace tandem::server
