#pragma once

#include <cstdint>
#include <map>
#include <set>
#include <string>

#include "server/directory/directory.h"
#include "server/directory/directory_keys.h"
#include "server/directory/prefix_follower.h"

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

  explicit DirectoryView(DirectoryKeys keys) : keys_(std::move(keys)), follower_(keys_.live()) {}

  /// Returns the request to begin now, if there is one.
  /// @param retry_after  time after which a request without an answer is made again
  [[nodiscard]] std::optional<Request> poll_request(Time now, OperationId operation, Duration retry_after) {
    return follower_.poll_request(now, operation, retry_after);
  }
  /// Takes a reply. Returns whether it belongs to the view.
  bool on_reply(const Reply& reply);
  /// Returns the next session whose entry changed since the last call.
  [[nodiscard]] std::optional<std::string> poll_changed();

  /// The view is complete and follows the store.
  [[nodiscard]] bool follows() const noexcept { return follower_.follows(); }
  /// Has everything read again.
  void read_again() noexcept { follower_.restart(); }
  [[nodiscard]] const std::map<std::string, SessionEntry, std::less<>>& sessions() const noexcept { return sessions_; }
  [[nodiscard]] const std::map<std::string, ServerEntry, std::less<>>& servers() const noexcept { return servers_; }
  [[nodiscard]] const SessionEntry* session(std::string_view name) const;
  [[nodiscard]] const ServerEntry* server(std::string_view name) const;
  /// Newest revision of which the view knows all changes.
  [[nodiscard]] Revision revision() const noexcept { return follower_.revision(); }
  /// Times at which everything was read.
  [[nodiscard]] std::uint64_t readings() const noexcept { return follower_.readings(); }
  /// Keys below `live/` that are no key of this directory; they are ignored.
  [[nodiscard]] std::uint64_t foreign_keys() const noexcept { return foreign_keys_; }

 private:
  void apply(const Change& change);

  DirectoryKeys keys_;
  PrefixFollower follower_;
  std::map<std::string, SessionEntry, std::less<>> sessions_;
  std::map<std::string, ServerEntry, std::less<>> servers_;
  std::set<std::string> changed_;
  std::uint64_t foreign_keys_ = 0;
};

}  // namespace tandem::directory
