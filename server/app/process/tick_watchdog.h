#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace tandem::server {

/// Decides whether the system's watchdog may hear that all shards tick. A busy shard counts many more ticks than an
/// idle one, so each is compared with its own count only.
class TickWatchdog {
 public:
  /// @param punctual  one per shard, always in the same order: its punctual ticks so far; nullopt: it has ended
  /// @return whether each shard that has not ended had a punctual tick since the last time this was true
  [[nodiscard]] bool update(std::span<const std::optional<std::uint64_t>> punctual) {
    seen_.resize(punctual.size());
    for (std::size_t i = 0; i < punctual.size(); ++i)
      if (punctual[i] && *punctual[i] == seen_[i]) return false;
    for (std::size_t i = 0; i < punctual.size(); ++i) seen_[i] = punctual[i].value_or(seen_[i]);
    return true;
  }

 private:
  std::vector<std::uint64_t> seen_;
};

}  // namespace tandem::server
