#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/base/time.h"
#include "common/trust/limiter.h"
#include "common/trust/pin.h"

namespace tandem::trust {

/// Counts wrong codes: of a session, and of an enrolment. Ten within two minutes block their source, and the enrolled key that showed them,
/// from further codes for five minutes. Right codes cost nothing. Tickets and resume secrets are not counted and not blocked: they have at
/// least 256 bits nobody can guess.
///
/// A block lasts until its time is over, however many others fail meanwhile: at most `kSources` sources are remembered, and a source that
/// is blocked is never forgotten for another. When all of them are blocked, the network with most of them (IPv4 /24, IPv6 /48) is blocked
/// as a whole and its sources give their places back. When no network holds two of them, the sources that are not remembered are counted
/// together, as one; enrolled keys are exempt from this last count, as each of them has its own.
class Attempts {
 public:
  static constexpr std::size_t kAttempts = 10;
  static constexpr Duration kWithin = std::chrono::seconds(120), kBlocked = std::chrono::seconds(300);
  static constexpr std::size_t kSources = 4096, kNetworks = 1024;

  /// @param loopback_exempt  whether sources on this computer are not counted, as they are every user's and program's of it; keys are
  explicit Attempts(bool loopback_exempt = true) noexcept : loopback_exempt_(loopback_exempt) {}

  /// @param key  of an enrolled workstation; nothing: of a stranger, whose keys cost nothing
  void wrong(const Source& source, const std::optional<Pin>& key, Time now);
  /// How long no code is taken; zero: one may be tried.
  [[nodiscard]] Duration blocked_for(const Source& source, const std::optional<Pin>& key, Time now) const;
  /// The same by what this key did, wherever it comes from.
  [[nodiscard]] Duration blocked_for(const Pin& key, Time now) const;
  [[nodiscard]] std::size_t remembered() const noexcept { return sources_.size() + networks_.size(); }

 private:
  /// The last wrong codes of one.
  struct Record {
    std::array<Time, kAttempts> at{};  ///< a ring
    std::size_t count = 0;
    Time last{}, blocked_until{};
    void wrong(Time now);
    [[nodiscard]] Time forgettable() const noexcept { return std::max(last, blocked_until); }
    [[nodiscard]] Duration blocked_for(Time now) const noexcept { return now < blocked_until ? blocked_until - now : Duration::zero(); }
  };
  using Sources = std::map<Source, Record>;
  /// The record of a source; end: there is no room.
  [[nodiscard]] Sources::iterator record_of(const Source& source, Time now);
  void forget(Sources::iterator source);
  /// Blocks the network that holds most of the blocked sources instead of each of them. @return whether that made room
  [[nodiscard]] bool block_a_network(Time now);
  [[nodiscard]] static Source network_of(const Source& source) noexcept;

  bool loopback_exempt_;
  Sources sources_;
  std::set<std::pair<Time, Source>> forgettable_;  ///< the same, by the end of a block or by the last wrong code
  std::map<Source, std::size_t> members_;          ///< how many of the same are of a network
  std::size_t shared_ = 0;                         ///< networks of more than one member
  std::map<Source, Time> networks_;                ///< blocked as a whole, until
  std::map<Pin, Record> keys_;       ///< of enrolled workstations: as many as the book has
  Record others_;                    ///< of all sources for which there is no room
};

}  // namespace tandem::trust
