#pragma once

#include <cstdint>
#include <functional>

#include "server/command.h"
#include "server/reception.h"

namespace tandem::server {

class HostedSession;

/// What the control plane asks of a shard's thread: made, filled and given back to memory by the control plane; the shard only
/// carries it out between two ticks.
struct Order {
  enum class What : std::uint8_t {
    kHost,   ///< tick `session` from now on, in its slot
    kAsk,    ///< whether `seat` can be had
    kAdmit,  ///< put `entry` into `seat`
    kVisit,  ///< take `entry.link` as a visitor's
    kEnd,    ///< let all hands of the session go, then tell the clients
    kCommand,        ///< `command`, of somebody at a control connection; answered by `outcome`
    kMayVisit,       ///< how many visitors there is room for: `place`
    kDismissVisitor, ///< send the visitor `cid` in `place` away
  };
  What what = What::kAdmit;
  HostedSession* session = nullptr;  ///< which; lives until it is over
  std::size_t seat = 0;
  bool same_owner = false;           ///< he who sits there comes again
  Entry entry;                       ///< afterwards: what is to be given back
  Duration silence{};                ///< kAsk, afterwards: of who sits there; 0 if nobody does
  bool spoken = false;               ///< kAsk, afterwards: he was heard since he was given the seat
  JoinResult result = JoinResult::kSessionOver;
  Command command{};
  Outcome outcome{};                 ///< kGone: the session is over
  std::size_t place = 0;             ///< of a visitor: afterwards the one he got
  std::uint32_t cid = 0;
  std::function<void(Order&)> done;  ///< on the control plane's thread
};

}  // namespace tandem::server
