#pragma once

#include <string>

#include "common/base/format.h"

namespace tandem::server {

/// How busy a thread that ticks is.
struct Load {
  double tick = 0;  ///< processor time of a tick's law, p99 of the last 1000 ticks: share of the tick [1]
  double core = 0;  ///< processor time of the whole thread, receiving and sending too, over the last second: share of one processor [1]
  bool relieved = false;  ///< on the last rung (load_ladder.h): full in spite of all that it goes without
};

/// Above these nobody new gets a seat [design notes, reliability 2.4].
struct LoadLimits {
  double tick = 0.6;
  double core = 0.8;
};

/// Why nobody new gets a seat in a session of this thread: for a person; empty: there is room.
/// @param all_cores   of all threads that tick together [1]: several of them may have to share a processor
/// @param processors  there are for them
[[nodiscard]] inline std::string no_room(const Load& own, double all_cores, unsigned processors, const LoadLimits& limits) {
  constexpr const char* kRemedy = "; try again when others have left, or on another server";
  const std::string begin = "this server has no room for more: ";
  if (own.tick > limits.tick)
    return begin + format("its ticks take %.0f %% of their time (p99), and newcomers are let in below %.0f %%", 100 * own.tick, 100 * limits.tick) + kRemedy;
  if (own.relieved) return begin + "its ticks are full although it goes without all that it can" + kRemedy;
  if (own.core > limits.core)
    return begin + format("the session's thread takes %.0f %% of a processor, and newcomers are let in below %.0f %%", 100 * own.core, 100 * limits.core) + kRemedy;
  if (processors > 0 && all_cores > limits.core * processors)
    return begin + format("its sessions take %.0f %% of its %u processors, and newcomers are let in below %.0f %%", 100 * all_cores / processors, processors,
                          100 * limits.core) + kRemedy;
  return {};
}

}  // namespace tandem::server
