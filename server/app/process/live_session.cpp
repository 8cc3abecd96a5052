#include "server/app/process/live_session.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/auth/io/state_directory.h"
#include "common/io/clock.h"
#include "server/session/session_invariant_checker.h"

namespace tandem::server {
namespace {

// Ticks between two updates of one seat's status, and between two published copies.
constexpr std::uint64_t kStatusInterval = 64;
constexpr std::uint64_t kStatusIntervalShedding = 4 * kStatusInterval;  // from ShedLevel::kTelemetry on
constexpr std::uint32_t kRecordIntervalShedding = 10;                   // [ticks] likewise, of a recorded session

constexpr double kCostWeight = 1.0 / 4;  // of the newest measurement in the mean cost

constexpr Duration kNeverEchoed = std::chrono::hours(1);  // a longer loop age means that no echo has arrived

double ms(Duration d) { return seconds(d) * 1e3; }

DirectionReport direction(const transport::SecureChannel& receiver, Time now) {
  const transport::SecureChannelStats& s = receiver.stats();
  return {s.loss_percent(), ms(receiver.longest_gap(now)), ms(Duration{s.age.quantile(0.99)})};
}

}  // namespace

LiveSession::LiveSession(const SceneSpec& scene, LocalSlaves slaves, std::uint8_t slot, TickQueue& records,
                         const Checkpoint* from, Time saved_at)
    : scene_(&scene),
      slot_(slot),
      session_(from == nullptr ? Session(scene, std::move(slaves.devices), slaves.scale)
                               : Session(scene, std::move(slaves.devices), slaves.scale, *from, saved_at)),
      records_(&records),
      seldom_interval_(static_cast<std::uint32_t>(std::ceil(scene.tick_hz / wire::kTelemetryHz))) {
  draw_path_tokens();
}

/// Tokens come from the kernel, so only a host that receives at the challenged address can know them.
void LiveSession::draw_path_tokens() noexcept {
  PathTokens& tokens = session_.path_tokens();
  std::array<std::uint64_t, PathTokens::kMax> drawn;
  const auto wanted = std::span{drawn}.first(tokens.free_slots());
  auth::fill_random(std::as_writable_bytes(wanted));
  for (const std::uint64_t token : wanted) tokens.add(token);
}

SessionStatus LiveSession::status() const { return published_.read(); }

void LiveSession::add_cost(Duration spent) noexcept {
  const double before = cost_.load(std::memory_order_relaxed), now = seconds(spent);
  cost_.store(before == 0 ? now : before + kCostWeight * (now - before), std::memory_order_relaxed);
}

Time LiveSession::tick(Time now, Time due, std::uint32_t missed, const MachineStatus& machine) noexcept {
  if (session_.idle()) now = due;
  late_ticks_ += machine.late ? 1 : 0;
  missed_ticks_ += missed;
  session_.lifecycle().set_load_state(machine.load_state);
  session_.lifecycle().set_may_act(acts_.load(std::memory_order_relaxed) &&
                                   (act_limit_ == nullptr || io::boottime_now() < act_limit_->until()));
  const bool seldom = machine.load_state.level >= ShedLevel::kTelemetry;
  const bool every_tick = reported_ || recording_.load(std::memory_order_relaxed);
  session_.set_telemetry_every_tick(every_tick);
  session_.set_record_interval(std::max(every_tick ? 1 : seldom_interval_, seldom ? kRecordIntervalShedding : 1));
  if (ticks_ == 0) first_tick_.store(now.time_since_epoch().count(), std::memory_order_release);
  session_.on_tick(now, missed);
  ends_.store(session_.ends(), std::memory_order_relaxed);
  while (const auto event = session_.audit().poll()) {
    audit_.push(*event);
    checkpoints_.note(event->what);
  }
  if (session_.path_tokens().low()) draw_path_tokens();
  checkpoints_.step(session_);
  SessionInvariantChecker{}.check(session_, violations_);
  if (session_.record().running) {
    if (session_.recorded()) {
      records_->push(session_.record());
    } else if (every_tick) {
      ++skipped_records_;
    }
  }
  // One seat per tick: the quantiles of its histograms take microseconds, and all seats in one tick would delay it.
  const std::uint64_t every = seldom ? kStatusIntervalShedding : kStatusInterval;
  const std::size_t seat = ticks_ % every;
  if (seat < scene_->seats.size()) update_seat_status(seat, now);
  if (++ticks_ % every == 0) publish(now, machine);
  return now;
}

void LiveSession::finish(Time now, const MachineStatus& machine) noexcept {
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) update_seat_status(i, now);
  publish(now, machine);
  checkpoints_.finish(session_);
  over_event_.signal();
  over_.store(true, std::memory_order_release);  // last, because a reader may then destroy this session
}

