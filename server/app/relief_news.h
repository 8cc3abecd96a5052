#pragma once

#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "common/base/format.h"
#include "server/app/shard.h"

namespace tandem::server {

/// Notices when threads of ticks go without more, or less, than before: for logs.
class ReliefNews {
 public:
  struct Note {
    bool more = false;  ///< than before
    std::string text;   ///< for people
  };
  [[nodiscard]] std::vector<Note> look(const std::vector<std::unique_ptr<Shard>>& shards) {
    std::vector<Note> news;
    told_.resize(shards.size(), Rung::kNothing);
    for (std::size_t i = 0; i < shards.size(); ++i) {
      const Rung now = shards[i]->relief().rung, before = std::exchange(told_[i], now);
      if (now == before) continue;
      const auto hz = static_cast<long>(1.0 / seconds(shards[i]->period()) + 0.5);
      std::string what = now == Rung::kNothing ? "does everything again" : "goes without: ";
      for (auto rung = Rung::kTelemetry; rung <= now; rung = static_cast<Rung>(static_cast<int>(rung) + 1)) what += std::string(rung == Rung::kTelemetry ? "" : ", ") + to_text(rung);
      news.push_back({now > before, format("the thread of %ld Hz %s %s (level %d)", hz, now > before ? "has too much to do or is late, and" : "has time again, and", what.c_str(), static_cast<int>(now))});
    }
    return news;
  }

 private:
  std::vector<Rung> told_;  ///< by shard
};

}  // namespace tandem::server
