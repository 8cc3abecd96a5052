#include "common/auth/audit_throttle.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tandem::auth {

bool AuditThrottle::admit(const std::string& source, Time now) {
  const auto [found, is_new] =
      sources_.try_emplace(source, Entry{TokenBucket{limits_.source_per_s, limits_.source_burst}, now});
  Entry& entry = found->second;
  entry.heard = now;
  const bool good =
      entry.bucket.take(now) && all_.take(now);  // a source beyond its own rate does not use the shared one
  if (!good) {
    if (unreported_ == 0) unreported_since_ = now;
    ++entry.left;
    ++unreported_;
    ++suppressed_;
  }
  if (is_new && sources_.size() > kSourcesMax) forget_oldest();
  return good;
}

std::optional<std::string> AuditThrottle::summary(Time now) {
  return unreported_ > 0 && now - unreported_since_ >= kSummaryInterval ? last_summary() : std::nullopt;
}

std::optional<std::string> AuditThrottle::last_summary() {
  if (unreported_ == 0) return std::nullopt;
  std::vector<std::pair<std::uint64_t, std::string>> most;
  for (auto& [source, entry] : sources_)
    if (const std::uint64_t left = std::exchange(entry.left, 0); left > 0) most.emplace_back(left, source);
  const std::size_t named = std::min(kNamedMax, most.size());
  std::ranges::partial_sort(most, most.begin() + static_cast<std::ptrdiff_t>(named), std::greater<>{});
  std::string text = std::to_string(unreported_) +
                     (unreported_ == 1 ? " line about a refused peer was" : " lines about refused peers were") +
                     " left out:";
  std::uint64_t listed = 0;
  for (std::size_t i = 0; i < named; ++i) {
    text += (i == 0 ? " " : ", ") + std::to_string(most[i].first) + " of " + most[i].second;
    listed += most[i].first;
  }
  if (listed < unreported_) text += (listed > 0 ? ", " : " ") + std::to_string(unreported_ - listed) + " of others";
  unreported_ = 0;
  return text;
}

void AuditThrottle::forget_oldest() {
  const auto oldest = std::ranges::min_element(sources_, {}, [](const auto& row) { return row.second.heard; });
  sources_.erase(oldest);
}

}  // namespace tandem::auth
