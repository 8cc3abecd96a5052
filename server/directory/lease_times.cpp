#include "server/directory/lease_times.h"

#include "common/base/format.h"

namespace tandem::directory {

std::optional<std::string> LeaseTimes::problem() const {
  constexpr Duration kTtlMin = std::chrono::seconds(2), kTtlMax = std::chrono::seconds(60);
  if (ttl < kTtlMin || ttl > kTtlMax || ttl % std::chrono::seconds(1) != Duration{})
    return format("ttl: %g s is not a whole number of seconds from 2 to 60", seconds(ttl));
  if (!(drift >= 0 && drift <= 0.1)) return format("drift: %g is not in [0, 0.1]", drift);
  if (ramp <= Duration{} || ramp > ttl)
    return format("ramp: %g s is not in (0, %g] s, the ttl", seconds(ramp), seconds(ttl));
  if (renew_every <= Duration{} || 3 * renew_every > hold_after)
    return format("renew_every: %g s is not in (0, %g] s, a third of hold_after", seconds(renew_every),
                  seconds(hold_after) / 3);
  if (answer_limit <= Duration{} || answer_limit > ttl)
    return format("answer_limit: %g s is not in (0, %g] s, the ttl", seconds(answer_limit), seconds(ttl));
  const double most = seconds(ttl) * (1 - drift) / (1 + drift) - seconds(ramp);
  if (seconds(hold_after) > most)
    return format("hold_after: %g s is more than %g s; another server could begin while this one ramps out",
                  seconds(hold_after), most);
  return std::nullopt;
}

}  // namespace tandem::directory
