#pragma once

#include <string>

#include "common/base/format.h"

namespace tandem::server {

/// Load of a tick thread.
struct Load {
  double tick = 0;  ///< processor time per tick, p99 of the last 1000 ticks: share of the tick period [1]
  /// Processor time of the whole thread, sending and receiving included, over the last second: share of one processor
  /// [1]. Includes what the newest clients are expected to take (newcomer_load.h).
  double core = 0;
  bool fully_shed = false;  ///< highest shed level reached (load_shedder.h): overloaded although everything is shed
};

/// Load above which new joins are rejected.
struct LoadLimits {
  /// Of the time of a tick thread, the share that it may work: on average over a second, and in 99 of 100 ticks [1].
  /// 195 clients of a core at 1 kHz take 0.80, 225 take 0.90, with a p99 of their loops below 1 ms beyond the network
  /// (server/README.md, "Clients per core").
  double busy = 0.85;
};

/// Reason for rejecting a new join to a session of this thread, for display; empty: the join is accepted. There is one
/// limit, for the mean, for long ticks and for the machine, so that hands that run never wait for a newcomer.
/// @param all_cores   load of all tick threads together [1]: several of them may share a processor
/// @param processors  number of processors for them
[[nodiscard]] inline std::string rejection_reason(const Load& own, double all_cores, unsigned processors,
                                                  const LoadLimits& limits) {
  const auto above = [&](const std::string& what) {
    return "this server rejects new joins: " + what +
           format(
               ", and new joins are accepted up to %.0f %%; try again when participants have left, or on another "
               "server",
               100 * limits.busy);
  };
  if (own.core > limits.busy)
    return above(format("the session's thread works for %.0f %% of the time", 100 * own.core));
  if (own.tick > limits.busy)
    return above(format("long ticks of the session's thread take %.0f %% of their time (p99)", 100 * own.tick));
  if (own.fully_shed) return above("ticks of the session's thread were full, although all optional load is shed");
  if (processors > 0 && all_cores > limits.busy * processors)
    return above(format("all sessions together keep the %u processors busy for %.0f %% of the time", processors,
                        100 * all_cores / processors));
  return {};
}

}  // namespace tandem::server
