#include "netsim/app/proxy.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>

#include "common/io/clock.h"
#include "common/io/udp_socket.h"

namespace tandem::netsim {
namespace {

constexpr std::uint64_t kListenEvent = ProxyCore::kClientsMax;
constexpr std::uint64_t kWakeEvent = kListenEvent + 1;
constexpr Duration kHousekeeping{200'000'000};
constexpr std::size_t kReportsMax = 1024;
static_assert(io::ReceiveBatch::kSlotBytes == kSlotBytes, "what can be received can be kept");
/// Batches read from one socket before others get their turn.
constexpr int kRounds = 4;

bool watch(int poll, int fd, std::uint64_t name) noexcept {
  epoll_event event{};
  event.events = EPOLLIN;
  event.data.u64 = name;
  return epoll_ctl(poll, EPOLL_CTL_ADD, fd, &event) == 0;
}

}  // namespace

std::expected<std::unique_ptr<Proxy>, std::string> Proxy::open(const ProxyOptions& options) {
  auto socket = io::bind_udp(options.listen, options.listen.any());
  if (!socket) return std::unexpected(socket.error());
  io::Fd poll{epoll_create1(EPOLL_CLOEXEC)};
  io::Fd wake{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
  if (!poll.open() || !wake.open() || !watch(poll.get(), socket->fd.get(), kListenEvent) ||
      !watch(poll.get(), wake.get(), kWakeEvent)) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return std::unique_ptr<Proxy>(
      new Proxy(options, std::move(socket->fd), std::move(poll), std::move(wake), socket->local));
}

Proxy::Proxy(const ProxyOptions& options, io::Fd socket, io::Fd poll, io::Fd wake, const io::SocketAddress& listening)
    : options_(options),
      socket_(std::move(socket)),
      poll_(std::move(poll)),
      wake_(std::move(wake)),
      listening_(listening),
      any_address_(options.listen.any()),
      core_(options.link, options.seed) {
  left_.reserve(kReportsMax);
}

void Proxy::stop() noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

void Proxy::run() {
  prctl(PR_SET_TIMERSLACK, 1UL);  // else the kernel may wake us 50 us late to save power
  started_ = io::read_clock(CLOCK_MONOTONIC);
  Duration housekeeping{};
  std::array<epoll_event, ProxyCore::kClientsMax + 2> events{};
  while (true) {
    now_ = io::read_clock(CLOCK_MONOTONIC) - started_;
    if (now_ >= housekeeping) {
      forget_idle();
      publish();
      housekeeping = now_ + kHousekeeping;
    }
    if (options_.duration > Duration::zero() && now_ >= options_.duration) break;
    const timespec timeout = io::to_timespec(wait_limit(now_));
    const int ready = epoll_pwait2(poll_.get(), events.data(), static_cast<int>(events.size()), &timeout, nullptr);
    bool stopping = false;
    for (int i = 0; i < ready; ++i) {
      const std::uint64_t name = events[static_cast<std::size_t>(i)].data.u64;
      if (name == kWakeEvent) {
        stopping = true;
      } else if (name == kListenEvent) {
        receive_from_clients();
      } else {
        receive_from_server(static_cast<std::uint32_t>(name));
      }
    }
    send_due();
    if (stopping) break;
  }
  publish();
}

Duration Proxy::wait_limit(Duration now) const noexcept {
  Duration limit = kHousekeeping;
  if (const auto due = core_.next_due()) limit = std::min(limit, due->time_since_epoch() - now);
  if (options_.duration > Duration::zero()) limit = std::min(limit, options_.duration - now);
  return std::max(limit, Duration::zero());
}

void Proxy::receive_from_clients() noexcept {
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(socket_.get());
    if (count <= 0) return;
    const Duration read_at = io::read_clock(CLOCK_REALTIME);
    now_ = io::read_clock(CLOCK_MONOTONIC) - started_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto details = in_.details(i, read_at);
      count_kernel_drops(kernel_drops_seen_, details.dropped);
      if (in_.too_long(i)) {
        ++troubles_.too_long;
        continue;
      }
      const auto client = client_of(i, details.local);
      if (!client) continue;
      core_.ingress(Time{now_ - details.age}, *client, Direction::kUp, in_.bytes(i));
    }
    send_due();
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
  }
}

void Proxy::receive_from_server(std::uint32_t client) noexcept {
  if (!present_[client]) return;
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(clients_[client].upstream.get());
    if (count < 0) {  // the server is not there (yet, or any more); it may come back
      ++(errno == ECONNREFUSED ? troubles_.refused : troubles_.other);
      continue;
    }
    if (count == 0) return;
    const Duration read_at = io::read_clock(CLOCK_REALTIME);
    now_ = io::read_clock(CLOCK_MONOTONIC) - started_;
    clients_[client].last_seen = now_;
    for (std::size_t i = 0; i < static_cast<std::size_t>(count); ++i) {
      const auto details = in_.details(i, read_at);
      count_kernel_drops(clients_[client].kernel_drops, details.dropped);
      if (in_.too_long(i)) {
        ++troubles_.too_long;
        continue;
      }
      core_.ingress(Time{now_ - details.age}, client, Direction::kDown, in_.bytes(i));
    }
    send_due();
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
  }
}

