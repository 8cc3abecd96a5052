#include "server/app/process/checkpoint_publisher.h"

#include <cmath>
#include <utility>

namespace tandem::server {
namespace {

constexpr double kCheckpointInterval = 0.5;  // [s]
// Attempts to publish the last checkpoint. Each fails only while the store copies.
constexpr int kPublishAttempts = 1000;

/// Whether an event changes what a restart restores.
constexpr bool triggers_checkpoint(AuditEvent::What what) noexcept {
  using What = AuditEvent::What;
  return what == What::kJoin || what == What::kLeave || what == What::kAuthority || what == What::kStop ||
         what == What::kPause || what == What::kResume || what == What::kFault || what == What::kRestored ||
         what == What::kAllBack || what == What::kRemoved || what == What::kAuthorityCancelled;
}

}  // namespace

void CheckpointPublisher::attach(std::shared_ptr<CheckpointMailbox> mailbox, std::uint64_t epoch, double tick_hz) {
  mailbox_ = std::move(mailbox);
  epoch_ = epoch;
  interval_ = static_cast<std::uint64_t>(std::lround(kCheckpointInterval * tick_hz));
}

void CheckpointPublisher::note(AuditEvent::What event) noexcept { due_ = due_ || triggers_checkpoint(event); }

void CheckpointPublisher::step(const Session& session) noexcept {
  due_ |= session.start_condition().begun() !=
          std::exchange(begun_, session.start_condition().begun());  // `|=`: `begun_` follows in any case
  if (mailbox_ && (due_ || ++since_ >= interval_)) publish(session);
}

void CheckpointPublisher::finish(const Session& session) noexcept {
  due_ = true;
  for (int tries = 0; mailbox_ && due_ && tries < kPublishAttempts; ++tries) publish(session);
}

void CheckpointPublisher::publish(const Session& session) noexcept {
  Checkpoint now = session.checkpoint();
  now.epoch = epoch_;  // a session that replaced another one has a higher epoch than `Session` counts
  due_ = !mailbox_->publish(now);
  if (!due_) since_ = 0;
}

}  // namespace tandem::server
