#include "client/app/ask.h"

#include <poll.h>
#include <sys/random.h>

#include <cstdio>

#include "client/seat.h"
#include "common/io/clock.h"
#include "common/io/datagram_batch.h"
#include "common/io/signals.h"
#include "proto/visit.h"

namespace tandem::client {
namespace {

constexpr int kWaitMs = 20;

std::uint64_t unpredictable() {
  std::uint64_t drawn = 0;
  while (getrandom(&drawn, sizeof drawn, 0) != sizeof drawn) {
  }
  return drawn;
}

std::string refusal(const Joining& joining, const std::string& seat) {
  const std::string said = joining.reason();
  if (seat == wire::kVisitorName)
    return joining.result() == wire::BindResult::kNoSuchSeat ? "this server is of a version without link tests: " + said
                                                             : "refused: " + said + "; try again later";
  switch (joining.result()) {
    case wire::BindResult::kNoSuchSeat:
      return "--seat " + seat + ": " + said;
    case wire::BindResult::kSeatTaken:
      return "--seat " + seat + ": " + said +
             "; take another seat, or wait until it is free (2 s after its owner fell silent)";
    case wire::BindResult::kDeviceUnfit:
      return "the device does not fit this scene: " + said;
    case wire::BindResult::kSessionOver:
      return said + "; start the server again";
    case wire::BindResult::kAccepted:
      break;
  }
  return said;
}

std::string no_answer(const std::string& server, bool nobody_listens, Duration patience) {
  char waited[32];
  std::snprintf(waited, sizeof waited, "%g s", seconds(patience));
  if (nobody_listens)
    return "no server at " + server + ": nothing listens there (asked for " + waited +
           "). Start `tandem-server run SCENE` first, and use the address it prints as `listening on`";
  return "no answer from " + server + " within " + waited +
         ": is a tandem-server listening there, of this version, and is the network (or tandem-netsim proxy) between "
         "up?";
}

}  // namespace

std::expected<GivenSeat, NotSeated> ask_for_seat(const io::UdpSocket& socket, const std::string& server,
                                                 const std::string& seat, const hal::DeviceCaps& caps,
                                                 Duration patience, int signals) {
  Joining::Params params;
  params.seat = seat;
  params.caps = caps;
  params.nonce = unpredictable() >> 16;  // the rest of the 64 bits counts attempts
  params.own_cid = static_cast<std::uint32_t>(unpredictable() | 1);
  params.patience = patience;
  Joining joining{params};
  const auto in = std::make_unique<io::ReceiveBatch>();
  std::array<std::byte, link::kDatagramMax> buffer;
  bool nobody_listens = false;
  while (joining.outcome(io::monotonic_now()) == Joining::Outcome::kAsking) {
    const Time now = io::monotonic_now();
    if (const auto size = joining.poll_transmit(now, buffer))
      nobody_listens = ::send(socket.fd.get(), buffer.data(), *size, MSG_NOSIGNAL) < 0 && errno == ECONNREFUSED;
    pollfd files[] = {{socket.fd.get(), POLLIN, 0}, {signals, POLLIN, 0}};
    poll(files, 2, kWaitMs);
    if (files[1].revents != 0) return std::unexpected(NotSeated{true, "ended by " + std::string(io::signal_that_came()) + " before it had a seat"});
    if ((files[0].revents & POLLERR) != 0) {  // takes the news off the socket
      int error = 0;
      socklen_t size = sizeof error;
      if (getsockopt(socket.fd.get(), SOL_SOCKET, SO_ERROR, &error, &size) == 0 && error == ECONNREFUSED)
        nobody_listens = true;
    }
    const int count = in->receive(socket.fd.get());
    for (int k = 0; k < count; ++k) joining.on_datagram(io::monotonic_now(), in->bytes(static_cast<std::size_t>(k)));
    // An error keeps the socket readable: it must not turn waiting into spinning.
    if (count <= 0 && files[0].revents != 0) poll(nullptr, 0, kWaitMs);
  }
  switch (joining.outcome(io::monotonic_now())) {
    case Joining::Outcome::kAccepted:
      return GivenSeat{joining.setup(), joining.link()};
    case Joining::Outcome::kRefused:
      return std::unexpected(NotSeated{false, refusal(joining, seat)});
    default:
      return std::unexpected(NotSeated{false, no_answer(server, nobody_listens, patience)});
  }
}

void give_back(const io::UdpSocket& socket, const GivenSeat& given, const hal::DeviceCaps& caps) {
  const Time now = io::monotonic_now();
  Seat seat{given.setup, caps, given.link};
  seat.leave();
  [[maybe_unused]] const hal::Command nothing = seat.on_servo(now, hal::State{});
  std::array<std::byte, link::kDatagramMax> buffer;
  while (const auto size = seat.poll_transmit(now, buffer)) ::send(socket.fd.get(), buffer.data(), *size, MSG_NOSIGNAL);
}

}  // namespace tandem::client
