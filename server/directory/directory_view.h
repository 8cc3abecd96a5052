#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "server/directory/directory.h"
#include "server/directory/directory_keys.h"

namespace tandem::directory {

/// Copy of everything below `live/`, kept by one read and a watch. When the watch breaks or its revision was compacted,
/// the view reads everything again. The copy may be old: it decides whom to ask, never who owns.
class DirectoryView {
 public:
  struct Named {
    std::string name;  ///< of the server
    Revision created = 0;
    LeaseId lease = 0;
  };
  struct SessionEntry {
    std::optional<Named> owner, standby;
  };
  struct ServerEntry {
    std::string text;
    LeaseId lease = 0;
  };

  explicit DirectoryView(DirectoryKeys keys) : keys_(std::move(keys)) {}

  /// Returns the request to begin now, if there is one.
  /// @param retry_after  time after which a request without an answer is made again
  [[nodiscard]] std::optional<Request> poll_request(Time now, OperationId operation, Duration retry_after);
  /// Takes a reply. Returns whether it belongs to the view.
  bool on_reply(const Reply& reply);
  /// Returns the next session whose entry changed since the last call.
  [[nodiscard]] std::optional<std::string> poll_changed();

  /// The view is complete and follows the store.
  [[nodiscard]] bool follows() const noexcept { return state_ == State::kFollowing; }
  [[nodiscard]] const std::map<std::string, SessionEntry, std::less<>>& sessions() const noexcept { return sessions_; }
  [[nodiscard]] const std::map<std::string, ServerEntry, std::less<>>& servers() const noexcept { return servers_; }
  [[nodiscard]] const SessionEntry* session(std::string_view name) const;
  [[nodiscard]] const ServerEntry* server(std::string_view name) const;
  /// Newest revision of which the view knows all changes.
  [[nodiscard]] Revision revision() const noexcept { return next_ - 1; }
  /// Times at which everything was read.
  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }
  /// Keys below `live/` that are no key of this directory; they are ignored.
  [[nodiscard]] std::uint64_t foreign_keys() const noexcept { return foreign_keys_; }

 private:
  enum class State : std::uint8_t { kStale, kReading, kRead, kFollowing };
  void apply(const Change& change);
  void replace(const std::vector<KeyValue>& entries);

  DirectoryKeys keys_;
  State state_ = State::kStale;
  OperationId operation_ = 0;
  Time began_{};
  Revision next_ = 0;  ///< first revision that the view does not have
  std::map<std::string, SessionEntry, std::less<>> sessions_;
  std::map<std::string, ServerEntry, std::less<>> servers_;
  std::set<std::string> changed_;
  std::uint64_t readings_ = 0, foreign_keys_ = 0;
};

}  // namespace tandem::directory
