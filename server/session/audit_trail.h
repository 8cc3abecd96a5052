#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "server/report/audit_event.h"
#include "server/session/session_clock.h"

namespace tandem::server {

/// Audit events of one session, stamped with its tick, for the thread that runs the session.
class AuditTrail {
 public:
  /// @param clock  of the session; must outlive this
  explicit AuditTrail(const SessionClock& clock) noexcept : clock_(&clock) {}

  /// @param seat     seat, or a value of AuditEvent that is no seat
  /// @param version  number that the event names, see AuditEvent
  void emit(Time now, AuditEvent::What what, std::size_t seat, std::uint32_t version = 0) noexcept {
    emit(now, {.what = what, .seat = static_cast<std::uint8_t>(seat), .version = version});
  }
  /// Sets time and tick of an event and queues it.
  void emit(Time now, AuditEvent event) noexcept {
    event.tick = clock_->session_tick();
    event.at = now;
    event.order = order_;
    queue_.push(event);
  }
  /// Sets the order of the events from now on; 0: they follow from none.
  void set_order(std::uint32_t order) noexcept { order_ = order; }
  /// Next event, in order; nullopt when there is none. To be called after every tick: the queue holds
  /// AuditQueue::kCapacity events.
  [[nodiscard]] std::optional<AuditEvent> poll() noexcept { return queue_.poll(); }
  /// Events that were lost because the queue was full.
  [[nodiscard]] std::uint64_t dropped() const noexcept { return queue_.dropped(); }

 private:
  const SessionClock* clock_;
  AuditQueue queue_;
  std::uint32_t order_ = 0;
};

}  // namespace tandem::server
