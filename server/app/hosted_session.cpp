#include "server/app/hosted_session.h"

#include <sys/eventfd.h>

#include "server/session_monitor.h"

namespace tandem::server {
namespace {

constexpr std::uint64_t kLookEvery = 64;  // ticks between two looks at one seat, and between two pictures

constexpr Duration kNeverEchoed = std::chrono::hours(1);  // what freshness says before the first echo is longer

double ms(Duration d) { return seconds(d) * 1e3; }

DirectionReport direction(const link::Link& receiver, Time now) {
  const link::LinkStats& s = receiver.stats();
  return {s.loss_percent(), ms(receiver.longest_gap(now)), ms(Duration{s.age.quantile(0.99)})};
}

}  // namespace

HostedSession::HostedSession(const SceneSpec& scene, Slaves slaves, std::uint8_t slot, TickQueue& records)
    : scene_(&scene), slot_(slot), session_(scene, std::move(slaves.devices), slaves.scale), records_(&records), over_event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {}

SessionStatus HostedSession::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

void HostedSession::tick(Time now, std::uint32_t missed, const MachineStatus& machine) noexcept {
  session_.on_tick(now, missed);
  while (const auto event = session_.poll_audit()) audit_.push(*event);
  SessionMonitor{}.check(session_, violations_);
  if (session_.record().running) records_->push(session_.record());
  // One seat at a time: quantiles of its histograms take microseconds, of all seats together they would be felt.
  const std::size_t seat = ticks_ % kLookEvery;
  if (seat < scene_->seats.size()) look_at_seat(seat, now);
  if (++ticks_ % kLookEvery == 0) publish(now, machine);
}

void HostedSession::finish(Time now, const MachineStatus& machine) noexcept {
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) look_at_seat(i, now);
  publish(now, machine);
  over_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(over_event_.get(), &one, sizeof one);
}

void HostedSession::look_at_seat(std::size_t i, Time now) noexcept {
  const SeatPort& port = session_.seat(i);
  const wire::StateMessage& heard = port.heard();
  SeatStatus& seat = picture_.seats[i];
  seat.taken = port.taken();
  seat.ever_taken = seat.ever_taken || seat.taken;
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
    const Duration age = link->freshness().loop_age(now);
    seat.loop_age_s = age < kNeverEchoed ? seconds(age) : 0;
    seat.accepted = link->stats().accepted;
    seat.late = link->stats().late;
    seat.lost = link->stats().lost();
    seat.refused = link->stats().refused;
  }
}

void HostedSession::publish(Time now, const MachineStatus& machine) noexcept {
  picture_.state = session_.state();
  picture_.time = session_.time();
  picture_.machine = machine;
  picture_.stray = session_.stray();
  picture_.violations = violations_.passed() ? 0 : 1;
  // Quick truths are looked up for all seats at once, so that a line never mixes old and new.
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    SeatStatus& seat = picture_.seats[i];
    seat.taken = session_.seat(i).taken();
    seat.alive = session_.seat(i).alive(now);
    seat.ready = session_.seat(i).ready(now);
  }
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = picture_;
}

}  // namespace tandem::server
