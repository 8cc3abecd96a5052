#include "netsim/engine/path_decision.h"

#include <array>

namespace tandem::netsim {

const char* name(Outcome outcome) noexcept {
  constexpr std::array<const char*, kOutcomes> kNames{
      "delivered", "reordered", "outage",      "hold full",   "lost",       "queue full", "overflow", "too long",
      "corrupted", "above MTU", "old address", "client gone", "pushed out", "replaced",   "waiting"};
  const auto number = static_cast<std::size_t>(outcome);
  return number < kNames.size() ? kNames[number] : "?";
}

}  // namespace tandem::netsim
