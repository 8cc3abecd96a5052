#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "common/base/time.h"
#include "server/session/path_tokens.h"
#include "server/session/peer_address.h"

namespace tandem::server {

/// Address validation of one client, as the path validation of QUIC (RFC 9000 §8.2). A datagram proves its author, not
/// the host that sent it. Until an address has answered a challenge, the server sends only challenges there. Two
/// addresses are challenged at a time, so that copies sent from other hosts do not block the validation of the client.
/// An answer may take as long as the network needs.
///
/// The server sends no more bytes to such an address than it received from there. Each accepted datagram is larger
/// than a challenge and allows one challenge. Each address gets its own token, so that only a host that receives there
/// can answer.
class PathValidation {
 public:
  static constexpr Duration kBetween = std::chrono::milliseconds(50);
  static constexpr unsigned kTries = 5;  ///< in a row; repeated if datagrams still arrive from there afterwards

  /// A newer authentic datagram, larger than a challenge, came from an address that is not the validated one.
  /// @param tokens  source of a token for a new address; if it is empty, the next datagram tries again
  void on_datagram_from(Time now, const PeerAddress& from, PathTokens& tokens) noexcept {
    const auto known =
        std::ranges::find_if(candidates_, [&](const Candidate& a) { return a.active && a.address == from; });
    if (known != candidates_.end()) {
      known->credit = std::min(known->credit + 1, kTries);
      if (now < known->started + kTries * kBetween) return;
      known->started = known->next = now;  // the same token, because an answer may still be under way
      known->tries = 0;
      return;
    }
    Candidate& place = *std::ranges::min_element(candidates_, {},
                                                 [](const Candidate& a) { return a.active ? a.started : Time::min(); });
    if (place.active && now < place.started + kBetween) return;
    if (const auto token = tokens.take()) place = {from, *token, now, now, 0, 1, true};
  }
  /// @return true if this answer validates the address it came from
  [[nodiscard]] bool on_response(const PeerAddress& from, std::uint64_t token) noexcept {
    if (std::ranges::none_of(candidates_,
                             [&](const Candidate& a) { return a.active && a.address == from && a.token == token; }))
      return false;
    for (Candidate& a : candidates_) a.active = false;
    return true;
  }
  struct Challenge {
    PeerAddress to;
    std::uint64_t token = 0;
  };
  /// An address is being validated. If none is, no challenge is due.
  [[nodiscard]] bool in_progress() const noexcept { return candidates_[0].active || candidates_[1].active; }
  /// Next challenge; nullopt when none is due.
  [[nodiscard]] std::optional<Challenge> challenge_due(Time now) noexcept {
    for (Candidate& a : candidates_) {
      if (!a.active || a.tries >= kTries || a.credit == 0 || now < a.next) continue;
      ++a.tries;
      --a.credit;
      a.next = now + kBetween;
      return Challenge{a.address, a.token};
    }
    return std::nullopt;
  }

 private:
  struct Candidate {
    PeerAddress address;
    std::uint64_t token = 0;
    Time started{}, next{};
    unsigned tries = 0;
    unsigned credit = 0;  ///< challenges that received datagrams still allow
    bool active = false;
  };
  std::array<Candidate, 2> candidates_{};
};

}  // namespace tandem::server
