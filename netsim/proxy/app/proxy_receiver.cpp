#include "netsim/proxy/app/proxy_receiver.h"

#include <algorithm>
#include <cerrno>

namespace tandem::netsim {
namespace {

/// Limit of passes, so that a flood of unknown senders does not delay clients. Beyond it, only the order of unknown
/// senders' datagrams may be lost.
constexpr int kPassesMax = 16;
static_assert(io::ReceiveBatch::kSlotBytes == kSlotBytes, "the buffer holds every datagram that can be received");

}  // namespace

/// Returns the number of datagrams in the batch.
std::size_t ProxyReceiver::receive(int fd) noexcept {
  const int received = in_.receive(fd);
  read_at_ = clock_.now();
  if (received < 0) ++(errno == ECONNREFUSED ? errors_.refused : errors_.other);  // the port may open again
  return received > 0 ? static_cast<std::size_t>(received) : 0;
}

std::size_t ProxyReceiver::read(ProxySource source, Duration now) noexcept {
  if (source.kind == ProxySource::Kind::kListen) return read_unknown_senders(now);
  const int fd = clients_.fd_of(source);
  if (fd < 0) return 0;  // closed by an earlier event of this round
  const std::size_t count = receive(fd);
  ProxyClients::Client& client = clients_[source.place];
  const bool up = source.kind == ProxySource::Kind::kDownside;
  if (count > 0) client.last_seen = now;
  if (count > 0 && up) client.last_heard = now;
  const bool former = source.kind == ProxySource::Kind::kFormer;
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.too_long(i)) {
      ++errors_.too_long;
      continue;
    }
    core_.ingress(clock_.arrival(in_.details(i, Duration{}).stamp, read_at_), source.place,
                  up ? Direction::kUp : Direction::kDown, in_.bytes(i),
                  former ? client.former_number : client.address_number);
  }
  return count;
}

// Datagrams reach a new socket from other clients between its binding and connecting. Earlier datagrams of its own
// client are in the listening socket. Therefore all these sockets are read until a pass finds no new client. All
// datagrams that arrived before that pass have then been read, and the stamps give their order.
std::size_t ProxyReceiver::read_unknown_senders(Duration now) noexcept {
  std::size_t count = 0;
  for (int pass = 0; pass < kPassesMax; ++pass) {
    const std::uint64_t seen = core_.clients().seen();
    std::size_t longest = receive_unknown_senders(clients_.listen_fd(), now);
    count += longest;
    for (const std::uint32_t place : clients_.pending()) {
      const std::size_t more = receive_unknown_senders(clients_[place].downside.get(), now);
      longest = std::max(longest, more);
      count += more;
    }
    if (longest < io::ReceiveBatch::kMax && seen == core_.clients().seen()) break;
    if (arrivals_.full()) break;
  }
  arrivals_.flush([&](std::uint32_t place, Duration stamp, std::span<const std::byte> bytes) {
    core_.ingress(clock_.arrival(stamp, read_at_), place, Direction::kUp, bytes);
  });
  clients_.listen_to_pending();
  return count;
}

std::size_t ProxyReceiver::receive_unknown_senders(int fd, Duration now) noexcept {
  if (arrivals_.full()) return 0;
  const std::size_t count = receive(fd);
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.too_long(i)) {
      ++errors_.too_long;
      continue;
    }
    const auto details = in_.details(i, Duration{});
    const auto place = registry_.identify(in_.from(i), details.local, now);
    if (!place) continue;
    if (arrivals_.full()) {
      core_.ingress(clock_.arrival(details.stamp, read_at_), *place, Direction::kUp, in_.bytes(i));
    } else {
      arrivals_.add(*place, details.stamp, in_.bytes(i));
    }
  }
  return count;
}

}  // namespace tandem::netsim
