#include "netsim/engine/path_decision.h"

#include <array>

#include "common/base/enumerator_count.h"

namespace tandem::netsim {

static_assert(kOutcomes == enumerator_count<Outcome>());

const char* name(Outcome outcome) noexcept {
  constexpr std::array kNames{"delivered",   "reordered",   "outage",     "hold full", "lost",
                              "queue full",  "overflow",    "too long",   "corrupted", "above MTU",
                              "old address", "client gone", "pushed out", "replaced",  "waiting"};
  static_assert(kNames.size() == kOutcomes);
  const auto number = static_cast<std::size_t>(outcome);
  return number < kNames.size() ? kNames[number] : "?";
}

}  // namespace tandem::netsim
