#pragma once

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
      const auto hz = static_cast<long>(1.0 / seconds(shards[i]->period()) + 0.5);
      std::string what = now == ShedLevel::kNone ? "sheds no load" : "sheds: ";
      for (auto level = ShedLevel::kTelemetry; level <= now;
           level = static_cast<ShedLevel>(static_cast<int>(level) + 1))
        what += std::string(level == ShedLevel::kTelemetry ? "" : ", ") + to_text(level);
      news.push_back({now > before, format("the %ld Hz thread %s %s (level %d)", hz,
                                           now > before ? "is overloaded or late, and" : "has capacity again, and",
                                           what.c_str(), static_cast<int>(now))});
    }
    return news;
  }

 private:
  std::vector<ShedLevel> reported_;  ///< per shard
};

}  // namespace tandem::server
