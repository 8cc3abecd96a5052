#include "server/app/shard.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/endpoints.h"
#include "server/connection_id.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 70;  // above the devices' threads: one late server is late for everybody
constexpr Duration kLate = 1ms;
/// Without real-time priority a busy machine is 5 ms late all the time, and the kernel promised nothing: there lateness counts a quarter, so
/// that hands are let go for 20 ms three times in a row, which is when their own gates let go as well.
constexpr int kLateUnpromised = 4;
constexpr Duration kReadingMax = 200us;  // then the tick goes on: a flood cannot stop it
constexpr std::size_t kOrdersMax = 256;
constexpr std::uint64_t kLoadTicks = 1000;

void raise(const io::Fd& event) noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event.get(), &one, sizeof one);
}
void lower(const io::Fd& event) noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(event.get(), &count, sizeof count);
}

}  // namespace

Shard::Shard(io::UdpSocket socket, double tick_hz)
    : socket_(std::move(socket)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      news_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      period_(from_seconds(1.0 / tick_hz)),
      orders_(kOrdersMax),
      answers_(2 * kOrdersMax),
      ladder_(period_) {}

bool Shard::host(HostedSession& session) noexcept {
  HostedSession*& place = sessions_[session.slot()];
  if (place != nullptr) return false;
  place = &session;
  return true;
}

void Shard::stop(wire::CloseReason why) noexcept {
  stop_reason_.store(why, std::memory_order_relaxed);
  stop_.store(true, std::memory_order_release);
  raise(wake_);
}

bool Shard::post(Order& order) noexcept {
  if (!orders_.push(&order)) return false;
  raise(wake_);
  return true;
}

Order* Shard::answered() noexcept {
  Order* const* const next = answers_.front();
  if (next == nullptr) return nullptr;
  Order* const order = *next;
  answers_.pop();
  return order;
}

void Shard::news_read() noexcept { lower(news_); }

void Shard::run() noexcept {
  machine_.realtime = io::ask_for_realtime(kPriority);
  Time due = io::monotonic_now() + period_;
  const auto hosting = [&] { return std::ranges::any_of(sessions_, [](const HostedSession* s) { return s != nullptr; }); };
  while (true) {
    wait_until(due);
    carry_out(io::monotonic_now());
    if (stop_.load(std::memory_order_acquire)) {
      if (!hosting()) break;
      for (HostedSession* s : sessions_)
        if (s != nullptr) s->session().stop(stop_reason_.load(std::memory_order_relaxed));
    }
    Time now = io::monotonic_now();
    if (now < due) continue;
    receive();
    now = io::monotonic_now();
    const Duration late = now - due;
    const auto missed = static_cast<std::uint32_t>(late / period_);
    lateness_.add(std::max(late, Duration::zero()));
    if (hosting()) {
      if (late > kLate) late_.fetch_add(1, std::memory_order_relaxed);
      machine_.late_ticks += late > kLate ? 1 : 0;
      machine_.missed_ticks += missed;
    }
    weigh(now, late);
    const Duration before = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    tick(now, missed);
    const Duration used = io::read_clock(CLOCK_THREAD_CPUTIME_ID);
    used_ = used - before;
    measure(used_);
    measure_core(now, used);
    turned_.store(now.time_since_epoch().count(), std::memory_order_relaxed);
    due += (missed + 1) * period_;
  }
  carry_out(io::monotonic_now());  // who still waits is told that it is over
  raise(news_);
}

/// Returns early when somebody wants something. Datagrams wait for the tick: nobody needs them before, and to wake up for each would
/// cost twice the processor's time. When they came the kernel has noted.
void Shard::wait_until(Time due) noexcept {
  pollfd wake{wake_.get(), POLLIN, 0};
  const timespec rest = io::to_timespec(due - io::monotonic_now());
  ppoll(&wake, 1, &rest, nullptr);
  if (wake.revents != 0) lower(wake_);
}

void Shard::receive() noexcept {
  std::uint64_t strays = 0;
  const Time began = io::monotonic_now();
  for (Time now = began; now - began < kReadingMax; now = io::monotonic_now()) {
    const int count = in_.receive(socket_.fd.get());
    const Duration wall = io::read_clock(CLOCK_REALTIME);
    const Time read = io::monotonic_now();  // the same moment on our clock
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      const auto header = in_.too_long(i) ? std::nullopt : link::read_header(in_.bytes(i));
      const std::size_t slot = header ? slot_of(header->cid) : kSessionsMax;
      if (slot < kSessionsMax && sessions_[slot] != nullptr) {
        // What was not there at the last reading came later, whatever somebody does to the wall clock.
        const Time came = std::max(read - in_.details(i, wall).age, read_until_);
        sessions_[slot]->session().on_datagram(came, endpoint_of(in_.from(i)), in_.bytes(i));
      } else {
        ++strays;
      }
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) {
      read_until_ = now;
      break;
    }
  }
  if (strays > 0) stray_.fetch_add(strays, std::memory_order_relaxed);
}

