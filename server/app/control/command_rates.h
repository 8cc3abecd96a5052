#pragma once

#include "common/auth/limiter.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::server {

/// Rate limits of one connection's requests (rpc::RateLimits). Stops and pauses have a limit of their own, so that no
/// other request delays them; so have changes of authority, and notes, which are long.
class CommandRates {
 public:
  /// Counts a request. @return false: it exceeds its rate
  [[nodiscard]] bool take(rpc::Kind kind, Time now) noexcept {
    if (kind == rpc::Kind::kSetAuthority) return authority_.take(now);
    if (kind == rpc::Kind::kNote) return notes_.take(now);
    const bool stop = kind == rpc::Kind::kStopSession || kind == rpc::Kind::kPauseSession;
    return (stop ? stops_ : others_).take(now);
  }

 private:
  static constexpr rpc::RateLimits kLimits{};
  TokenBucket others_{kLimits.commands_per_s, kLimits.commands_burst}, stops_ = others_;
  TokenBucket authority_{kLimits.authority_per_s, kLimits.authority_burst};
  TokenBucket notes_{1, 10};  ///< [1/s], [1]
};

}  // namespace tandem::server
