#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <map>
#include <optional>
#include <set>
#include <utility>

#include "common/auth/key_fingerprint.h"
#include "common/auth/limiter.h"
#include "common/base/time.h"

namespace tandem::auth {

/// Limits wrong session codes and enrolment codes. Ten wrong codes within two minutes block further codes for five
/// minutes. The block applies to their source and to the enrolled key that sent them. Right codes are not counted.
/// Tickets and resume secrets are neither counted nor blocked: they have at least 256 bits and cannot be guessed.
///
/// A block lasts for its full time, regardless of failures from other sources. At most `kSources` sources are stored,
/// and a blocked source is never dropped for another. If all stored sources are blocked, the network with most of them
/// (IPv4 /24, IPv6 /48) is blocked as a whole, and its sources are freed. If no network has two of them, all sources
/// that are not stored share one count. Enrolled keys are exempt from this shared count, because each key has its own.
class AttemptLimiter {
 public:
  static constexpr std::size_t kAttempts = 10;
  static constexpr Duration kWithin = std::chrono::seconds(120), kBlocked = std::chrono::seconds(300);
  static constexpr std::size_t kSources = 4096, kNetworks = 1024;

  /// @param loopback_exempt  if true, loopback sources are not counted, because all users and programs of this computer
  /// share them; keys are counted anyway
  explicit AttemptLimiter(bool loopback_exempt = true) noexcept : loopback_exempt_(loopback_exempt) {}

  /// Counts a wrong code.
  /// @param key  of an enrolled workstation; nullopt for unknown senders, because they can create keys at no cost
  void record_failure(const Source& source, const std::optional<KeyFingerprint>& key, Time now);
  /// Returns the remaining time of a block; zero: a code may be tried.
  [[nodiscard]] Duration blocked_for(const Source& source, const std::optional<KeyFingerprint>& key, Time now) const;
  /// Returns the remaining block of this key, for any source.
  [[nodiscard]] Duration blocked_for(const KeyFingerprint& key, Time now) const;
  [[nodiscard]] std::size_t tracked() const noexcept { return sources_.size() + networks_.size(); }

 private:
  /// The last wrong codes of one source or key.
  struct Record {
    std::array<Time, kAttempts> at{};  ///< ring buffer
    std::size_t count = 0;
    Time last{}, blocked_until{};
    void wrong(Time now);
    [[nodiscard]] Time forgettable() const noexcept { return std::max(last, blocked_until); }
    [[nodiscard]] Duration blocked_for(Time now) const noexcept {
      return now < blocked_until ? blocked_until - now : Duration::zero();
    }
  };
  using Sources = std::map<Source, Record>;
  /// Returns the record of a source, created if needed; end() if the table is full.
  [[nodiscard]] Sources::iterator record_of(const Source& source, Time now);
  void forget(Sources::iterator source);
  /// Blocks the network with most of the blocked sources in place of each of them. @return whether that freed entries
  [[nodiscard]] bool block_network(Time now);
  [[nodiscard]] static Source network_of(const Source& source) noexcept;

  bool loopback_exempt_;
  Sources sources_;
  std::set<std::pair<Time, Source>> evictable_;  ///< of `sources_`, by the end of a block or the last wrong code
  std::map<Source, std::size_t> members_;        ///< number of `sources_` entries of each network
  std::size_t shared_ = 0;                       ///< number of networks with more than one member
  std::map<Source, Time> networks_;              ///< networks blocked as a whole, with the end of the block
  std::map<KeyFingerprint, Record> keys_;        ///< of enrolled workstations: as many as the registry contains
  Record others_;                                ///< shared by all sources that are not stored
};

}  // namespace tandem::auth
