#pragma once

#include <cstdint>
#include <optional>

#include "client/app/client_status.h"

namespace tandem::client {

/// The own weight that the next step of a person counts from. Weights move slowly, so steps add to what was asked for last, and not to what is felt
/// now. That holds as long as nobody else decided anything since: each decision, the own ones as well, raises the version of the weights by one.
class AuthoritySteps {
 public:
  /// @return own weight, 0 ... 1
  [[nodiscard]] double base(const ClientStatus& now) const noexcept { return counts(now) ? asked_ : now.alpha; }
  /// Whether `base` is what was asked for last.
  [[nodiscard]] bool counts(const ClientStatus& now) const noexcept {
    return first_version_ && now.handover != wire::Handover::kCalledOff && now.authority_version - *first_version_ <= asks_;
  }
  /// `own` is asked for now.
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
  std::optional<std::uint32_t> first_version_;  ///< before the first of the steps that count
  std::uint32_t asks_ = 0;
};

}  // namespace tandem::client
