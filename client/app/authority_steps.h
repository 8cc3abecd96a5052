#pragma once

#include <cstdint>
#include <optional>

#include "client/app/client_status.h"

namespace tandem::client {

/// Base of the user's next authority step. Authority changes slowly, so steps add to the authority requested last, not
/// to the present one. This is valid only while no other party has decided about authority: each decision, including
/// the own ones, increments the authority version by one.
class AuthoritySteps {
 public:
  /// Returns the own authority that the next step adds to, 0 ... 1.
  [[nodiscard]] double base(const ClientStatus& now) const noexcept { return counts(now) ? asked_ : now.alpha; }
  /// True if `base` is the authority requested last.
  [[nodiscard]] bool counts(const ClientStatus& now) const noexcept {
    return first_version_ && now.transfer.notice != wire::TransferNotice::kCancelled &&
           now.authority_version - *first_version_ <= asks_;
  }
  /// Records that `own` is requested now.
  void ask(double own, const ClientStatus& now) noexcept {
    if (!counts(now)) {
      first_version_ = now.authority_version;
      asks_ = 0;
    }
    asked_ = own;
    ++asks_;
  }

 private:
  double asked_ = 0;
  std::optional<std::uint32_t> first_version_;  ///< authority version before the first valid step
  std::uint32_t asks_ = 0;
};

}  // namespace tandem::client
