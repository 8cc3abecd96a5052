#include "client/app/live_seat.h"

#include <poll.h>

#include <utility>

#include "client/app/join_client.h"
#include "client/app/seat_runner.h"
#include "client/app/server_addresses.h"

namespace tandem::client {

struct LiveSeat::Parts {
  Parts(const JoinedSeat& joined, io::UdpSocket socket, const hal::DeviceCaps& caps, Duration exchange)
      : seat(joined.setup, caps, joined.link), runner(std::move(socket), seat, nullptr, {}, nullptr, exchange) {}

  Seat seat;
  SeatRunner runner;
};

LiveSeat::LiveSeat(std::unique_ptr<Parts> parts) : parts_(std::move(parts)) {}
LiveSeat::~LiveSeat() = default;

std::expected<std::unique_ptr<LiveSeat>, std::string> LiveSeat::join(const LiveSeatOptions& options,
                                                                     const hal::DeviceCaps& caps) {
  JoinOptions asking{.seat = options.seat,
                     .session = options.session,
                     .ticket = options.ticket,
                     .state = options.state,
                     .caps = caps,
                     .timeout = options.timeout};
  if (const std::string wrong = set_server_addresses(options.server, asking); !wrong.empty())
    return std::unexpected("server: " + wrong);
  const auto joined = join_seat(asking);
  if (!joined) return std::unexpected(joined.error().reason);
  auto socket = io::connect_udp(joined->udp);
  if (!socket) return std::unexpected("server: " + socket.error());
  return std::unique_ptr<LiveSeat>(
      new LiveSeat(std::make_unique<Parts>(*joined, std::move(*socket), caps, options.exchange)));
}

hal::Command LiveSeat::tick(const hal::State& state) noexcept { return parts_->runner.tick(state); }
Duration LiveSeat::next_shift() noexcept { return parts_->runner.next_shift(); }
void LiveSeat::lost(hal::Errc why) noexcept { parts_->runner.lost(why); }

const SeatSetup& LiveSeat::setup() const noexcept { return parts_->seat.setup(); }
ClientStatus LiveSeat::status() const { return parts_->runner.status(); }

bool LiveSeat::wait_until_closed(Duration timeout) const {
  pollfd closed{.fd = parts_->runner.finished_fd(), .events = POLLIN, .revents = 0};
  return ::poll(&closed, 1, static_cast<int>(timeout / std::chrono::milliseconds(1))) > 0;
}

void LiveSeat::leave() noexcept { parts_->runner.commands().leave(); }
void LiveSeat::stop() noexcept { parts_->runner.commands().stop(); }
void LiveSeat::stop_all() noexcept { parts_->runner.commands().stop_all(); }
void LiveSeat::resume() noexcept { parts_->runner.commands().resume(); }
void LiveSeat::reset_gate() noexcept { parts_->runner.commands().reset_gate(); }

}  // namespace tandem::client
