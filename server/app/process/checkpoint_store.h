#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <functional>
#include <list>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <thread>
#include <vector>

#include "common/auth/io/state_directory.h"
#include "common/base/time.h"
#include "common/io/event_fd.h"
#include "server/app/process/snapshot_keeper.h"
#include "server/session/session_snapshot.h"

namespace tandem::server {

/// Snapshot files for restarts: one per session, replaced atomically when a newer checkpoint arrives. Its own thread
/// writes them, so a slow disk delays no tick; it only makes the files older.
class CheckpointStore final : public SnapshotKeeper {
 public:
  /// @param folder   directory for its owner only; created if missing
  /// @param prefix   of the file names, to distinguish servers that share a directory
  /// @param trouble    receives write errors on the store's thread, once per session until its writes succeed again for
  /// kCalm. The mailbox of the session has each of them (CheckpointMailbox::stored).
  /// @param recovered  receives that they do, on the same thread
  [[nodiscard]] static std::expected<std::unique_ptr<CheckpointStore>, std::string> open(
      const std::string& folder, std::string prefix, std::function<void(const std::string&)> trouble,
      std::function<void(const std::string&)> recovered = {});
  /// A disk that fails each second time is reported once.
  static constexpr Duration kCalm = std::chrono::seconds(2);
  ~CheckpointStore() override;

  // ---- Before `start` ----
  struct Found {
    std::optional<SessionSnapshot> snapshot;  ///< compatible with the scene, and not older than a resume secret may be
    /// Why a snapshot was rejected, and where it was moved. Empty if there was none or it is compatible.
    std::string incompatibility;
  };
  /// Reads the snapshot that the last server left for this session. A rejected snapshot is renamed to `*.unfit`.
  /// @param wanted  false: any snapshot is rejected
  [[nodiscard]] Found find(const std::string& name, const SceneSpec& scene, std::int64_t now, bool wanted) const;
  void start();

  // ---- Any time, from one thread ----
  [[nodiscard]] std::shared_ptr<CheckpointMailbox> add(SessionSnapshot kept) override;
  void set_removed(const std::string& name, const std::vector<std::array<std::byte, 32>>& keys) override;
  void set_persons(const std::string& name, const std::vector<std::string>& persons) override;
  void remove(const std::string& name) override;
  /// Writes the newest checkpoints and ends the thread. Files remain.
  void stop();
  /// Deletes all files at once, without the thread: before a process exits on request.
  void remove_all() noexcept;

 private:
  struct Entry {
    explicit Entry(SessionSnapshot first, const io::EventFd& wake)
        : snapshot(std::move(first)), mailbox(std::make_shared<CheckpointMailbox>(wake)) {}
    SessionSnapshot snapshot;  ///< as last written
    std::shared_ptr<CheckpointMailbox> mailbox;
    std::atomic<bool> over{false};
    /// Newer than `snapshot`'s; guarded by the store's `lock_`.
    std::optional<std::vector<std::array<std::byte, 32>>> removed_workstations{};
    std::optional<std::vector<std::string>> persons{};  ///< the same
    std::vector<std::byte> written{};                   ///< bytes of the checkpoint in the file; empty: not known
    bool failing = false, gone = false;                 ///< failing: reported, and not over for kCalm
    Time works_since{};                                 ///< failing: of the first write after the last error; 0: none
  };

  CheckpointStore(auth::StateDirectory folder, std::string prefix, std::function<void(const std::string&)> trouble,
                  std::function<void(const std::string&)> recovered);
  [[nodiscard]] std::string file_of(const std::string& name) const;
  void run();
  void service_entry(Entry& entry);
  void write(Entry& entry, const Checkpoint& checkpoint);
  /// @param problem  of a write; empty: it succeeded, or the file has the checkpoint already
  void report(Entry& entry, const std::string& problem);

  auth::StateDirectory folder_;
  std::string prefix_;
  std::function<void(const std::string&)> on_error_, on_recovered_;
  io::EventFd wake_;
  std::mutex lock_;  ///< guards `entries_`; not held during a write
  std::list<std::shared_ptr<Entry>> entries_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace tandem::server
