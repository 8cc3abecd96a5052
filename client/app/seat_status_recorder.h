#pragma once

#include <optional>

#include "client/app/client_status.h"
#include "client/app/transfer_tracker.h"
#include "client/seat/seat.h"
#include "common/base/axes.h"
#include "common/base/time.h"

namespace tandem::client {

/// Collects the status of one seat over all its connections, on the servo thread. No heap, no lock.
class SeatStatusRecorder {
 public:
  explicit SeatStatusRecorder(double tick_hz) noexcept : transfer_(tick_hz) {}

  /// Counts a tick that began late. @return the number of late ticks so far
  std::uint32_t count_late_tick(bool late) noexcept { return status_.late_ticks += late ? 1 : 0; }
  /// A new connection is about to replace that of `seat`: adds the datagram counts of the old one.
  void on_reconnect(Time now, const Seat& seat) noexcept TANDEM_REALTIME;
  /// Takes the values that change from tick to tick; called once per tick.
  void on_tick(Time now, const Seat& seat) noexcept TANDEM_REALTIME;
  /// Takes all other values of `seat` and returns the status.
  const ClientStatus& update(Time now, const Seat& seat) noexcept TANDEM_REALTIME;
  /// The status as of the last `update`.
  [[nodiscard]] const ClientStatus& status() const noexcept { return status_; }

 private:
  ClientStatus status_;
  TransferTracker transfer_;
  DatagramCounts earlier_;  ///< sum over the replaced connections
  std::optional<Time> connected_;
};

}  // namespace tandem::client
