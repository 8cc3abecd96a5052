#include "netsim/proxy/app/proxy.h"

#include <sys/epoll.h>
#include <sys/prctl.h>

#include <algorithm>
#include <cerrno>
#include <ctime>

#include "common/io/clock.h"

namespace tandem::netsim {
namespace {

/// Deadlines closer than this are busy-waited, because going to sleep takes longer.
constexpr Duration kShorterThanSleep{3'000};
constexpr int kRoundsOfSending = 8;
static_assert(SendQueue::kMax == io::SendBatch::kMax);

/// Returns CLOCK_REALTIME minus CLOCK_MONOTONIC, which converts kernel stamps to the proxy's time. It is read in each
/// round because the wall clock may be set. Up to three attempts avoid a reading distorted by a pause of this thread.
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

Duration Proxy::since_start() const noexcept {
  return io::read_clock(CLOCK_MONOTONIC) - started_.load(std::memory_order_relaxed);
}

void Proxy::run() {
  prctl(PR_SET_TIMERSLACK, 1UL);  // otherwise the kernel may wake this thread 50 us late to save power
  started_ = io::read_clock(CLOCK_MONOTONIC);
  while (!stopping_.load(std::memory_order_acquire)) {
    now_ = since_start();
    if (now_ >= next_maintenance_) maintain(now_);
    if (options_.duration > Duration::zero() && now_ >= options_.duration) break;
    process_requests();
    work(now_);
  }
  now_ = since_start();
  publish();
}

void Proxy::work(Duration now) noexcept {
  Duration until = next_maintenance_;
  if (options_.duration > Duration::zero()) until = std::min(until, options_.duration);
  const auto due = core_.next_due();
  if (due) until = std::min(until, std::max(due->time_since_epoch(), last_sent_ + options_.coalesce));

  // A datagram still here after the last sending waits for the arrivals up to its due time; only reading provides them.
  const bool waits_for_news = due && due->time_since_epoch() <= tried_until_;
  if (!busy_ || reading_interval_ == Duration::zero() || waits_for_news) {
    const Duration left = until - now;
    const bool awake = left <= std::max(options_.spin, kShorterThanSleep);
    busy_ = read_ready(awake ? Duration{} : left - options_.spin) > 0 || due.has_value();
  } else {
    const Duration reading = last_read_ + reading_interval_;
    until = std::min(until, reading);
    sleep_until(until);
    // A read at any other time is not worth a separate wake-up.
    if (until >= reading - reading_interval_ / 2) busy_ = read_ready(Duration{}) > 0 || due.has_value();
  }
  send_due();
}

void Proxy::sleep_until(Duration moment) const noexcept {
  const Duration spin = std::max(options_.spin, kShorterThanSleep);
  if (moment - since_start() > spin) {
    const timespec at = io::to_timespec(started_.load(std::memory_order_relaxed) + moment - options_.spin);
    clock_nanosleep(CLOCK_MONOTONIC, TIMER_ABSTIME, &at, nullptr);
  }
  while (since_start() < moment) {
  }
}

std::size_t Proxy::read_ready(Duration wait) noexcept {
  std::array<epoll_event, ProxyClients::kMax * 3 + 2> events;
  const timespec timeout = io::to_timespec(wait);
  const Duration asked = since_start();
  const int ready = epoll_pwait2(clients_.poll_fd(), events.data(), static_cast<int>(events.size()), &timeout, nullptr);
  if (ready > 0) wall_at_start_ = wall_ahead() + started_.load(std::memory_order_relaxed);
  now_ = since_start();
  last_read_ = now_;
  bool all = true;
  std::size_t count = 0, unsent = 0;
  for (int i = 0; i < ready; ++i) {
    const ProxySource source = ProxySource::of(events[static_cast<std::size_t>(i)].data.u64);
    if (source.kind == ProxySource::Kind::kWake) {
      std::uint64_t times = 0;
      [[maybe_unused]] const auto got = ::read(wake_.get(), &times, sizeof times);
      continue;
    }
    // One batch per source: a client with heavy traffic waits for the others.
    const std::size_t got = read(source);
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
    now_ = since_start();
    bool any = false;
    while (!send_queue_.full()) {
      const auto egress = core_.take(Time{now_}, Time{std::min(read_until_, now_)});
      if (!egress) break;
      const ProxySource through = egress_socket(*egress);
      send_queue_.add(*egress, through);
      any = true;
    }
    if (!any) {
      tried_until_ = now_;
      return;
    }
    flush_send_queue();
  }
}

ProxySource Proxy::egress_socket(const ProxyCore::Egress& egress) noexcept {
  using Kind = ProxySource::Kind;
  if (egress.direction == Direction::kDown) return {Kind::kDownside, egress.client};
  const ProxyClients::Client& client = clients_[egress.client];
  if (egress.address > client.address_number) {
    flush_send_queue();  // queued datagrams leave from the previous address
    if (!clients_.change_address(egress.client, egress.address)) ++errors_.other;
  }
  const bool late = egress.address < client.address_number && client.former.open();
  return {late ? Kind::kFormer : Kind::kUpside, egress.client};
}

void Proxy::flush_send_queue() noexcept {
  send_queue_.empty([this](const SendQueue::Group& group) {
    group.for_each([this](const ProxyCore::Egress& egress) { out_.add(egress.bytes, nullptr, nullptr); });
    const io::SendBatch::Result result = out_.send(clients_.fd_of(group.through));
    errors_.refused += result.refused;
    errors_.no_room += result.no_room;
    errors_.other += result.other;
    const Duration sent_at = since_start();
    const auto direction = group.through.kind == ProxySource::Kind::kDownside ? Direction::kDown : Direction::kUp;
    LiveDelayHistogram& delays = delays_[group.through.place * kDirections + static_cast<std::size_t>(direction)];
    group.for_each([&](const ProxyCore::Egress& egress) {
      const Duration late = sent_at - egress.item.at.time_since_epoch();
      lateness_.add(late.count());
      live_lateness_.add(late);
      late_ += late > options_.late_limit ? 1 : 0;
      ++released_;
      delays.add(sent_at - egress.item.sent.time_since_epoch());
      core_.done(egress);
    });
    last_sent_ = sent_at;
  });
}

}  // namespace tandem::netsim
