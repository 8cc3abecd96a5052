#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "server/endpoint.h"
#include "server/path_tokens.h"

namespace tandem::server {

/// Whether a client really is where his newest datagram came from. A datagram proves who wrote it, not who sent it on: until the
/// address has answered a challenge, nothing but the challenge goes there. Two addresses are asked at a time, so that whoever sends
/// copies from elsewhere does not keep the client from being asked; and the answer may take as long as the network does.
///
/// The server sends no more bytes to such an address than came from it: each datagram that acted, which is larger than a challenge,
/// allows one challenge. Each address is asked with a token of its own, so that only a reader of that address can answer.
class PathProof {
 public:
  static constexpr Duration kBetween = std::chrono::milliseconds(50);
  static constexpr unsigned kTries = 5;  ///< in a row; again when the client is still heard from there afterwards

  /// A newer authentic datagram, larger than a challenge, came from an address that is not the proven one.
  /// @param tokens  one is taken if a new address is to be asked; none there: it is asked when its next datagram comes
  void seen(Time now, const Endpoint& from, PathTokens& tokens) noexcept {
    const auto known = std::ranges::find_if(asked_, [&](const Asked& a) { return a.active && a.at == from; });
    if (known != asked_.end()) {
      known->allowed = std::min(known->allowed + 1, kTries);
      if (now < known->begun + kTries * kBetween) return;
      known->begun = known->next = now;  // the same token: an answer may still be under way
      known->tries = 0;
      return;
    }
    Asked& place = *std::ranges::min_element(asked_, {}, [](const Asked& a) { return a.active ? a.begun : Time::min(); });
    if (place.active && now < place.begun + kBetween) return;
    if (const auto token = tokens.take()) place = {from, *token, now, now, 0, 1, true};
  }
  /// @return whether this proves the address the answer came from
  [[nodiscard]] bool answered(const Endpoint& from, std::uint64_t token) noexcept {
    if (std::ranges::none_of(asked_, [&](const Asked& a) { return a.active && a.at == from && a.token == token; })) return false;
    for (Asked& a : asked_) a.active = false;
    return true;
  }
  struct Challenge {
    Endpoint to;
    std::uint64_t token = 0;
  };
  /// Somebody is being asked. While nobody is, nothing is due.
  [[nodiscard]] bool asking() const noexcept { return asked_[0].active || asked_[1].active; }
  /// The next try, when one is due.
  [[nodiscard]] std::optional<Challenge> due(Time now) noexcept {
    for (Asked& a : asked_) {
      if (!a.active || a.tries >= kTries || a.allowed == 0 || now < a.next) continue;
      ++a.tries;
      --a.allowed;
      a.next = now + kBetween;
      return Challenge{a.at, a.token};
    }
    return std::nullopt;
  }

 private:
  struct Asked {
    Endpoint at;
    std::uint64_t token = 0;
    Time begun{}, next{};
    unsigned tries = 0;
    unsigned allowed = 0;  ///< challenges that the datagrams from there still pay for
    bool active = false;
  };
  std::array<Asked, 2> asked_{};
};

}  // namespace tandem::server
