#include <algorithm>
#include <cerrno>

#include "netsim/proxy/app/proxy.h"

namespace tandem::netsim {
namespace {

/// Upper bound of a datagram's wait in the kernel, in case the wall clock jumps.
constexpr Duration kAgeMax{1'000'000'000};
/// Limit of passes, so that a flood of unknown senders does not delay clients. Beyond it, only the order of unknown
/// senders' datagrams may be lost.
constexpr int kPassesMax = 16;
/// Silence after which a new port of the same host counts as a reconnect. A client sends hundreds of datagrams per
/// second, so a longer silence means that it closed its socket. A server frees a seat after the same time.
constexpr Duration kReconnects{2'000'000'000};
static_assert(io::ReceiveBatch::kSlotBytes == kSlotBytes, "the buffer holds every datagram that can be received");

}  // namespace

Time Proxy::arrival_time(Duration stamp) const noexcept {
  if (stamp == Duration{}) return Time{now_};
  // Datagrams that arrived between opening the socket and the first round count as arrived at the start.
  const Duration oldest = std::max(now_ - kAgeMax, Duration::zero());
  return Time{std::clamp(stamp - wall_at_start_, oldest, now_ + Duration{1'000'000})};
}

std::size_t Proxy::receive(int fd) noexcept {
  const int received = in_.receive(fd);
  if (received < 0) ++(errno == ECONNREFUSED ? errors_.refused : errors_.other);  // the port may open again
  return received > 0 ? static_cast<std::size_t>(received) : 0;
}

std::size_t Proxy::read(ProxySource source) noexcept {
  if (source.kind == ProxySource::Kind::kListen) return read_unknown_senders();
  const int fd = clients_.fd_of(source);
  if (fd < 0) return 0;  // closed by an earlier event of this round
  const std::size_t count = receive(fd);
  ProxyClients::Client& client = clients_[source.place];
  const bool up = source.kind == ProxySource::Kind::kDownside;
  if (count > 0) client.last_seen = now_;
  if (count > 0 && up) client.last_heard = now_;
  const bool former = source.kind == ProxySource::Kind::kFormer;
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.too_long(i)) {
      ++errors_.too_long;
      continue;
    }
    const Time at = arrival_time(in_.details(i, Duration{}).stamp);
    if (up) {
      core_.ingress(at, source.place, Direction::kUp, in_.bytes(i));
    } else {
      core_.ingress(at, source.place, Direction::kDown, in_.bytes(i),
                    former ? client.former_number : client.address_number);
    }
  }
  return count;
}

// Datagrams reach a new socket from other clients between its binding and connecting. Earlier datagrams of its own
// client are in the listening socket. Therefore all these sockets are read until a pass finds no new client. All
// datagrams that arrived before that pass have then been read, and the stamps give their order.
std::size_t Proxy::read_unknown_senders() noexcept {
  std::size_t count = 0;
  for (int pass = 0; pass < kPassesMax; ++pass) {
    const std::uint64_t seen = core_.clients_seen();
    std::size_t longest = receive_unknown_senders(clients_.listen_fd());
    count += longest;
    for (const std::uint32_t place : clients_.pending()) {
      const std::size_t more = receive_unknown_senders(clients_[place].downside.get());
      longest = std::max(longest, more);
      count += more;
    }
    if (longest < io::ReceiveBatch::kMax && seen == core_.clients_seen()) break;
    if (arrivals_.full()) break;
  }
  arrivals_.empty([this](std::uint32_t place, Duration stamp, std::span<const std::byte> bytes) {
    core_.ingress(arrival_time(stamp), place, Direction::kUp, bytes);
  });
  clients_.listen_to_pending();
  return count;
}

std::size_t Proxy::receive_unknown_senders(int fd) noexcept {
  if (arrivals_.full()) return 0;
  const std::size_t count = receive(fd);
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.too_long(i)) {
      ++errors_.too_long;
      continue;
    }
    const auto details = in_.details(i, Duration{});
    const auto place = client_of(i, details.local);
    if (!place) continue;
    if (arrivals_.full()) {
      core_.ingress(arrival_time(details.stamp), *place, Direction::kUp, in_.bytes(i));
    } else {
      arrivals_.add(*place, details.stamp, in_.bytes(i));
    }
  }
  return count;
}

std::optional<std::uint32_t> Proxy::client_of(std::size_t message, const io::LocalAddress& local) noexcept {
  const io::PeerKey key = io::PeerKey::of(in_.from(message));
  auto found = clients_.find(key);
  if (!found) found = admit_client(key, message, local);
  if (found) clients_[*found].last_seen = clients_[*found].last_heard = now_;
  return found;
}

std::optional<std::uint32_t> Proxy::admit_client(const io::PeerKey& key, std::size_t message,
                                                 const io::LocalAddress& local) noexcept {
  // A reconnecting client uses a new port; it keeps the number that commands and reports use.
  if (const auto back = clients_.find_silent(in_.from(message), now_ - kReconnects);
      back && clients_.move(*back, key, in_.from(message), local))
    return back;
  if (core_.clients() == ProxyCore::kClientsMax) {
    ++errors_.too_many_clients;
    return std::nullopt;
  }
  // Prepared by an ordinary thread, which also frees it.
  ClientPool::PreparedClient* const made = client_pool_.next();
  const auto place = core_.add_client(made != nullptr ? &made->place : nullptr);
  std::unique_ptr<LinkMonitor> watch = made != nullptr ? std::move(made->monitor) : nullptr;
  if (made != nullptr) client_pool_.give_back(made);
  if (!clients_.add(*place, core_.clients_seen(), key, in_.from(message), local)) {
    core_.remove_client(*place);
    ++errors_.other;
    return std::nullopt;
  }
  clients_[*place].arrived = now_;
  if (options_.monitor_quality && monitored_.size() < monitored_.capacity()) {
    monitored_.push_back({core_.clients_seen(), watch ? std::move(watch) : std::make_unique<LinkMonitor>()});
    core_.attach_monitor(*place, monitored_.back().monitor.get());
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    delays_[*place * kDirections + static_cast<std::size_t>(direction)].clear();
  }
  return place;
}

}  // namespace tandem::netsim
