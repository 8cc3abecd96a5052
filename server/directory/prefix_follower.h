#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "server/directory/directory.h"

namespace tandem::directory {

/// Follows all keys with one prefix by one read and a watch. When the watch breaks or its revision was compacted, it
/// reads everything again; after a read that failed not before kAskAgain. The changes that it reports may be old.
///
/// A store that has lost its data begins again with low revisions, and a watch there waits in silence for revisions
/// that are to come. So an answer of a lower revision than a former one has everything read again.
class PrefixFollower {
 public:
  struct News {
    bool all = false;   ///< `changes` are all keys; others have gone
    bool back = false;  ///< with `all`: the store has a lower revision than before, so it has lost changes
    std::vector<Change> changes;
  };

  explicit PrefixFollower(std::string prefix) : prefix_(std::move(prefix)) {}

  /// Returns the request to begin now, if there is one.
  /// @param retry_after  time after which a request without an answer is made again
  [[nodiscard]] std::optional<Request> poll_request(Time now, OperationId operation, Duration retry_after);
  /// Takes a reply. Returns its changes, or nothing if it belongs to another object.
  [[nodiscard]] std::optional<News> on_reply(const Reply& reply);
  /// Has everything read again, because the copy may be of a store that is no more.
  void restart() noexcept { state_ = State::kStale; }

  /// The copy is complete and follows the store.
  [[nodiscard]] bool follows() const noexcept { return state_ == State::kFollowing; }
  /// Newest revision of which all changes were reported.
  [[nodiscard]] Revision revision() const noexcept { return next_ - 1; }
  /// Times at which everything was read.
  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }

 private:
  enum class State : std::uint8_t { kStale, kReading, kRead, kFollowing };
  static constexpr Duration kAskAgain = std::chrono::milliseconds(100);

  std::string prefix_;
  State state_ = State::kStale;
  OperationId operation_ = 0;
  Time began_{}, next_read_{};
  Revision next_ = 0;  ///< first revision that was not reported
  std::uint64_t readings_ = 0;
};

}  // namespace tandem::directory
