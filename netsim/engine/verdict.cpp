#include "netsim/engine/verdict.h"

namespace tandem::netsim {

const char* name(Outcome outcome) noexcept {
  switch (outcome) {
    case Outcome::kDeliver:
      return "delivered";
    case Outcome::kHeldBack:
      return "reordered";
    case Outcome::kOutage:
      return "outage";
    case Outcome::kHoldFull:
      return "hold full";
    case Outcome::kLost:
      return "lost";
    case Outcome::kQueueFull:
      return "queue full";
    case Outcome::kOverflow:
      return "overflow";
    case Outcome::kTooLong:
      return "too long";
    case Outcome::kCorrupted:
      return "corrupted";
    case Outcome::kAboveMtu:
      return "above MTU";
    case Outcome::kOldAddress:
      return "old address";
    case Outcome::kClientGone:
      return "client gone";
    case Outcome::kPushedOut:
      return "pushed out";
    case Outcome::kReplaced:
      return "replaced";
    case Outcome::kWaiting:
      return "waiting";
  }
  return "?";
}

}  // namespace tandem::netsim
