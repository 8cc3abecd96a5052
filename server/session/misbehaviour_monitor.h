#pragma once

#include <optional>

#include "common/base/time.h"

namespace tandem::server {

/// Quarantines a client that sends impossible content under its own keys: numbers out of range, wrong lengths, jumps
/// that no hand can make. Such a client is defective or hostile. Its spring acts on no tool until `kQuarantineTime`
/// has passed without misbehaviour.
class MisbehaviourMonitor {
 public:
  static constexpr Duration kQuarantineTime = std::chrono::seconds(1);
  static constexpr Duration kForbiddenEventInterval = std::chrono::seconds(1);

  void report_misbehaviour(Time now) noexcept { last_misbehaviour_ = now; }
  [[nodiscard]] bool quarantined(Time now) const noexcept {
    return last_misbehaviour_ && now - *last_misbehaviour_ < kQuarantineTime;
  }

  /// Records a request that the client's role forbids. @return whether to emit an audit event: at most one per
  /// second
  [[nodiscard]] bool forbidden_event_due(Time now) noexcept {
    if (last_forbidden_event_ && now - *last_forbidden_event_ < kForbiddenEventInterval) return false;
    last_forbidden_event_ = now;
    return true;
  }

 private:
  std::optional<Time> last_misbehaviour_, last_forbidden_event_;
};

}  // namespace tandem::server
