#pragma once

#include <optional>
#include <string>

#include "common/base/time.h"

namespace tandem::directory {

/// Times of a server's lease. All are measured on the server's monotonic clock, which must also count the time of a
/// suspended machine (Linux: CLOCK_BOOTTIME).
///
/// The lease cannot end at the store before `ttl` has passed there since the server SENT a successful renewal. The
/// store receives a renewal after it was sent, so no delay of requests or replies shortens this. From `hold_after` on,
/// the server holds its sessions; `ramp` later no effort is left. Clocks of server and store may differ in rate by
/// `drift`:
///
///     (hold_after + ramp) (1 + drift) <= ttl (1 - drift)
struct LeaseTimes {
  Duration ttl = std::chrono::seconds(3);
  Duration hold_after = std::chrono::seconds(2);   ///< two thirds of `ttl`
  Duration ramp = std::chrono::milliseconds(200);  ///< until every effort of a held session is zero
  Duration renew_every = std::chrono::milliseconds(500);
  Duration answer_limit = std::chrono::seconds(1);  ///< a request without an answer is sent again after this time
  double drift = 0.05;                              ///< quartz clocks differ by less than 0.0005

  /// Returns what is wrong with these times, in words, or nothing.
  [[nodiscard]] std::optional<std::string> problem() const;
};

}  // namespace tandem::directory
