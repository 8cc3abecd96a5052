#pragma once

#include <string>

#include "common/base/format.h"

namespace tandem::server {

/// Load of a tick thread.
struct Load {
  /// Share of its time that the thread works: processor time of receiving, ticks and sending over the last second [1].
  /// Includes what the newest clients are expected to take (new_client_load.h).
  double busy = 0;
  bool fully_shed = false;  ///< ShedLevel::kNewJoins (load_shedder.h): the same share, over a tenth of a second
};

/// Load above which new joins are rejected.
struct LoadLimits {
  /// Share of its time that a tick thread may work [1]. 195 clients of a core at 1 kHz take 0.80, 225 take 0.90, with a
  /// p99 of their loops below 1 ms beyond the network (server/README.md, "Clients per core").
  double busy = 0.85;
};

/// Reason for rejecting a new join to a session of this thread, for display; empty: the join is accepted. There is one
/// limit, for the thread and for the machine. It leaves time for moments of more work, so that hands that run never
/// wait for a new client.
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
  if (own.busy > limits.busy)
    return above(format("the session's thread works for %.0f %% of the time", 100 * own.busy));
  if (own.fully_shed)
    return above(format("the session's thread has worked for more than %.0f %% of the time in the last seconds",
                        100 * LoadLimits{}.busy));
  if (processors > 0 && all_cores > limits.busy * processors)
    return above(format("all sessions together keep the %u processors busy for %.0f %% of the time", processors,
                        100 * all_cores / processors));
  return {};
}

}  // namespace tandem::server
