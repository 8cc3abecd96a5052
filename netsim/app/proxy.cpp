#include "netsim/app/proxy.h"

#include <sys/epoll.h>
#include <sys/eventfd.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <ctime>
#include <cstdlib>

#include "common/io/clock.h"

namespace tandem::netsim {
namespace {

constexpr Duration kHousekeeping{200'000'000};
/// Reading later than the moment of arrival is free as long as nothing can be due before; but the kernel's buffers hold a
/// limited number, and clients that just came wait for their sockets.
static const Duration kReadingMax{getenv("RM")?atoi(getenv("RM"))*1000:500000};
constexpr Duration kReadingMin{100'000};
/// After a round of sending the next begins so much later at the earliest: a wake-up costs more than sending a datagram,
/// and datagrams of many clients are due at any moment. Part of the reported lateness.
static const Duration kCoalesce{getenv("CO")?atoi(getenv("CO"))*1000:15000};
/// What is due so soon is waited for: going to sleep takes longer.
static const Duration kShorterThanSleep{getenv("SP")?atoi(getenv("SP"))*1000:3000};
constexpr Duration kNewcomersMax{10'000'000};
constexpr std::size_t kReportsMax = 1024;
constexpr int kRoundsOfSending = 8;
static_assert(io::ReceiveBatch::kSlotBytes == kSlotBytes, "what can be received can be kept");
static_assert(ProxyOutbox::kMax == io::SendBatch::kMax);

/// CLOCK_REALTIME less CLOCK_MONOTONIC: turns the kernel's stamps into the proxy's time. Read anew each round, as the
/// wall clock may be set; the reading in the middle must not be torn off by a pause of this thread.
Duration wall_ahead() noexcept {
  Duration ahead{};
  for (int i = 0; i < 3; ++i) {
    const Duration before = io::read_clock(CLOCK_MONOTONIC);
    const Duration wall = io::read_clock(CLOCK_REALTIME);
    const Duration after = io::read_clock(CLOCK_MONOTONIC);
    ahead = wall - (before + (after - before) / 2);
    if (after - before < Duration{2'000}) break;
  }
  return ahead;
}

}  // namespace

std::expected<std::unique_ptr<Proxy>, std::string> Proxy::open(const ProxyOptions& options) {
  auto clients = ProxyClients::open(options.listen, options.to);
  if (!clients) return std::unexpected(clients.error());
  io::Fd wake{eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)};
  io::Fd sleep{epoll_create1(EPOLL_CLOEXEC)};
  epoll_event event{};
  event.events = EPOLLIN;
  if (!wake.open() || !sleep.open() || !clients->watch(wake.get(), {ProxySource::Kind::kWake, 0}) ||
      epoll_ctl(sleep.get(), EPOLL_CTL_ADD, wake.get(), &event) != 0) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return std::unique_ptr<Proxy>(new Proxy(options, std::move(*clients), std::move(wake), std::move(sleep)));
}

Proxy::Proxy(const ProxyOptions& options, ProxyClients clients, io::Fd wake, io::Fd sleep)
    : options_(options),
      clients_(std::move(clients)),
      wake_(std::move(wake)),
      sleep_(std::move(sleep)),
      core_(options.link, options.seed),
      delays_(std::make_unique<DelayBins[]>(ProxyCore::kClientsMax * kDirections)) {
  left_.reserve(kReportsMax);
  plan_reading();
}

void Proxy::stop() noexcept {
  stopping_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(wake_.get(), &one, sizeof one);
}

Duration Proxy::since_start() const noexcept { return io::read_clock(CLOCK_MONOTONIC) - started_; }

void Proxy::run() {
  prctl(PR_SET_TIMERSLACK, 1UL);  // else the kernel may wake us 50 us late to save power
  started_ = io::read_clock(CLOCK_MONOTONIC);
  while (!stopping_.load(std::memory_order_acquire)) {
    now_ = since_start();
    if (now_ >= next_housekeeping_) housekeeping(now_);
    if (options_.duration > Duration::zero() && now_ >= options_.duration) break;
    work(now_);
  }
  now_ = since_start();
  publish();
}

void Proxy::housekeeping(Duration now) noexcept {
  forget_idle();
  publish();
  next_housekeeping_ = now + kHousekeeping;
}

void Proxy::work(Duration now) noexcept {
  Duration until = next_housekeeping_;
  if (options_.duration > Duration::zero()) until = std::min(until, options_.duration);
  const auto due = core_.next_due();
  if (due) until = std::min(until, std::max(due->time_since_epoch(), last_sent_ + kCoalesce));

  const bool lazy = busy_ && reading_interval_ > Duration::zero();
  if (!lazy) {
    const Duration wait = until - now <= std::max(options_.spin, kShorterThanSleep) ? Duration{} : until - now - options_.spin;
    if (read_ready(std::max(wait, Duration{})) > 0) busy_ = true;
  } else {
    // Another moment for reading is not worth a wake-up of its own.
    const bool read_too = until >= last_read_ + reading_interval_ / 2;
    until = std::min(until, last_read_ + reading_interval_);
    sleep_until(until);
    if (read_too) busy_ = read_ready(Duration{}) > 0 || due.has_value();
  }
  send_due();
}

void Proxy::sleep_until(Duration moment) const noexcept {
  const Duration spin = std::max(options_.spin, kShorterThanSleep);
  if (moment - since_start() > spin) {
    const timespec at = io::to_timespec(started_ + moment - options_.spin);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
  }
  while (since_start() < moment) {
  }
}

std::size_t Proxy::read_ready(Duration wait) noexcept {
  std::array<epoll_event, ProxyClients::kMax * 3 + 2> events;
  const timespec timeout = io::to_timespec(wait);
  const int ready =
      epoll_pwait2(clients_.poll_fd(), events.data(), static_cast<int>(events.size()), &timeout, nullptr);
  const Duration ahead = wall_ahead();
  now_ = since_start();
  last_read_ = now_;
  std::size_t count = 0, unsent = 0;
  for (int i = 0; i < ready; ++i) {
    const ProxySource source = ProxySource::of(events[static_cast<std::size_t>(i)].data.u64);
    if (source.kind == ProxySource::Kind::kWake) {
      std::uint64_t times = 0;
      [[maybe_unused]] const auto got = ::read(wake_.get(), &times, sizeof times);
      continue;
    }
    // One batch of each: whoever sends much waits for the others.
    const std::size_t got = read(source, ahead + started_);
    count += got;
    unsent += got;
    if (unsent >= io::ReceiveBatch::kMax / 2) {
      send_due();
      unsent = 0;
    }
  }
  if (clients_.newcomers() && now_ - newcomers_since_ >= kNewcomersMax) clients_.listen_to_newcomers();
  return count;
}

std::size_t Proxy::read(ProxySource source, Duration wall_at_start) noexcept {
  const int fd = clients_.fd_of(source);
  if (fd < 0) return 0;  // forgotten by an earlier event of this round
  const int received = in_.receive(fd);
  if (received <= 0) {
    if (received < 0) receive_error(source);
    return 0;
  }
  const auto count = static_cast<std::size_t>(received);
  const bool down = source.kind == ProxySource::Kind::kUpside || source.kind == ProxySource::Kind::kFormer;
  const Duration earliest = now_ - Duration{1'000'000'000};
  for (std::size_t i = 0; i < count; ++i) {
    const auto details = in_.details(i, Duration{});
    count_kernel_drops(source, details.dropped);
    if (in_.too_long(i)) {
      ++troubles_.too_long;
      continue;
    }
    // Whatever else may be wrong with a clock, nothing came before the last round by more than the buffers can hold.
    const Duration at = details.stamp == Duration{}
                            ? now_
                            : std::clamp(details.stamp - wall_at_start, earliest, now_ + Duration{1'000'000});
    if (down) {
      clients_[source.place].last_seen = now_;
      core_.ingress(Time{at}, source.place, Direction::kDown, in_.bytes(i));
    } else if (const auto place = client_of(i, details.local)) {
      core_.ingress(Time{at}, *place, Direction::kUp, in_.bytes(i));
    }
  }
  if (source.kind == ProxySource::Kind::kListen && count < io::ReceiveBatch::kMax && clients_.newcomers()) {
    clients_.listen_to_newcomers();
  }
  return count;
}

void Proxy::receive_error(ProxySource source) noexcept {
  // The other end is not there (yet, or any more); it may come back.
  static_cast<void>(source);
  ++(errno == ECONNREFUSED ? troubles_.refused : troubles_.other);
}

void Proxy::send_due() noexcept {
  for (int round = 0; round < kRoundsOfSending; ++round) {
    now_ = since_start();
    while (!outbox_.full()) {
      const auto egress = core_.take(Time{now_});
      if (!egress) break;
      outbox_.add(*egress);
    }
    if (outbox_.size() == 0) return;
    outbox_.empty(
        [this](const ProxyCore::Egress& egress) { out_.add(egress.bytes, nullptr, nullptr); },
        [this](const ProxyCore::Egress& lead, const ProxyOutbox& box, std::uint8_t first) {
          const bool down = lead.direction == Direction::kDown;
          const ProxyClients::Client& client = clients_[lead.client];
          const io::SendBatch::Result result = out_.send(down ? client.downside.get() : client.upside.get());
          troubles_.refused += result.refused;
          troubles_.no_room += result.no_room;
          troubles_.other += result.other;
          const Duration sent_at = since_start();
          DelayBins& delays = delays_[lead.client * kDirections + static_cast<std::size_t>(lead.direction)];
          box.again(first, [&](const ProxyCore::Egress& egress) {
            const Duration late = sent_at - egress.item.at.time_since_epoch();
            lateness_.add(late.count());
            late_ += late > options_.late_limit ? 1 : 0;
            ++released_;
            delays.add(sent_at - egress.item.sent.time_since_epoch());
            core_.done(egress);
          });
          last_sent_ = sent_at;
        });
  }
}

std::optional<std::uint32_t> Proxy::client_of(std::size_t message, const io::LocalAddress& local) noexcept {
  // Asked for datagrams of a client's own socket too: while it was being connected, others could get into it.
  const io::PeerKey key = io::PeerKey::of(in_.from(message));
  auto found = clients_.find(key);
  if (!found) found = welcome(key, message, local);
  if (found) clients_[*found].last_seen = now_;
  return found;
}

std::optional<std::uint32_t> Proxy::welcome(const io::PeerKey& key, std::size_t message,
                                            const io::LocalAddress& local) noexcept {
  const auto place = core_.add_client();
  if (!place) {
    ++troubles_.too_many_clients;
    return std::nullopt;
  }
  if (!clients_.welcome(*place, core_.clients_seen(), key, in_.from(message), local)) {
    core_.remove_client(*place);
    ++troubles_.other;
    return std::nullopt;
  }
  newcomers_since_ = now_;
  for (const Direction direction : {Direction::kUp, Direction::kDown}) {
    delays_[*place * kDirections + static_cast<std::size_t>(direction)].clear();
  }
  return place;
}

void Proxy::forget_idle() noexcept {
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (!clients_[i].present || now_ - clients_[i].last_seen < options_.idle_limit) continue;
    const bool under_way =
        core_.counters(i, Direction::kUp).in_flight() + core_.counters(i, Direction::kDown).in_flight() > 0;
    if (!under_way) forget(i);
  }
}

void Proxy::forget(std::uint32_t place) noexcept {
  if (left_.size() < kReportsMax) {
    left_.push_back(picture_of(place));
    left_.back().present = false;
  }
  core_.remove_client(place);
  clients_.forget(place);
}

void Proxy::count_kernel_drops(ProxySource source, std::uint32_t seen) noexcept {
  if (seen == 0) return;  // not told with this datagram
  if (source.kind == ProxySource::Kind::kListen) {
    troubles_.kernel_drops += seen - strangers_dropped_;
    strangers_dropped_ = seen;
    return;
  }
  ProxyClients::Client& client = clients_[source.place];
  std::uint32_t& before = client.drops_seen[static_cast<std::size_t>(source.kind) - 1];
  troubles_.kernel_drops += seen - before;
  client.kernel_drops += seen - before;
  before = seen;
}

ProxyClientStatus Proxy::picture_of(std::uint32_t place) const noexcept {
  const ProxyClients::Client& client = clients_[place];
  return {client.number,
          place,
          client.address.storage,
          client.present,
          client.kernel_drops,
          {core_.counters(place, Direction::kUp), core_.counters(place, Direction::kDown)}};
}

void Proxy::fill(ProxyStatus& status) const noexcept {
  status.since_start = now_;
  status.clients = 0;
  status.clients_seen = core_.clients_seen();
  status.total = {core_.total(Direction::kUp), core_.total(Direction::kDown)};
  status.troubles = troubles_;
  status.released = released_;
  status.late = late_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (clients_[i].present) status.client[status.clients++] = picture_of(i);
  }
}

ProxyStatus Proxy::final_status() const {
  ProxyStatus status;
  fill(status);
  return status;
}

void Proxy::publish() noexcept {
  // Whoever looks must not hold up the packets: then the next picture is the one they get.
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) fill(published_);
}

ProxyStatus Proxy::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

std::vector<ProxyClientStatus> Proxy::client_reports() const {
  std::vector<ProxyClientStatus> reports = left_;
  for (std::uint32_t i = 0; i < ProxyClients::kMax; ++i) {
    if (clients_[i].present) reports.push_back(picture_of(i));
  }
  return reports;
}

void Proxy::plan_reading() noexcept {
  const Duration least = std::min(options_.link.up.floor, options_.link.down.floor);
  const Duration interval = std::min(least / 2, kReadingMax);
  reading_interval_ = interval < kReadingMin ? Duration{} : interval;
}

}  // namespace tandem::netsim
