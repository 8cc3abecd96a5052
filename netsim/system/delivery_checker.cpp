#include "netsim/system/delivery_checker.h"

#include <utility>

namespace tandem::netsim {

void DeliveryChecker::check(const ObservedSeat& seat) {
  const std::uint64_t generation = seat.endpoint().generation(), before = std::exchange(generation_, generation);
  const std::uint32_t tick = seat.endpoint().last_state().seat_tick, tick_before = std::exchange(seat_tick_, tick);
  const std::uint64_t arrived = std::exchange(arrived_, 0);
  if (generation >= before) {  // otherwise another client took the seat
    if (generation - before > arrived) seat.violated("acts_once");
    if (tick < tick_before) seat.violated("never_backwards");
  }
  if (seat.client.seat() == nullptr) return;
  const std::uint64_t accepted = seat.core().link().stats().accepted;
  const std::uint64_t accepted_before = std::exchange(accepted_, accepted);
  if (accepted > accepted_before && accepted - accepted_before > seat.client.new_datagrams())
    seat.violated("acts_once");
  if (seat.core().force().session_tick < session_tick_) seat.violated("never_backwards");
  session_tick_ = seat.core().force().session_tick;
}

}  // namespace tandem::netsim
