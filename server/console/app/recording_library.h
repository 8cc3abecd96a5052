#pragma once

#include <condition_variable>
#include <cstdint>
#include <deque>
#include <functional>
#include <list>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "server/console/app/open_recording.h"
#include "server/console/app/recording_catalogue.h"
#include "server/console/app/recording_scores.h"
#include "server/console/recording_request.h"

namespace tandem::console {

/// Reply to a request about recordings: status of HTTP, and JSON compressed by gzip.
struct RecordingReply {
  unsigned status = 200;
  std::shared_ptr<const std::string> gzip;
};

/// Reads recordings for pages in a thread of its own with the lowest priority, so that no live picture waits. Bounded:
/// requests, open recordings and remembered pieces; the one that was used least recently ends first.
class RecordingLibrary {
 public:
  static constexpr std::size_t kWaitingMax = 64;            ///< requests
  static constexpr std::size_t kOpenMax = 6;                ///< recordings whose outline is kept
  static constexpr std::size_t kPieceBytesMax = 32u << 20;  ///< compressed pieces that are kept

  /// @param folder  of recordings; empty: only `files`
  RecordingLibrary(std::string folder, std::vector<std::string> files);
  ~RecordingLibrary();
  RecordingLibrary(const RecordingLibrary&) = delete;
  RecordingLibrary& operator=(const RecordingLibrary&) = delete;

  /// Called once by the library's thread, unless the library ends before.
  using Done = std::function<void(RecordingReply)>;
  /// @return false: kWaitingMax requests wait already, and `done` is not called
  [[nodiscard]] bool ask(RecordingRequest request, Done done);

 private:
  struct Open {
    std::string id;
    RecordingCatalogue::Found found;
    std::optional<OpenRecording> recording;  ///< empty: it cannot be read
    std::string problem;
    std::shared_ptr<const std::string> outline;  ///< compressed; null: not read yet
  };
  struct Piece {
    std::string id;
    std::uint32_t number = 0;
    std::shared_ptr<const std::string> gzip;
  };

  void work(const std::stop_token& stop);
  [[nodiscard]] bool wait(const std::stop_token& stop, std::optional<std::pair<RecordingRequest, Done>>& next);
  [[nodiscard]] RecordingReply reply_to(const RecordingRequest& request);
  [[nodiscard]] RecordingReply outline_of(Open& open);
  [[nodiscard]] RecordingReply piece_of(Open& open, std::uint32_t number);
  [[nodiscard]] RecordingReply scores_of(Open& open);
  /// Returns an open recording, the first of `open_` afterwards; null: unknown id.
  [[nodiscard]] Open* open(const std::string& id);
  [[nodiscard]] Open* in_preparation();
  void prepare(Open& open);
  void forget(const std::string& id);

  std::mutex lock_;
  std::condition_variable_any wake_;
  std::deque<std::pair<RecordingRequest, Done>> waiting_;
  // Of the thread:
  RecordingCatalogue catalogue_;
  std::list<Open> open_;     ///< the one used last first
  std::list<Piece> pieces_;  ///< likewise
  std::size_t piece_bytes_ = 0;
  RecordingScores scores_;
  std::jthread thread_;
};

}  // namespace tandem::console