void Shard::carry_out(Time now) noexcept {
  bool any = false;
  for (Order* const* next = orders_.front(); next != nullptr; next = orders_.front()) {
    Order* const order = *next;
    orders_.pop();
    carry_out(now, *order);
    any = answers_.push(order) || any;
  }
  if (any) raise(news_);
}

void Shard::carry_out(Time now, Order& order) noexcept {
  HostedSession* const hosted = order.session;
  HostedSession*& place = sessions_[hosted->slot()];
  const bool stopping = stop_.load(std::memory_order_relaxed);
  if (order.what == Order::What::kHost) {
    order.result = stopping || place != nullptr ? JoinResult::kSessionOver : JoinResult::kAccepted;
    if (order.result == JoinResult::kAccepted) place = hosted;
    return;
  }
  order.result = JoinResult::kSessionOver;
  if (place != hosted) return;
  switch (order.what) {
    case Order::What::kAsk:
      order.result = hosted->session().may_admit(now, order.seat, order.same_owner);
      if (order.result == JoinResult::kAccepted) {
        const SeatPort& seat = hosted->session().seat(order.seat);
        order.silence = seat.taken() ? seat.silence(now) : Duration::zero();
        order.spoken = seat.alive_once();
      }
      break;
    case Order::What::kAdmit:
      order.result = hosted->session().admit(now, order.seat, order.entry, order.same_owner);
      break;
    case Order::What::kVisit:
      order.result = hosted->session().admit_visitor(now, order.entry.link, &order.place);
      break;
    case Order::What::kCommand:
      order.outcome = tandem::server::carry_out(hosted->session(), now, order.command);
      order.result = JoinResult::kAccepted;
      break;
    case Order::What::kMayVisit:
      order.place = hosted->session().visitors_free(now);
      order.result = JoinResult::kAccepted;
      break;
    case Order::What::kDismissVisitor:
      static_cast<void>(hosted->session().dismiss_visitor(order.place, order.cid, wire::CloseReason::kRevoked));
      break;
    case Order::What::kEnd:
      hosted->session().stop(wire::CloseReason::kServerStops);
      order.result = JoinResult::kAccepted;
      break;
    case Order::What::kHost:
      break;
  }
}

void Shard::tick(Time now, std::uint32_t missed) noexcept {
  bool ended = false;
  for (HostedSession*& hosted : sessions_) {
    if (hosted == nullptr) continue;
    hosted->tick(now, missed, machine_);
    send(now, hosted->session());
    if (!hosted->session().over()) continue;
    hosted->finish(now, machine_);
    hosted = nullptr;
    ended = true;
  }
  flush();
  if (ended) raise(news_);
}

void Shard::send(Time now, Session& session) noexcept {
  while (true) {
    const std::size_t slot = out_.size();
    const auto due = session.poll_transmit(now, buffers_[slot]);
    if (!due) return;
    addresses_[slot] = address_of(due->to);
    out_.add(std::span{buffers_[slot]}.first(due->size), &addresses_[slot], nullptr);
    if (out_.size() == kSendMax) flush();
  }
}

void Shard::flush() noexcept {
  if (out_.size() > 0) out_.send(socket_.fd.get());  // what cannot be sent is lost, as on any network
}

void Shard::weigh(Time now, Duration late) noexcept {
  machine_.relief = ladder_.step(now, machine_.realtime ? late : late / kLateUnpromised, used_);
  rung_.store(machine_.relief.rung, std::memory_order_relaxed);
  passive_.store(machine_.relief.passive, std::memory_order_relaxed);
}

void Shard::measure(Duration spent) noexcept {
  spent_.add(spent.count());
  lengths_.add(spent);
  if (spent_.count() < kLoadTicks) return;
  load_.store(static_cast<double>(spent_.quantile(0.99)) / static_cast<double>(period_.count()), std::memory_order_relaxed);
  spent_ = Histogram{};
}

void Shard::measure_core(Time now, Duration used) noexcept {
  if (core_since_ != Time{} && now - core_since_ < 1s) return;
  if (core_since_ != Time{}) core_.store(seconds(used - core_used_) / seconds(now - core_since_), std::memory_order_relaxed);
  core_since_ = now;
  core_used_ = used;
}

}  // namespace tandem::server
