#pragma once

#include <condition_variable>
#include <cstdint>
#include <list>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "server/console/recording_outline.h"

namespace tandem::console {

/// Scores of opened recordings, the same as `tandem-netsim score`. A thread reads one recording at a time as a whole;
/// larger ones than kBytesMax are refused, so that memory is bounded.
class RecordingScores {
 public:
  static constexpr std::uint64_t kBytesMax = 768u << 20;  ///< of a lesson in memory, some 11 minutes of two seats
  static constexpr std::size_t kKept = 16;                ///< results

  RecordingScores();

  struct Answer {
    bool pending = false;
    std::string members{};  ///< as score_members
    std::string problem{};  ///< why there are none, and the remedy; empty: there are
  };
  /// Returns the scores, or begins to compute them.
  [[nodiscard]] Answer of(const std::string& id, const std::vector<std::string>& paths,
                          const RecordingOutline& outline);
  /// Forgets the scores of a recording that has changed.
  void forget(const std::string& id);

 private:
  struct Row {
    std::string id;
    std::vector<std::string> paths;  ///< of its files, in their order
    LessonSeatSet without;           ///< seats that no participant had: their columns are not read
    bool taken = false;              ///< the thread computes it
    std::optional<Answer> answer;    ///< empty: not computed yet
  };
  void work(const std::stop_token& stop);

  std::mutex lock_;
  std::condition_variable_any wake_;
  std::list<Row> rows_;  ///< the newest first
  std::jthread thread_;
};

}  // namespace tandem::console
