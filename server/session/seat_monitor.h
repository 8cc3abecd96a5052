#pragma once

#include <cstddef>

#include "common/base/time.h"
#include "server/session/audit_trail.h"
#include "server/session/seat_endpoint.h"

namespace tandem::server {

/// Emits audit events when the condition of a seat changes: link lost, quarantine, local stop, flood of datagrams, and
/// an instructor who is away.
class SeatMonitor {
 public:
  static constexpr Duration kInstructorAway = std::chrono::seconds(10);

  /// Compares the seat with its condition at the last call. To be called once per tick.
  /// @param number     of the seat, for the events
  /// @param condition  of the seat now
  void step(Time now, std::size_t number, SeatEndpoint& seat, const SeatEndpoint::Condition& condition,
            AuditTrail& audit) noexcept TANDEM_REALTIME;

 private:
  bool lost_ = false, quarantined_ = false, local_stop_ = false, away_ = false;
  Time lost_at_{};
};

}  // namespace tandem::server
