#include <algorithm>
#include <cerrno>

#include "netsim/app/proxy.h"

namespace tandem::netsim {
namespace {

/// A datagram cannot have waited longer in the kernel, whatever the wall clock says.
constexpr Duration kAgeMax{1'000'000'000};
/// A flood of strangers must not hold up the others: then the order of theirs may be lost, nothing else.
constexpr int kPassesMax = 16;
/// A hand sends hundreds of datagrams a second: a client that sent none for so long has closed its socket. A seat is free for others as soon.
constexpr Duration kReconnects{2'000'000'000};
static_assert(io::ReceiveBatch::kSlotBytes == kSlotBytes, "what can be received can be kept");

}  // namespace

Time Proxy::moment_of(Duration stamp) const noexcept {
  if (stamp == Duration{}) return Time{now_};
  // What came between the socket's opening and the first round came at the start: there is no time before it.
  const Duration oldest = std::max(now_ - kAgeMax, Duration::zero());
  return Time{std::clamp(stamp - wall_at_start_, oldest, now_ + Duration{1'000'000})};
}

std::size_t Proxy::receive(int fd) noexcept {
  const int received = in_.receive(fd);
  if (received < 0) ++(errno == ECONNREFUSED ? troubles_.refused : troubles_.other);  // it may come back
  return received > 0 ? static_cast<std::size_t>(received) : 0;
}

std::size_t Proxy::read(ProxySource source) noexcept {
  if (source.kind == ProxySource::Kind::kListen) return read_strangers();
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
      ++troubles_.too_long;
      continue;
    }
    const Time at = moment_of(in_.details(i, Duration{}).stamp);
    if (up) {
      core_.ingress(at, source.place, Direction::kUp, in_.bytes(i));
    } else {
      core_.ingress(at, source.place, Direction::kDown, in_.bytes(i),
                    former ? client.former_number : client.address_number);
    }
  }
  return count;
}

// Between the binding and the connecting of a socket others' datagrams get into it too, and what its own client sent
// before lies in the listening one. So all these sockets are read until a pass found nobody new: whatever came before
// that pass has then been read, and the stamps tell the order.
std::size_t Proxy::read_strangers() noexcept {
  std::size_t count = 0;
  for (int pass = 0; pass < kPassesMax; ++pass) {
    const std::uint64_t seen = core_.clients_seen();
    std::size_t longest = receive_strangers(clients_.listen_fd());
    count += longest;
    for (const std::uint32_t place : clients_.newcomers()) {
      const std::size_t more = receive_strangers(clients_[place].downside.get());
      longest = std::max(longest, more);
      count += more;
    }
    if (longest < io::ReceiveBatch::kMax && seen == core_.clients_seen()) break;
    if (waiting_.full()) break;
  }
  waiting_.empty([this](std::uint32_t place, Duration stamp, std::span<const std::byte> bytes) {
    core_.ingress(moment_of(stamp), place, Direction::kUp, bytes);
  });
  clients_.listen_to_newcomers();
  return count;
}

std::size_t Proxy::receive_strangers(int fd) noexcept {
  if (waiting_.full()) return 0;
  const std::size_t count = receive(fd);
  for (std::size_t i = 0; i < count; ++i) {
    if (in_.too_long(i)) {
      ++troubles_.too_long;
      continue;
    }
    const auto details = in_.details(i, Duration{});
    const auto place = client_of(i, details.local);
    if (!place) continue;
    if (waiting_.full()) {
      core_.ingress(moment_of(details.stamp), *place, Direction::kUp, in_.bytes(i));
    } else {
      waiting_.add(*place, details.stamp, in_.bytes(i));
    }
  }
  return count;
}

std::optional<std::uint32_t> Proxy::client_of(std::size_t message, const io::LocalAddress& local) noexcept {
  const io::PeerKey key = io::PeerKey::of(in_.from(message));
  auto found = clients_.find(key);
  if (!found) found = welcome(key, message, local);
  if (found) clients_[*found].last_seen = clients_[*found].last_heard = now_;
  return found;
}

std::optional<std::uint32_t> Proxy::welcome(const io::PeerKey& key, std::size_t message,
                                            const io::LocalAddress& local) noexcept {
  // A client that reconnects calls from a new port: commands and reports know it by its number.
  if (const auto back = clients_.silent_from(in_.from(message), now_ - kReconnects); back && clients_.move(*back, key, in_.from(message), local)) return back;
  if (core_.clients() == ProxyCore::kClientsMax) {
    ++troubles_.too_many_clients;
    return std::nullopt;
  }
  // Made beforehand by an ordinary thread; its memory goes back there.
  NewcomerPool::Newcomer* const made = newcomers_.next();
  const auto place = core_.add_client(made != nullptr ? &made->place : nullptr);
  std::unique_ptr<LinkWatch> watch = made != nullptr ? std::move(made->watch) : nullptr;
  if (made != nullptr) newcomers_.done(made);
  if (!clients_.welcome(*place, core_.clients_seen(), key, in_.from(message), local)) {
    core_.remove_client(*place);
    ++troubles_.other;
    return std::nullopt;
  }
  clients_[*place].came = now_;
  if (options_.watch_quality && watched_.size() < watched_.capacity()) {
    watched_.push_back({core_.clients_seen(), watch ? std::move(watch) : std::make_unique<LinkWatch>()});
    core_.watch(*place, watched_.back().watch.get());
  }
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    delays_[*place * kDirections + static_cast<std::size_t>(direction)].clear();
  }
  return place;
}

}  // namespace tandem::netsim
