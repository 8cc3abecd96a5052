#pragma once

#include <unistd.h>

#include <mutex>

#include "common/io/fd.h"
#include "server/checkpoint.h"

namespace tandem::server {

/// Where the tick's thread lays a session's newest checkpoint down for whoever writes it: the newest only, without heap, and without
/// waiting. Who picks it up holds it for no longer than a copy takes.
class CheckpointMail {
 public:
  /// @param wake  event file of the writer  @pre outlives this
  explicit CheckpointMail(const io::Fd& wake) : wake_(&wake) {}

  /// @return false: it is just being picked up; lay it down again with the next tick
  [[nodiscard]] bool lay_down(const Checkpoint& checkpoint) noexcept {
    const std::unique_lock lock{lock_, std::try_to_lock};
    if (!lock) return false;
    checkpoint_ = checkpoint;
    if (fresh_) return true;  // the writer is awake or about to be
    fresh_ = true;
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(wake_->get(), &one, sizeof one);
    return true;
  }
  /// @return whether there was something newer
  [[nodiscard]] bool pick_up(Checkpoint& out) {
    const std::lock_guard lock{lock_};
    if (!fresh_) return false;
    out = checkpoint_;
    fresh_ = false;
    return true;
  }

 private:
  const io::Fd* wake_;
  std::mutex lock_;  ///< the tick's thread only tries it
  Checkpoint checkpoint_;
  bool fresh_ = false;
};

}  // namespace tandem::server
