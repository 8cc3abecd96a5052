#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

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

/// Cookies of the browsers that redeemed a token. Bounded: the oldest cookie ends when one more is added.
class BrowserCookies {
 public:
  static constexpr std::size_t kMax = 64;
  void add(std::string secret);
  [[nodiscard]] bool contains(std::string_view secret) const noexcept;

 private:
  std::vector<std::string> secrets_;
};

}  // namespace tandem::console
