#include "client/app/seat_socket.h"

#include <algorithm>
#include <ctime>

#include "common/io/clock.h"

namespace tandem::client {

void SeatSocket::receive(Time now, Seat& seat) noexcept {
  constexpr int kRounds = 4;
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(socket_.fd.get());
    const Duration wall = io::read_clock(CLOCK_REALTIME);
    const Time read = io::monotonic_now();  // the same time on the monotonic clock
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (in_.too_long(i)) continue;
      // A datagram that was not read before arrived later, even if the wall clock was set.
      const Time came = std::clamp(read - in_.details(i, wall).age, read_until_, now);
      seat.on_datagram(came, in_.bytes(i));
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) break;
  }
  read_until_ = now;
}

void SeatSocket::send(Time now, Seat& seat) noexcept {
  while (out_.size() < kSendMax) {
    auto& buffer = buffers_[out_.size()];
    const auto size = seat.poll_transmit(now, buffer);
    if (!size) break;
    out_.add(std::span{buffer}.first(*size), nullptr, nullptr);
  }
  if (out_.size() > 0) out_.send(socket_.fd.get());
}

}  // namespace tandem::client
