#pragma once

#include <string>

#include "common/base/format.h"

namespace tandem::server {

/// Load of a tick thread.
struct Load {
  double tick = 0;  ///< processor time per tick, p99 of the last 1000 ticks: share of the tick period [1]
  /// Processor time of the whole thread, sending and receiving included, over the last second: share of one processor
  /// [1].
  double core = 0;
  bool fully_shed = false;  ///< highest shed level reached (load_shedder.h): overloaded although everything is shed
};

/// Loads above which new joins are rejected.
struct LoadLimits {
  double tick = 0.6;
  double core = 0.8;
};

/// Reason for rejecting a new join to a session of this thread, for display; empty: the join is accepted.
/// @param all_cores   load of all tick threads together [1]: several of them may share a processor
/// @param processors  number of processors for them
[[nodiscard]] inline std::string rejection_reason(const Load& own, double all_cores, unsigned processors,
                                                  const LoadLimits& limits) {
  constexpr const char* kRemedy = "; try again when participants have left, or on another server";
  const std::string begin = "this server rejects new joins: ";
  if (own.tick > limits.tick)
    return begin +
           format("its ticks take %.0f %% of their time (p99), and new joins are accepted below %.0f %%",
                  100 * own.tick, 100 * limits.tick) +
           kRemedy;
  if (own.fully_shed) return begin + "its ticks are full although all optional load is shed" + kRemedy;
  if (own.core > limits.core)
    return begin +
           format("the session's thread takes %.0f %% of a processor, and new joins are accepted below %.0f %%",
                  100 * own.core, 100 * limits.core) +
           kRemedy;
  if (processors > 0 && all_cores > limits.core * processors)
    return begin +
           format("its sessions take %.0f %% of its %u processors, and new joins are accepted below %.0f %%",
                  100 * all_cores / processors, processors, 100 * limits.core) +
           kRemedy;
  return {};
}

}  // namespace tandem::server
