#pragma once

#include <atomic>
#include <cstdint>
#include <mutex>
#include <utility>

#include "common/io/event_fd.h"
#include "server/app/process/stored_orders.h"
#include "server/session/checkpoint.h"

namespace tandem::server {

/// Latest-value mailbox from a session's shard to the checkpoint store. It keeps only the newest checkpoint. `publish`
/// neither allocates nor waits; `take` holds the lock only while it copies.
class CheckpointMailbox {
 public:
  /// Checkpoints that wake their reader.
  enum class Wakes : std::uint8_t {
    kEach,
    kOrders,  ///< those with an order that the one before has not; the reader looks for others at a steady pace
  };
  /// @param wake  event of the reader; must outlive this
  explicit CheckpointMailbox(const io::EventFd& wake, Wakes wakes = Wakes::kEach) : wake_(&wake), wakes_(wakes) {}

  /// Stores a checkpoint and wakes the reader. @return false while the reader copies: publish again in the next tick
  [[nodiscard]] bool publish(const Checkpoint& checkpoint) noexcept {
    const std::unique_lock lock{lock_, std::try_to_lock};
    if (!lock) return false;
    const bool order = checkpoint.orders != checkpoint_.orders;
    checkpoint_ = checkpoint;
    if (order) order_waits_.store(true, std::memory_order_relaxed);
    const bool unread = std::exchange(unread_, true);  // the reader was woken already
    if (wakes_ == Wakes::kOrders ? order : !unread) wake_->signal();
    return true;
  }
  /// Copies the newest checkpoint to `out`. @return false if it was taken already
  [[nodiscard]] bool take(Checkpoint& out) {
    const std::lock_guard lock{lock_};
    if (!unread_) return false;
    out = checkpoint_;
    unread_ = false;
    order_waits_.store(false, std::memory_order_relaxed);
    return true;
  }
  /// The newest checkpoint has an order that the one before has not, and was not taken. For the reader.
  [[nodiscard]] bool order_waits() const noexcept { return order_waits_.load(std::memory_order_relaxed); }

  /// Which orders of the session are stored.
  [[nodiscard]] StoredOrders& stored() noexcept { return stored_; }

 private:
  const io::EventFd* wake_;
  Wakes wakes_;
  StoredOrders stored_;
  std::mutex lock_;  ///< `publish` only tries it
  Checkpoint checkpoint_;
  bool unread_ = false;
  std::atomic<bool> order_waits_{false};
};

}  // namespace tandem::server