void Proxy::send_due() noexcept {
  std::array<ProxyCore::Egress, io::SendBatch::kMax> batch;
  while (true) {
    now_ = io::read_clock(CLOCK_MONOTONIC) - started_;
    std::size_t count = 0;
    while (count < batch.size()) {
      const auto egress = core_.take(Time{now_});
      if (!egress) break;
      batch[count++] = *egress;
    }
    if (count == 0) return;
    // One call for all answers, which leave by one socket; one call per client towards the server. A stable partition
    // keeps the order within each client and direction.
    const auto first = batch.begin();
    const auto last = first + static_cast<std::ptrdiff_t>(count);
    std::array<ProxyCore::Egress, io::SendBatch::kMax> group;
    std::array<bool, io::SendBatch::kMax> taken{};
    for (auto lead = first; lead != last; ++lead) {
      if (taken[static_cast<std::size_t>(lead - first)]) continue;
      std::size_t size = 0;
      for (auto other = lead; other != last; ++other) {
        const auto place = static_cast<std::size_t>(other - first);
        const bool same = lead->direction == Direction::kDown
                              ? other->direction == Direction::kDown
                              : other->direction == Direction::kUp && other->client == lead->client;
        if (taken[place] || !same) continue;
        taken[place] = true;
        group[size++] = *other;
      }
      const int fd = lead->direction == Direction::kDown ? socket_.get() : clients_[lead->client].upstream.get();
      flush(fd, {group.data(), size});
    }
    if (count < batch.size()) return;
  }
}

void Proxy::flush(int fd, std::span<const ProxyCore::Egress> sent) noexcept {
  out_.clear();
  for (const ProxyCore::Egress& egress : sent) {
    const Client& client = clients_[egress.client];
    const bool down = egress.direction == Direction::kDown;
    out_.add(egress.bytes, down ? &client.address : nullptr, down && any_address_ ? &client.local : nullptr);
  }
  const io::SendBatch::Result result = out_.send(fd);
  troubles_.refused += result.refused;
  troubles_.no_room += result.no_room;
  troubles_.other += result.other;
  const Duration sent_at = io::read_clock(CLOCK_MONOTONIC) - started_;
  for (const ProxyCore::Egress& egress : sent) {
    lateness_.add((sent_at - egress.item.at.time_since_epoch()).count());
    core_.done(egress);
  }
}

std::optional<std::uint32_t> Proxy::client_of(std::size_t message, const io::LocalAddress& local) noexcept {
  const io::PeerKey key = io::PeerKey::of(in_.from(message));
  std::optional<std::uint32_t> found;
  if (present_[last_client_] && keys_[last_client_] == key) {
    found = last_client_;
  } else {
    for (std::uint32_t i = 0; i < keys_.size() && !found; ++i) {
      if (present_[i] && keys_[i] == key) found = i;
    }
  }
  if (!found) found = welcome(key, message, local);
  if (found) {
    last_client_ = *found;
    clients_[*found].last_seen = now_;
  }
  return found;
}

std::optional<std::uint32_t> Proxy::welcome(const io::PeerKey& key, std::size_t message,
                                            const io::LocalAddress& local) noexcept {
  if (core_.clients() == ProxyCore::kClientsMax) {
    ++troubles_.too_many_clients;
    return std::nullopt;
  }
  io::Fd upstream{::socket(options_.to.family(), SOCK_DGRAM | SOCK_NONBLOCK | SOCK_CLOEXEC, 0)};
  if (!upstream.open() || ::connect(upstream.get(), options_.to.get(), options_.to.size) != 0) {
    ++troubles_.other;
    return std::nullopt;
  }
  io::ReceiveBatch::prepare(upstream.get(), options_.to.family(), false);
  const auto number = core_.add_client();
  if (!number || !watch(poll_.get(), upstream.get(), *number)) {
    if (number) core_.remove_client(*number);
    ++troubles_.other;
    return std::nullopt;
  }
  Client& client = clients_[*number];
  client.upstream = std::move(upstream);
  client.address.storage = in_.from(message);
  client.address.size = client.address.family() == AF_INET6 ? sizeof(sockaddr_in6) : sizeof(sockaddr_in);
  client.local = local;
  client.kernel_drops = 0;
  keys_[*number] = key;
  present_[*number] = true;
  return number;
}

void Proxy::forget_idle() noexcept {
  for (std::uint32_t i = 0; i < clients_.size(); ++i) {
    if (!present_[i] || now_ - clients_[i].last_seen < options_.idle_limit) continue;
    const bool under_way =
        core_.counters(i, Direction::kUp).in_flight() + core_.counters(i, Direction::kDown).in_flight() > 0;
    if (!under_way) forget(i);
  }
}

void Proxy::forget(std::uint32_t client) noexcept {
  if (left_.size() < kReportsMax) {
    left_.push_back({clients_[client].address.storage,
                     false,
                     {core_.counters(client, Direction::kUp), core_.counters(client, Direction::kDown)}});
  }
  core_.remove_client(client);
  clients_[client].upstream.reset();  // closing takes it out of epoll
  present_[client] = false;
}

void Proxy::count_kernel_drops(std::uint32_t& seen, std::uint32_t now) noexcept {
  if (now == 0) return;  // not told with this datagram
  troubles_.kernel_drops += now - seen;
  seen = now;
}

ProxyStatus Proxy::snapshot() const {
  return {now_,
          core_.clients(),
          core_.clients_seen(),
          {core_.total(Direction::kUp), core_.total(Direction::kDown)},
          troubles_};
}

void Proxy::publish() noexcept {
  // Whoever looks must not hold up the packets: then the next picture is the one they get.
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = snapshot();
}

ProxyStatus Proxy::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

std::vector<ProxyClientReport> Proxy::client_reports() const {
  std::vector<ProxyClientReport> reports = left_;
  for (std::uint32_t i = 0; i < clients_.size(); ++i) {
    if (!present_[i]) continue;
    reports.push_back(
        {clients_[i].address.storage, true, {core_.counters(i, Direction::kUp), core_.counters(i, Direction::kDown)}});
  }
  return reports;
}

}  // namespace tandem::netsim
