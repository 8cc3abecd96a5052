#pragma once

#include <cstdint>
#include <functional>

#include "common/io/datagram_steering.h"
#include "server/session/seat_catalogue.h"
#include "server/session/session_command.h"

namespace tandem::server {

class LiveSession;
class Shard;

/// Request from the control plane to a shard. The control plane creates, fills and frees it; the shard executes it
/// between two ticks.
struct ShardRequest {
  enum class What : std::uint8_t {
    kAddSession,   ///< serve `session` from now on, in its slot
    kQuerySeat,    ///< whether `seat` is available
    kAdmit,        ///< attach `connection` to `seat`
    kAdmitPeer,    ///< admit `connection.link` as a peer without a seat
    kEndSession,   ///< end the session: release all hands, then send CLOSE with reason `why`
    kCommand,      ///< execute `command` of a control connection; result in `outcome`
    kRevokeSeat,   ///< remove the client `cid` from `seat`; result and tick in `outcome`
    kQueryPeers,   ///< number of free slots of `peers`, in `place`
    kRemovePeer,   ///< remove the peer `cid` in slot `place` of `peers`
    kMoveSession,  ///< pass the session to shard `target` after one of the next ticks; completed by the target
  };
  enum class Peers : std::uint8_t { kLinkTests, kWatchers };
  What what = What::kAdmit;
  LiveSession* session = nullptr;  ///< valid until it is over
  std::size_t seat = 0;
  bool same_owner = false;      ///< the client is the seat's owner, who resumes
  SeatConnection connection{};  ///< out: previous contents of the seat, to be freed
  Duration silence{};           ///< kQuerySeat, out: silence of the seat's client; 0 if the seat is free
  bool ever_heard = false;      ///< kQuerySeat, out: the client was heard since it took the seat
  JoinResult result = JoinResult::kSessionOver;
  SessionCommand command{};
  CommandOutcome outcome{};  ///< out; invalid if `result` is kSessionOver
  Peers peers = Peers::kLinkTests;
  bool every_tick = true;  ///< kAdmitPeer: the watcher records the session
  std::size_t place = 0;   ///< slot of a peer, or number of free slots; kAdmitPeer, out: the peer's slot
  std::uint32_t cid = 0;
  wire::CloseReason why = wire::CloseReason::kServerStops;
  Shard* posted_to = nullptr;  ///< set by `Shard::post`
  Shard* target = nullptr;     ///< kMoveSession: of the same tick rate, with a socket of the same port
  /// kMoveSession: the kernel's program that gives the session's datagrams to the target, and the one in force.
  const io::SteeringProgram *steering = nullptr, *steering_before = nullptr;
  std::function<void(ShardRequest&)> done = [](ShardRequest&) {};  ///< called on the control plane's thread
};

}  // namespace tandem::server
