#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/ticket.h"
#include "common/base/time.h"
#include "server/app/process/act_limit.h"
#include "server/app/process/session_instance.h"
#include "server/app/process/snapshot_keeper.h"

namespace tandem::server {

/// A session of a service of several servers, which this server owns from now on.
struct OwnedSession {
  std::shared_ptr<const SessionOptions> options;
  auth::Id16 id{};
  std::string code;               ///< 10 characters of 0-9 A-Z; empty: tickets only
  std::optional<Time> ends_at{};  ///< time limit by the wall clock; that of the snapshot is better; nullopt: none
  std::optional<SessionSnapshot> snapshot{};  ///< newest one that its former owner kept; nullopt: a new session
  std::vector<auth::Id16> consoles{};         ///< tickets of the consoles at its former owner
  /// Of the ownership in the directory. It becomes the session's epoch: higher than that of each former owner.
  std::uint64_t revision = 0;
  std::shared_ptr<const ActLimit> act_limit{};  ///< of all that the server owns; nullptr: none
  SnapshotKeeper* keeper = nullptr;             ///< must outlive the session
  /// Called on the main loop's thread when the session is over and serves no client any more.
  /// @param given_up  another server may own the session by now; false: it has ended
  std::function<void(bool given_up)> on_over = [](bool) {};
};

}  // namespace tandem::server
