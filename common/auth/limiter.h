#pragma once

#include <algorithm>
#include <compare>
#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <utility>

#include "common/auth/origin.h"
#include "common/base/time.h"
#include "common/base/token_bucket.h"

/// Rate limits, as functions of the time passed in.
namespace tandem::auth {

/// Origin of a connection for rate limits: an IPv4 address, or the first 64 bits of an IPv6 address, because a site
/// controls that many. An IPv4 address inside IPv6 (::ffff:a.b.c.d) is the IPv4 one.
struct Source {
  std::uint64_t prefix = 0;
  bool v6 = false;
  bool loopback = false;

  /// Source of a connection. ::1 counts as alone in its 64-bit prefix.
  [[nodiscard]] static constexpr Source of(const Origin& origin) noexcept {
    const std::uint64_t network = origin.network.prefix;
    if (origin.network.v6) return {network, true, network == 0 && origin.host == 1};
    return {network << 8 | origin.host, false, network >> 16 == 127};
  }
  friend auto operator<=>(const Source&, const Source&) = default;
};

/// Table with one `Entry` per source, at most `kMax`. A new source beyond that replaces the one unused for longest.
/// Memory stays bounded, and active sources stay stored.
template <class Entry>
class SourceTable {
 public:
  static constexpr std::size_t kMax = 4096;

  [[nodiscard]] Entry& at(const Source& source, Time now, const Entry& fresh) {
    const auto [found, is_new] = entries_.try_emplace(source, Slot{fresh, now});
    if (!is_new) by_time_.erase({found->second.heard, source});
    found->second.heard = now;
    if (entries_.size() > kMax) {
      entries_.erase(by_time_.begin()->second);
      by_time_.erase(by_time_.begin());
    }
    by_time_.emplace(now, source);
    return found->second.entry;
  }
  [[nodiscard]] const Entry* find(const Source& source) const {
    const auto found = entries_.find(source);
    return found == entries_.end() ? nullptr : &found->second.entry;
  }
  [[nodiscard]] std::size_t size() const noexcept { return entries_.size(); }

 private:
  struct Slot {
    Entry entry;
    Time heard;
  };
  std::map<Source, Slot> entries_;
  std::set<std::pair<Time, Source>> by_time_;  ///< of `entries_`
};

/// Limits of connections per source, and of TLS handshakes of all sources (PendingSlots).
struct AcceptLimits {
  double source_rate = 10, source_burst = 100;  ///< [1/s], [1]: a lab behind one address may join at once
  double all_rate = 300, all_burst = 300;       ///< handshakes
};
class AcceptLimiter {
 public:
  explicit AcceptLimiter(const AcceptLimits& limits = {}) noexcept : limits_(limits) {}
  /// Counts an arriving connection. @return false: its source exceeds its rate
  [[nodiscard]] bool accept(const Source& source, Time now) {
    return sources_.at(source, now, TokenBucket{limits_.source_rate, limits_.source_burst}).take(now);
  }

 private:
  AcceptLimits limits_;
  SourceTable<TokenBucket> sources_;
};

}  // namespace tandem::auth
