#include "server/app/hosted_session.h"

#include <sys/eventfd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "common/trust/io/state_folder.h"
#include "server/session_monitor.h"

namespace tandem::server {
namespace {

constexpr std::uint64_t kLookEvery = 64;  // ticks between two looks at one seat, and between two pictures
constexpr std::uint64_t kLookSeldom = 4 * kLookEvery, kRecordSeldom = 10;  // from Rung::kTelemetry on

constexpr Duration kNeverEchoed = std::chrono::hours(1);  // what freshness says before the first echo is longer

constexpr double kKeptEvery = 0.5;  // [s]
constexpr int kLastTries = 1000;     // to lay down what nothing newer will follow; each fails only while a copy is taken

/// Whether a restart would go on otherwise than before it.
constexpr bool moves_checkpoint(AuditEvent::What what) noexcept {
  using What = AuditEvent::What;
  return what == What::kJoin || what == What::kLeave || what == What::kAuthority || what == What::kStop || what == What::kPause || what == What::kResume ||
         what == What::kFault || what == What::kRestored || what == What::kGathered || what == What::kRemoved || what == What::kAuthorityCalledOff;
}

double ms(Duration d) { return seconds(d) * 1e3; }

DirectionReport direction(const link::Link& receiver, Time now) {
  const link::LinkStats& s = receiver.stats();
  return {s.loss_percent(), ms(receiver.longest_gap(now)), ms(Duration{s.age.quantile(0.99)})};
}

}  // namespace

HostedSession::HostedSession(const SceneSpec& scene, Slaves slaves, std::uint8_t slot, TickQueue& records, const Checkpoint* from)
    : scene_(&scene),
      slot_(slot),
      session_(from == nullptr ? Session(scene, std::move(slaves.devices), slaves.scale) : Session(scene, std::move(slaves.devices), slaves.scale, *from)),
      records_(&records),
      over_event_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
  draw_path_tokens();
}

/// From the kernel: nobody can know a token but whoever reads the address it is sent to.
void HostedSession::draw_path_tokens() noexcept {
  PathTokens& tokens = session_.path_tokens();
  std::array<std::uint64_t, PathTokens::kMax> drawn;
  const auto wanted = std::span{drawn}.first(tokens.room());
  trust::fill_random(std::as_writable_bytes(wanted));
  for (const std::uint64_t token : wanted) tokens.add(token);
}

void HostedSession::keep_in(std::shared_ptr<CheckpointMail> mail, std::uint64_t epoch) {
  mail_ = std::move(mail);
  epoch_ = epoch;
  kept_every_ = static_cast<std::uint64_t>(std::lround(kKeptEvery * scene_->tick_hz));
}

SessionStatus HostedSession::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

void HostedSession::tick(Time now, std::uint32_t missed, const MachineStatus& machine) noexcept {
  session_.relieve(machine.relief);
  session_.on_tick(now, missed);
  while (const auto event = session_.poll_audit()) {
    audit_.push(*event);
    keep_now_ = keep_now_ || moves_checkpoint(event->what);
  }
  keep_now_ = keep_now_ || session_.begun() != std::exchange(begun_, session_.begun());
  if (session_.path_tokens().low()) draw_path_tokens();
  if (mail_ && (keep_now_ || ++since_kept_ >= kept_every_)) lay_down_checkpoint();
  SessionMonitor{}.check(session_, violations_);
  const bool seldom = machine.relief.rung >= Rung::kTelemetry;
  if (session_.record().running) {
    if (++unrecorded_ >= (seldom ? kRecordSeldom : 1)) {
      records_->push(session_.record());
      unrecorded_ = 0;
    } else {
      ++spared_;
    }
  }
  // One seat at a time: quantiles of its histograms take microseconds, of all seats together they would be felt.
  const std::uint64_t every = seldom ? kLookSeldom : kLookEvery;
  const std::size_t seat = ticks_ % every;
  if (seat < scene_->seats.size()) look_at_seat(seat, now);
  if (++ticks_ % every == 0) publish(now, machine);
}

void HostedSession::finish(Time now, const MachineStatus& machine) noexcept {
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) look_at_seat(i, now);
  publish(now, machine);
  keep_now_ = true;
  for (int tries = 0; mail_ && keep_now_ && tries < kLastTries; ++tries) lay_down_checkpoint();
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(over_event_.get(), &one, sizeof one);
  over_.store(true, std::memory_order_release);  // last: whoever reads it may destroy this session
}

void HostedSession::lay_down_checkpoint() noexcept {
  Checkpoint now = session_.checkpoint();
  now.epoch = epoch_;  // a session that took the place of another one counts on, whatever its core says
  keep_now_ = !mail_->lay_down(now);
  if (!keep_now_) since_kept_ = 0;
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
  picture_.stop = session_.stop_lane();
  picture_.waits = !session_.begun() || session_.gathering();
  picture_.machine = machine;
  picture_.stray = session_.stray();
  picture_.violations = violations_.passed() ? 0 : 1;
  picture_.audit_dropped = session_.audit_dropped() + audit_.dropped();
  // Quick truths are looked up for all seats at once, so that a line never mixes old and new.
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    SeatStatus& seat = picture_.seats[i];
    seat.taken = session_.seat(i).taken();
    seat.alive = session_.seat(i).alive(now);
    seat.ready = session_.seat(i).ready(now);
    seat.stopped = session_.seat(i).heard().stop;
    seat.gate = session_.seat(i).heard().gate;
    seat.weight = i < scene_->masters() ? 0 : 1;
    for (std::size_t j = 0; i < scene_->masters() && j < scene_->tools.size(); ++j) seat.weight = std::max(seat.weight, session_.tool(j).authority.requested()[i]);
  }
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = picture_;
}

}  // namespace tandem::server
