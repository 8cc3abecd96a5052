#include "common/auth/attempt_limiter.h"

#include <algorithm>

namespace tandem::auth {

void AttemptLimiter::Record::wrong(Time now) {
  at[count % kAttempts] = now;
  ++count;
  last = now;
  // The entry that the next failure will overwrite is the oldest of the last ten.
  if (count < kAttempts || now - at[count % kAttempts] > kWithin) return;
  blocked_until = now + kBlocked;
  count = 0;
}

Source AttemptLimiter::network_of(const Source& source) noexcept {
  Source network = source;
  network.prefix &= source.v6 ? ~std::uint64_t{0xffff} : ~std::uint64_t{0xff};
  return network;
}

void AttemptLimiter::record_failure(const Source& source, const std::optional<KeyFingerprint>& key, Time now) {
  if (key) keys_[*key].wrong(now);
  if (source.loopback && loopback_exempt_) return;
  const auto found = record_of(source, now);
  if (found == sources_.end()) {
    if (!key) others_.wrong(now);
    return;
  }
  evictable_.erase({found->second.forgettable(), source});
  found->second.wrong(now);
  evictable_.emplace(found->second.forgettable(), source);
}

AttemptLimiter::Sources::iterator AttemptLimiter::record_of(const Source& source, Time now) {
  if (const auto found = sources_.find(source); found != sources_.end()) return found;
  if (sources_.size() >= kSources) {
    const auto& [when, oldest] = *evictable_.begin();
    if (when <= now) {
      forget(sources_.find(oldest));
    } else if (!block_network(now)) {
      return sources_.end();
    }
  }
  if (++members_[network_of(source)] == 2) ++shared_;
  const auto made = sources_.try_emplace(source).first;
  evictable_.emplace(made->second.forgettable(), source);
  return made;
}

void AttemptLimiter::forget(Sources::iterator source) {
  const auto network = members_.find(network_of(source->first));
  if (--network->second == 1) --shared_;
  if (network->second == 0) members_.erase(network);
  evictable_.erase({source->second.forgettable(), source->first});
  sources_.erase(source);
}

bool AttemptLimiter::block_network(Time now) {
  if (shared_ == 0) return false;
  std::erase_if(networks_, [&](const auto& entry) { return entry.second <= now; });
  const Source network = std::ranges::max_element(members_, {}, [](const auto& entry) { return entry.second; })->first;
  if (networks_.size() >= kNetworks && !networks_.contains(network)) return false;
  Time& until = networks_[network];
  const std::uint64_t last = network.prefix | (network.v6 ? 0xffff : 0xff);
  for (auto i = sources_.lower_bound(Source{network.prefix}); i != sources_.end() && i->first.prefix <= last;) {
    const auto member = i++;
    if (network_of(member->first) != network) continue;  // of the other address family
    until = std::max(until, member->second.blocked_until);
    forget(member);
  }
  return true;
}

Duration AttemptLimiter::blocked_for(const KeyFingerprint& key, Time now) const {
  const auto found = keys_.find(key);
  return found == keys_.end() ? Duration::zero() : found->second.blocked_for(now);
}

Duration AttemptLimiter::blocked_for(const Source& source, const std::optional<KeyFingerprint>& key, Time now) const {
  Duration longest = key ? blocked_for(*key, now) : Duration::zero();
  if (source.loopback && loopback_exempt_) return longest;
  if (const auto found = networks_.find(network_of(source)); found != networks_.end())
    longest = std::max(longest, found->second - now);
  if (const auto found = sources_.find(source); found != sources_.end())
    return std::max(longest, found->second.blocked_for(now));
  // A stored source has its own count, and so has an enrolled key.
  return key ? longest : std::max(longest, others_.blocked_for(now));
}

}  // namespace tandem::auth
