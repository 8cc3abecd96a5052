#include "netsim/proxy/app/proxy.h"

#include <sys/epoll.h>
#include <sys/prctl.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cstring>
#include <utility>

#include "common/io/clock.h"

namespace tandem::netsim {
namespace {

constexpr int kRoundsOfSending = 8;
constexpr Duration kMaintenanceInterval{200'000'000};

}  // namespace

std::expected<std::unique_ptr<Proxy>, std::string> Proxy::open(const ProxyOptions& options) {
  auto clients = ProxyClients::open(options.listen, options.to);
  if (!clients) return std::unexpected(clients.error());
  std::unique_ptr<Proxy> proxy{new Proxy(options, std::move(*clients))};
  if (!proxy->inbox_.open() || !proxy->clients_.watch(proxy->inbox_.fd(), {ProxySource::Kind::kWake, 0})) {
    return std::unexpected(std::string("the system gives no file descriptors: ") + std::strerror(errno));
  }
  return proxy;
}

Proxy::Proxy(const ProxyOptions& options, ProxyClients clients)
    : options_(options),
      clients_(std::move(clients)),
      core_(options.link, options.seed, options.events),
      registry_(core_, clients_, delays_, errors_, options),
      receiver_(core_, clients_, registry_, clock_, errors_),
      sender_(core_, clients_, clock_, delays_, errors_, options.late_limit) {
  core_.log_to(options.sink);
  reading_interval_.add(options.link);
  for (const NetworkEvent& event : options.events) {
    if (event.link) reading_interval_.add(*event.link);
  }
}

void Proxy::run() {
  prctl(PR_SET_TIMERSLACK, 1UL);  // otherwise the kernel may wake this thread 50 us late to save power
  clock_.start();
  while (!inbox_.stopping()) {
    now_ = clock_.now();
    if (now_ >= next_maintenance_) {
      registry_.maintain(now_);
      publish();
      next_maintenance_ = now_ + kMaintenanceInterval;
    }
    if (options_.duration > Duration::zero() && now_ >= options_.duration) break;
    process_requests();
    run_round();
  }
  now_ = clock_.now();
  publish();
}

void Proxy::run_round() noexcept {
  Duration until = next_maintenance_;
  if (options_.duration > Duration::zero()) until = std::min(until, options_.duration);
  const auto due = core_.next_due();
  if (due) until = std::min(until, std::max(due->time_since_epoch(), sender_.last_sent() + options_.coalesce));

  // A datagram still here after the last sending waits for the arrivals up to its due time; only reading provides them.
  const bool waits_for_arrivals = due && due->time_since_epoch() <= tried_until_;
  const Duration interval = reading_interval_.value();
  if (!busy_ || interval == Duration::zero() || waits_for_arrivals) {
    const Duration left = until - now_;
    const bool awake = left <= std::max(options_.spin, ProxyClock::kShorterThanSleep);
    busy_ = read_ready(awake ? Duration{} : left - options_.spin) > 0 || due.has_value();
  } else {
    const Duration reading = last_read_ + interval;
    until = std::min(until, reading);
    clock_.wait_until(until, options_.spin);
    // A read at any other time is not worth a separate wake-up.
    if (until >= reading - interval / 2) busy_ = read_ready(Duration{}) > 0 || due.has_value();
  }
  send_due();
}

std::size_t Proxy::read_ready(Duration wait) noexcept {
  std::array<epoll_event, ProxyClients::kMax * 3 + 2> events;
  const timespec timeout = io::to_timespec(wait);
  const Duration asked = clock_.now();
  const int ready = epoll_pwait2(clients_.poll_fd(), events.data(), static_cast<int>(events.size()), &timeout, nullptr);
  if (ready > 0) clock_.update_wall_clock();
  now_ = clock_.now();
  last_read_ = now_;
  bool all = true;
  std::size_t count = 0, unsent = 0;
  for (int i = 0; i < ready; ++i) {
    const ProxySource source = ProxySource::of(events[static_cast<std::size_t>(i)].data.u64);
    if (source.kind == ProxySource::Kind::kWake) {
      inbox_.clear();
      continue;
    }
    // One batch per source: a client with heavy traffic waits for the others.
    const std::size_t got = receiver_.read(source, now_);
    all = all && got < io::ReceiveBatch::kMax;
    count += got;
    unsent += got;
    if (unsent >= io::ReceiveBatch::kMax / 2) {
      send_due();
      unsent = 0;
    }
  }
  if (all) read_until_ = asked;
  return count;
}

void Proxy::send_due() noexcept {
  for (int round = 0; round < kRoundsOfSending; ++round) {
    now_ = clock_.now();
    bool any = false;
    while (!sender_.full()) {
      const auto egress = core_.take(Time{now_}, Time{std::min(read_until_, now_)});
      if (!egress) break;
      sender_.add(*egress);
      any = true;
    }
    if (!any) {
      tried_until_ = now_;
      return;
    }
    sender_.flush();
  }
}

bool Proxy::post(ProxyRequest& request) noexcept {
  std::vector<LinkSpec> for_new;  // copied before posting; afterwards the packet thread owns the request
  for (const LinkChange& change : request.changes) {
    if (change.for_new) for_new.push_back(*change.for_new);
  }
  if (!inbox_.post(request)) return false;
  for (const LinkSpec& link : for_new) pool().set_next_link(link);
  return true;
}

void Proxy::process_requests() noexcept {
  if (inbox_.empty()) return;
  // Datagrams that arrived before the request still use the previous network.
  [[maybe_unused]] const std::size_t count = read_ready(Duration{});
  while (!inbox_.empty()) {
    ProxyRequest& request = inbox_.take();
    execute(request);
    request.done.store(true, std::memory_order_release);
  }
}

void Proxy::execute(ProxyRequest& request) noexcept {
  request.at = now_;
  for (LinkChange& change : request.changes) {
    core_.change(Time{now_}, change);
    reading_interval_.add(change.link);
  }
  pool().drop_outdated();
  for (const std::uint64_t number : request.rebinds) {
    bool found = false;
    for (std::uint32_t place = 0; place < ProxyClients::kMax; ++place) {
      if (core_.clients().number(place) == number) found = core_.rebind(Time{now_}, place, request.rebind);
    }
    request.succeeded = request.succeeded && found;
  }
}

void Proxy::fill(ProxyStatus& status) const noexcept {
  status.since_start = now_;
  status.total = {core_.total(Direction::kUp), core_.total(Direction::kDown)};
  status.errors = errors_;
  status.released = sender_.released();
  status.late = sender_.late();
  registry_.fill(status, now_);
}

ProxyStatus Proxy::final_status() const {
  ProxyStatus status;
  fill(status);
  return status;
}

void Proxy::publish() noexcept {
  // A reading thread must not delay packets. If the lock is taken, this update is skipped.
  published_.update([this](ProxyStatus& status) { fill(status); });
}

ProxyStatus Proxy::status() const { return published_.read(); }

}  // namespace tandem::netsim
