#include "server/app/shard.h"

#include <poll.h>
#include <sys/eventfd.h>

#include <algorithm>

#include "common/io/clock.h"
#include "common/io/realtime.h"
#include "server/app/endpoints.h"
#include "server/session_monitor.h"

namespace tandem::server {
namespace {

using namespace std::chrono_literals;

constexpr int kPriority = 70;  // above the devices' threads: one late server is late for everybody
constexpr Duration kLate = 1ms;
constexpr int kRounds = 4;  // batches read before the clock is looked at again: a flood cannot stop the tick
constexpr std::uint64_t kLookEvery = 64;  // ticks between two looks at one seat, and between two pictures

double ms(Duration d) { return seconds(d) * 1e3; }

DirectionReport direction(const link::Link& receiver, Time now) {
  const link::LinkStats& s = receiver.stats();
  return {s.loss_percent(), ms(receiver.longest_gap(now)), ms(Duration{s.age.quantile(0.99)})};
}

void raise(const io::Fd& event) noexcept {
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(event.get(), &one, sizeof one);
}

}  // namespace

Shard::Shard(io::UdpSocket socket, const SceneSpec& scene, Slaves slaves, std::uint64_t secret, TickQueue& records)
    : socket_(std::move(socket)),
      wake_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      finished_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      scene_(&scene),
      period_(from_seconds(1.0 / scene.tick_hz)),
      session_(scene, std::move(slaves.devices), slaves.scale, secret),
      records_(&records) {}

void Shard::stop() noexcept {
  stop_.store(true, std::memory_order_relaxed);
  raise(wake_);
}

SessionStatus Shard::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

void Shard::run() noexcept {
  picture_.machine.realtime = io::ask_for_realtime(kPriority);
  Time due = io::monotonic_now() + period_;
  while (!session_.over()) {
    wait_until(due);
    Time now = io::monotonic_now();
    receive(now);
    now = io::monotonic_now();
    if (stop_.load(std::memory_order_relaxed)) session_.stop(wire::CloseReason::kServerStops);
    if (now < due) continue;
    const Duration late = now - due;
    const auto missed = static_cast<std::uint32_t>(late / period_);
    picture_.machine.late_ticks += late > kLate ? 1 : 0;
    picture_.machine.missed_ticks += missed;
    tick(now, missed);
    due += (missed + 1) * period_;
  }
  const Time now = io::monotonic_now();
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) look_at_seat(i, now);
  publish(now);
  raise(finished_);
}

/// Returns early when datagrams wait or somebody called `stop`.
void Shard::wait_until(Time due) noexcept {
  pollfd files[] = {{socket_.fd.get(), POLLIN, 0}, {wake_.get(), POLLIN, 0}};
  // Once told to stop there is nothing more to hear there, and the event stays readable.
  const nfds_t count = stop_.load(std::memory_order_relaxed) ? 1 : 2;
  const timespec rest = io::to_timespec(due - io::monotonic_now());
  ppoll(files, count, &rest, nullptr);
}

void Shard::receive(Time now) noexcept {
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(socket_.fd.get());
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!in_.too_long(i)) session_.on_datagram(now, endpoint_of(in_.from(i)), in_.bytes(i));
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
  }
}

void Shard::tick(Time now, std::uint32_t missed) noexcept {
  session_.on_tick(now, missed);
  send(now);
  SessionMonitor{}.check(session_, violations_);
  if (session_.record().running) records_->push(session_.record());
  // One seat at a time: quantiles of its histograms take microseconds, of all seats together they would be felt.
  const std::size_t seat = ticks_ % kLookEvery;
  if (seat < scene_->seats.size()) look_at_seat(seat, now);
  if (++ticks_ % kLookEvery == 0) publish(now);
}

void Shard::send(Time now) noexcept {
  while (true) {
    while (out_.size() < kSendMax) {
      const std::size_t slot = out_.size();
      const auto due = session_.poll_transmit(now, buffers_[slot]);
      if (!due) break;
      addresses_[slot] = address_of(due->to);
      out_.add(std::span{buffers_[slot]}.first(due->size), &addresses_[slot], nullptr);
    }
    const bool full = out_.size() == kSendMax;
    if (out_.size() > 0) out_.send(socket_.fd.get());  // what cannot be sent is lost, as on any network
    if (!full) return;
  }
}

void Shard::look_at_seat(std::size_t i, Time now) noexcept {
  const SeatPort& port = session_.seat(i);
  const wire::StateMessage& heard = port.heard();
  SeatStatus& seat = picture_.seats[i];
  seat.bound = port.bound();
  seat.ever_bound = seat.ever_bound || seat.bound;
  seat.alive = port.alive(now);
  seat.ready = port.ready(now);
  seat.gate = heard.gate;
  seat.alpha = session_.record().seats[i].alpha;
  seat.margin_j = heard.telemetry.margin_min_j;
  seat.gate_trips = heard.gate_trips;
  seat.late_ticks = heard.late_ticks;
  seat.link.down = {heard.telemetry.down_loss_percent, heard.telemetry.down_longest_gap_ms,
                    heard.telemetry.down_age_p99_ms};
  if (const link::Link* link = port.link()) {  // of a seat that left, the last numbers stay
    seat.link.rtt_p50_ms = ms(link->freshness().rtt_p50());
    seat.link.rtt_p99_ms = ms(Duration{link->freshness().rtts().quantile(0.99)});
    seat.link.up = direction(*link, now);
  }
}

void Shard::publish(Time now) noexcept {
  picture_.state = session_.state();
  picture_.time = session_.time();
  // Quick truths are looked up for all seats at once, so that a line never mixes old and new.
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    SeatStatus& seat = picture_.seats[i];
    seat.bound = session_.seat(i).bound();
    seat.alive = session_.seat(i).alive(now);
    seat.ready = session_.seat(i).ready(now);
  }
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = picture_;
}

}  // namespace tandem::server
