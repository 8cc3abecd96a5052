#pragma once

#include <array>
#include <cstddef>
#include <memory>
#include <string>
#include <vector>

#include "common/auth/ticket.h"
#include "server/app/process/checkpoint_mailbox.h"
#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Keeps the newest snapshot of each session, so that a server can restore the session after the loss of this one. No
/// member waits for a disk or a network.
class SnapshotKeeper {
 public:
  virtual ~SnapshotKeeper() = default;
  /// Adds a session whose checkpoints are to be kept. From one thread. @param kept  everything but checkpoint and time
  [[nodiscard]] virtual std::shared_ptr<CheckpointMailbox> add(SessionSnapshot kept) = 0;
  /// Sets the removed workstations of a session. Thread-safe.
  virtual void set_removed(const std::string& name, const std::vector<std::array<std::byte, 32>>& keys) = 0;
  /// Sets the names of the persons at the seats of a session. Thread-safe.
  virtual void set_persons(const std::string& name, const std::vector<std::string>& persons) = 0;
  /// Sets the tickets of a session's consoles, which return at its next owner. Thread-safe. A keeper of a server that
  /// is alone keeps none: after its restart its consoles need new tickets.
  virtual void set_consoles(const std::string& /*name*/, const std::vector<auth::Id16>& /*tickets*/) {}
  /// Deletes the snapshot of a session that has ended. From the thread of `add`.
  virtual void remove(const std::string& name) = 0;
};

}  // namespace tandem::server
