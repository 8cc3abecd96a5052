#pragma once

#include <array>
#include <cstdint>
#include <type_traits>

#include "common/control/authority.h"
#include "proto/access_role.h"
#include "proto/wire.h"
#include "server/audit.h"
#include "server/load_ladder.h"
#include "server/stop_lane.h"

namespace tandem::server {

class Session;

/// What somebody asks of a session over a control connection: plain data, made by the control plane, carried out by the session's own
/// thread between two ticks. Whether his role may ask for such a thing at all was decided before (roles.h); what the session alone knows
/// is judged here: versions, numbers, whose weights.
struct Command {
  enum class What : std::uint8_t { kLook, kStop, kPause, kResume, kSetAuthority, kRemove };
  What what = What::kLook;
  AccessRole who = AccessRole::kObserver;
  std::uint8_t seat = AuditEvent::kNoSeat;  ///< of the scene that he sits on; then
  std::uint32_t cid = 0;                    ///< of his datagrams: the seat must still be his
  std::uint32_t number = 0;                 ///< kResume: of the stop that is to be ended
  wire::AuthorityMessage wish{};            ///< kSetAuthority
  std::uint8_t whom = 0;                    ///< kRemove: the seat
  std::uint32_t whom_cid = 0;               ///< kRemove: only if the seat is still this connection's; 0: whoever sits there
  wire::CloseReason why = wire::CloseReason::kRemoved;
};

/// What became of it, and how the session stands now.
struct Outcome {
  enum class Result : std::uint8_t {
    kDone,
    kForbidden,  ///< his role may not do this to those
    kGone,       ///< the seat he speaks for is not his any more
    kOutdated,   ///< the number or version that he named is not the newest
    kOthers,     ///< kResume: his own pause is taken back, others' last
    kNothing,    ///< there is nothing to resume, or nobody to remove
    kWrong,      ///< no such tool or seat, or another number of masters
    kOutOfTouch, ///< somebody whose weight would change is not heard from
  };
  struct Seat {
    bool taken = false, heard = false;
  };
  Result result = Result::kGone;
  wire::SessionState state = wire::SessionState::kEnding;
  StopLane lane{};                      ///< who stopped, and who may end it
  double stopped_ago = 0;               ///< the newest stop [s]
  std::uint32_t there = 0;              ///< seats that are heard, bit i: seat i
  bool gathering = false;               ///< back from a checkpoint: an instructor who resumes goes on without those who are missing
  std::uint32_t stops = 0, authority_version = 0, tick = 0;
  double time = 0;                      ///< of the session [s]
  Rung shed = Rung::kNothing;
  std::uint8_t masters = 0, tools = 0;
  control::Weights before{};            ///< kSetAuthority: decided of the tool until now
  std::array<control::Weights, kToolsMax> alpha{};  ///< decided: what `authority_version` stands for, in force 50 ticks later
  std::array<Seat, kSeatsMax> seats{};
};
static_assert(std::is_trivially_copyable_v<Command> && std::is_trivially_copyable_v<Outcome>);

[[nodiscard]] Outcome carry_out(Session& session, Time now, const Command& command) noexcept;

}  // namespace tandem::server
