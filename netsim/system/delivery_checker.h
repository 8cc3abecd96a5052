#pragma once

#include <cstdint>

#include "netsim/system/first_seen_filter.h"
#include "netsim/system/observed_seat.h"

namespace tandem::netsim {

/// Checks for one seat that a datagram acts at most once and never backwards, at the server and at the client. No more
/// datagrams act than arrived for the first time, and their ticks never decrease. The order of sending is not compared:
/// after a path challenge or a drop, an older datagram may act later than a newer one.
class DeliveryChecker {
 public:
  /// Counts datagram number `index` of this seat, which the server received.
  void on_server_datagram(std::uint64_t index) noexcept {
    if (first_seen_.is_first(index)) ++arrived_;
  }
  /// The client has a new connection: its counters start at 0.
  void on_new_connection() noexcept {
    accepted_ = 0;
    session_tick_ = 0;
  }
  /// Checks a tick of server and client.
  void check(const ObservedSeat& seat);

 private:
  FirstSeenFilter first_seen_;                      ///< of datagrams at the server
  std::uint64_t arrived_ = 0;                       ///< first deliveries to the server since the last check
  std::uint64_t generation_ = 0, accepted_ = 0;     ///< datagrams that acted: at the server, at the client
  std::uint32_t seat_tick_ = 0, session_tick_ = 0;  ///< newest ticks: of STATE at the server, of FORCE at the client
};

}  // namespace tandem::netsim
