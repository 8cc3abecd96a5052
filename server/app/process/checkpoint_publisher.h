#pragma once

#include <cstdint>
#include <memory>

#include "server/app/process/checkpoint_mailbox.h"
#include "server/session/session.h"

namespace tandem::server {

/// Publishes the checkpoints of a session: twice per second of session ticks, and at once when the session begins or
/// when an event changes what a restart restores. Without a mailbox it does nothing.
class CheckpointPublisher {
 public:
  /// @param epoch    of the session as the clients know it
  /// @param tick_hz  of the session
  void attach(std::shared_ptr<CheckpointMailbox> mailbox, std::uint64_t epoch, double tick_hz);

  // ---- The session's thread; no heap, no wait ----
  /// An event of the session, before the `step` of its tick.
  void note(AuditEvent::What event) noexcept;
  void step(const Session& session) noexcept;
  /// Publishes the last checkpoint, whether one is due or not.
  void finish(const Session& session) noexcept;

 private:
  void publish(const Session& session) noexcept;

  std::shared_ptr<CheckpointMailbox> mailbox_;  ///< null: checkpoints are not stored
  std::uint64_t epoch_ = 1, interval_ = 0, since_ = 0;
  bool due_ = true, begun_ = false;
};

}  // namespace tandem::server
