#pragma once

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/base/format.h"
#include "server/app/process/shard.h"

namespace tandem::server {

/// Detects changes of the shards' shed levels, for logs.
class LoadEvents {
 public:
  struct Event {
    bool more = false;  ///< the level rose
    std::string text;   ///< message for users
  };
  [[nodiscard]] std::vector<Event> update(const std::vector<std::unique_ptr<Shard>>& shards) {
    std::vector<Event> news;
    reported_.resize(shards.size(), ShedLevel::kNone);
    for (std::size_t i = 0; i < shards.size(); ++i) {
      const ShedLevel now = shards[i]->load().state().level, before = std::exchange(reported_[i], now);
      if (now == before) continue;
      std::string what = now == ShedLevel::kNone ? "sheds no load" : "sheds: ";
      for (auto level = ShedLevel::kTelemetry; level <= now;
           level = static_cast<ShedLevel>(static_cast<int>(level) + 1))
        what += std::string(level == ShedLevel::kTelemetry ? "" : ", ") + to_text(level);
      news.push_back({now > before, format("%s %s %s (level %d)", name_of(shards, i).c_str(),
                                           now > before ? "is overloaded or late, and" : "has capacity again, and",
                                           what.c_str(), static_cast<int>(now))});
    }
    return news;
  }

 private:
  /// The only thread of a tick rate is known by the rate.
  [[nodiscard]] static std::string name_of(const std::vector<std::unique_ptr<Shard>>& shards, std::size_t i) {
    const auto hz = static_cast<long>(1.0 / seconds(shards[i]->period()) + 0.5);
    const auto same = std::ranges::count_if(shards, [&](const auto& s) { return s->period() == shards[i]->period(); });
    return same == 1 ? format("the %ld Hz thread", hz) : format("thread %zu (%ld Hz)", i, hz);
  }

  std::vector<ShedLevel> reported_;  ///< per shard
};

}  // namespace tandem::server
