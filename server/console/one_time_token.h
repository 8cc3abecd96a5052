#pragma once

#include <string>
#include <string_view>

#include "common/base/time.h"

namespace tandem::console {

/// Compares two secrets in a time that depends on their lengths only.
[[nodiscard]] bool equal_secrets(std::string_view a, std::string_view b) noexcept;

/// Token of the printed URL: valid once and until `expires`.
class OneTimeToken {
 public:
  OneTimeToken(std::string secret, Time expires) : secret_(std::move(secret)), expires_(expires) {}
  /// Returns true for the first correct token before `expires`. A wrong token leaves the right one valid.
  [[nodiscard]] bool redeem(std::string_view given, Time now) noexcept;

 private:
  std::string secret_;  ///< empty: redeemed
  Time expires_;
};

}  // namespace tandem::console