void LiveSession::update_seat_status(std::size_t i, Time now) noexcept {
  const SeatEndpoint& port = session_.seat(i);
  const wire::Telemetry& heard = port.telemetry();
  SeatStatus& seat = status_.seats[i];
  seat.ever_taken = seat.ever_taken || port.taken();
  seat.alpha = i < scene_->masters() ? session_.hub().authority(i) : port.tx.alpha;
  seat.margin_j = heard.margin_min_j;
  seat.gate_trips = heard.gate_trips;
  seat.late_ticks = heard.late_ticks;
  seat.link.down = {heard.down_loss_percent, heard.down_longest_gap_ms, heard.down_age_p99_ms};
  if (const transport::SecureChannel* link = port.link()) {  // the last values of a seat that was left remain
    seat.link.rtt_p50_ms = ms(link->timing().rtt_p50());
    seat.link.rtt_p99_ms = ms(Duration{link->timing().rtts().quantile(0.99)});
    seat.recent_rtt_p99_ms = ms(link->timing().rtt_p99());
    seat.link.up = direction(*link, now);
    const Duration age = link->timing().loop_age(now);
    seat.loop_age_s = age < kNeverEchoed ? seconds(age) : 0;
    // Prometheus takes a counter that falls for one that began again at zero, as those of a new connection do.
    const transport::SecureChannelStats& stats = link->stats();
    seat.lost = stats.accepted < seat.accepted ? stats.lost() : std::max(seat.lost, stats.lost());
    seat.accepted = stats.accepted;
    seat.late = stats.late;
    for (std::size_t r = 0; r < stats.dropped.size(); ++r) {
      const std::uint64_t before = std::exchange(rejected_before_[i][r], stats.dropped[r]);
      seat.refused[r] += stats.dropped[r] - (before <= stats.dropped[r] ? before : 0);
    }
  }
}

void LiveSession::publish(Time now, const MachineStatus& machine) noexcept {
  status_.state = session_.state();
  status_.time = session_.clock().time();
  status_.stop = session_.stop_control().latch();
  status_.waiting = !session_.start_condition().begun() || session_.start_condition().recovering();
  status_.may_act = session_.lifecycle().may_act();
  status_.machine = machine;
  status_.machine.late_ticks = late_ticks_;
  status_.machine.missed_ticks = missed_ticks_;
  status_.unmatched_datagrams = session_.unmatched_datagrams();
  status_.violations = violations_.passed() ? 0 : 1;
  status_.audit_dropped = session_.audit().dropped() + audit_.dropped();
  // Flags are updated for all seats at once, so that one status never mixes old and new.
  for (std::size_t i = 0; i < scene_->seats.size(); ++i) {
    SeatStatus& seat = status_.seats[i];
    seat.taken = session_.seat(i).taken();
    seat.alive = session_.seat(i).alive(now);
    seat.ready = session_.seat(i).ready(now);
    seat.stopped = session_.seat(i).last_state().stop;
    seat.gate = session_.seat(i).last_state().gate;
    seat.authority_max = i < scene_->masters() ? 0 : 1;
    for (std::size_t j = 0; i < scene_->masters() && j < scene_->tools.size(); ++j)
      seat.authority_max = std::max(seat.authority_max, session_.tool(j).authority.requested()[i]);
  }
  published_.publish(status_);
}

}  // namespace tandem::server
