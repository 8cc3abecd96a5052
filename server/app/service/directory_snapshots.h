#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
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
    std::uint64_t mark = 0;                 ///< of the snapshot, for `set_stored`
    bool order = false;                     ///< the snapshot has an order that the one before has not
  };
  /// Takes what changed since the last call. @param now  of a clock that does not jump
  [[nodiscard]] std::vector<News> take(Time now);
  /// Descriptor that is readable while a snapshot with a new order waits.
  [[nodiscard]] int order_fd() const noexcept { return order_arrived_.get(); }
  /// The snapshot with this mark is in the directory.
  void set_stored(std::uint64_t mark);
  /// Why the directory stores no snapshots now, with the remedy; empty: it does.
  void set_problem(const std::string& why);

 private:
  struct Entry {
    SessionSnapshot snapshot;
    std::shared_ptr<CheckpointMailbox> mailbox;
    std::vector<std::byte> taken{};   ///< bytes of the checkpoint as last taken
    bool changed = false;             ///< something else than the checkpoint
    std::optional<Time> life_ends{};  ///< of a session with a limit; nullopt before its first `take`
    std::uint32_t number = 0;         ///< differs between all sessions of this server, also of one name
    std::vector<auth::Id16> consoles{};
    bool consoles_changed = false;
  };

  /// Takes the newest snapshot of an entry, if it has changed.
  static void take_snapshot(Entry& entry, News& news, Time now);

  io::EventFd order_arrived_;  ///< of the mailboxes; `take` is called at a steady pace too
  std::mutex lock_;
  std::list<Entry> entries_;
  std::uint32_t added_ = 0;  ///< sessions so far
  std::string problem_;      ///< as `set_problem` has it
};

}  // namespace tandem::server
