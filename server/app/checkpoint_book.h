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

#include "common/trust/io/state_folder.h"
#include "server/app/checkpoint_mail.h"
#include "server/kept_session.h"

namespace tandem::server {

/// The files from which sessions go on after a restart: one per session, replaced whole, each time its newest checkpoint comes. A thread
/// of its own writes: a slow disk delays nobody, only makes the files older.
class CheckpointBook {
 public:
  /// @param folder  owner-only; made if it is missing
  /// @param prefix  of the files' names: servers that share a folder tell theirs apart by it
  /// @param trouble  told, on the book's thread, when a file cannot be written, and not again before it could be
  [[nodiscard]] static std::expected<std::unique_ptr<CheckpointBook>, std::string> open(const std::string& folder, std::string prefix,
                                                                                       std::function<void(const std::string&)> trouble);
  ~CheckpointBook();

  // ---- Before `start` ----
  struct Found {
    std::optional<KeptSession> kept;  ///< fits, and is younger than the resume secrets' life
    std::string unfit;                ///< why what was there does not, and where it was moved; empty: nothing was there, or it fits
  };
  /// What the last server left of this session. What does not fit is moved aside.
  /// @param wanted  false: whatever is there is moved aside
  [[nodiscard]] Found find(const std::string& name, const SceneSpec& scene, std::int64_t now, bool wanted) const;
  void start();

  // ---- Any time, from one thread ----
  /// A session whose checkpoints shall be kept from now on. @param kept  everything but checkpoint and time
  [[nodiscard]] std::shared_ptr<CheckpointMail> begin(KeptSession kept);
  /// Who is not let in by the session's code again: into its file with the next round. From any thread.
  void send_away(const std::string& name, std::vector<std::array<std::byte, 32>> keys);
  /// It is over in an orderly way: its file goes.
  void end(const std::string& name);
  /// Writes what is newest and stops. Files stay.
  void stop();
  /// At once and without the thread, before a process ends that a person ended: all files go.
  void drop_all() noexcept;

 private:
  struct Page {
    explicit Page(KeptSession first, const io::Fd& wake) : kept(std::move(first)), mail(std::make_shared<CheckpointMail>(wake)) {}
    KeptSession kept;                       ///< as last written
    std::shared_ptr<CheckpointMail> mail;
    std::atomic<bool> over{false};
    std::optional<std::vector<std::array<std::byte, 32>>> sent_away{};  ///< newer than `kept`'s; under the book's lock
    std::vector<std::byte> written{};       ///< of the checkpoint, as last written
    bool troubled = false, gone = false;
  };

  CheckpointBook(trust::StateFolder folder, std::string prefix, std::function<void(const std::string&)> trouble);
  [[nodiscard]] std::string file_of(const std::string& name) const;
  void work();
  void see_to(Page& page);
  void write(Page& page, const Checkpoint& checkpoint);
  void wake() const noexcept;

  trust::StateFolder folder_;
  std::string prefix_;
  std::function<void(const std::string&)> trouble_;
  io::Fd wake_;
  std::mutex lock_;  ///< of the list; not held while anything is written
  std::list<std::shared_ptr<Page>> pages_;
  std::atomic<bool> stopping_{false};
  std::thread thread_;
};

}  // namespace tandem::server
