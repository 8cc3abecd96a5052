#pragma once

#include <mutex>

#include "common/io/event_fd.h"
#include "server/session/checkpoint.h"

namespace tandem::server {

/// Latest-value mailbox from a session's shard to the checkpoint store. It keeps only the newest checkpoint. `publish`
/// neither allocates nor waits; `take` holds the lock only while it copies.
class CheckpointMailbox {
 public:
  /// @param wake  event of the reader; must outlive this
  explicit CheckpointMailbox(const io::EventFd& wake) : wake_(&wake) {}

  /// Stores a checkpoint and wakes the reader. @return false while the reader copies: publish again in the next tick
  [[nodiscard]] bool publish(const Checkpoint& checkpoint) noexcept {
    const std::unique_lock lock{lock_, std::try_to_lock};
    if (!lock) return false;
    checkpoint_ = checkpoint;
    if (unread_) return true;  // the reader was woken already
    unread_ = true;
    wake_->signal();
    return true;
  }
  /// Copies the newest checkpoint to `out`. @return false if it was taken already
  [[nodiscard]] bool take(Checkpoint& out) {
    const std::lock_guard lock{lock_};
    if (!unread_) return false;
    out = checkpoint_;
    unread_ = false;
    return true;
  }

 private:
  const io::EventFd* wake_;
  std::mutex lock_;  ///< `publish` only tries it
  Checkpoint checkpoint_;
  bool unread_ = false;
};

}  // namespace tandem::server
