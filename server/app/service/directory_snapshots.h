#pragma once

#include <array>
#include <cstddef>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
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
  void set_consoles(const std::string& name, const std::vector<auth::Id16>& tickets) override;
  void remove(const std::string& name) override;

  /// The changed values of a session.
  struct News {
    std::string session;
    std::string snapshot{};                 ///< bytes of `encode_snapshot`; empty: unchanged
    std::optional<std::string> consoles{};  ///< text of ServiceConsoles; nullopt: unchanged
  };
  /// Takes what changed since the last call.
  [[nodiscard]] std::vector<News> take();

 private:
  struct Entry {
    SessionSnapshot snapshot;
    std::shared_ptr<CheckpointMailbox> mailbox;
    std::vector<std::byte> taken{};  ///< bytes of the checkpoint as last taken
    bool changed = false;            ///< something else than the checkpoint
    std::vector<auth::Id16> consoles{};
    bool consoles_changed = false;
  };

  /// Bytes of the newest snapshot of an entry; empty: it has not changed.
  [[nodiscard]] static std::string take_snapshot(Entry& entry);

  io::EventFd arrived_;  ///< of the mailboxes; `take` is called at a steady pace
  std::mutex lock_;
  std::list<Entry> entries_;
};

}  // namespace tandem::server
