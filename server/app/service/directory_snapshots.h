#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "common/io/event_fd.h"
#include "server/app/process/snapshot_keeper.h"
#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Collects the newest snapshots of this server's sessions for the directory of its service. Thread-safe.
class DirectorySnapshots final : public SnapshotKeeper {
 public:
  /// Adds a session whose checkpoints are to be kept, in the place of an earlier one of its name.
  /// @param kept  everything but checkpoint and time
  [[nodiscard]] std::shared_ptr<CheckpointMailbox> add(SessionSnapshot kept) override;
  void set_removed(const std::string& name, const std::vector<std::array<std::byte, 32>>& keys) override;
  void set_persons(const std::string& name, const std::vector<std::string>& persons) override;
  void remove(const std::string& name) override;

  /// Takes the snapshots that changed since the last call: name of the session, and bytes of `encode_snapshot`.
  [[nodiscard]] std::vector<std::pair<std::string, std::string>> take();

 private:
  struct Entry {
    SessionSnapshot snapshot;
    std::shared_ptr<CheckpointMailbox> mailbox;
    std::vector<std::byte> taken{};  ///< bytes of the checkpoint as last taken
    bool changed = false;            ///< something else than the checkpoint
  };

  io::EventFd arrived_;  ///< of the mailboxes; `take` is called at a steady pace
  std::mutex lock_;
  std::list<Entry> entries_;
};

}  // namespace tandem::server
