#include "client/app/seat_pump.h"

#include <sys/eventfd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kRounds = 4;  // batches read per tick: a flood cannot stop the servo
constexpr Duration kLate = 1ms;
constexpr Duration kScriptWaits = 200ms;  // of silence
constexpr Duration kScriptAgain = 200ms;  // after it was refused; later than this it was somebody else who was:
constexpr Duration kScriptStands = 1500ms;
constexpr std::uint64_t kLookEvery = 64;  // ticks between two pictures for people
constexpr std::uint64_t kHandoverShown = 1000;    // ticks, at least
constexpr std::uint64_t kHandoverSettled = 100;   // ticks in which a weight did not move: it has arrived, and no gap of the network is as long
constexpr double kAlphaStands = 1e-6;

double sum_j(const EnergyArray& nj) {
  double sum = 0;
  for (const auto e : nj) sum += static_cast<double>(e) * 1e-9;
  return sum;
}

std::array<double, 3> triple(const hal::Vec3& v) { return {v[0], v[1], v[2]}; }

double norm(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

SeatPump::SeatPump(io::UdpSocket socket, Seat& seat, hal::sim::SimDevice* sim, std::vector<AlphaScript::Change> script,
                   SampleQueue* samples, Duration exchange)
    : socket_(std::move(socket)),
      finished_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      seat_(&seat),
      sim_(sim),
      script_(std::move(script)),
      samples_(samples),
      masters_(seat.setup().masters.size()),
      pace_(from_seconds(1.0 / seat.setup().tick_hz), exchange) {}

SeatPump::~SeatPump() {
  delete next_.load();
  delete old_.load();
}

hal::Command SeatPump::tick(const hal::State& state) noexcept {
  const Time now = io::monotonic_now();
  if (!pace_.due(now)) return held_;
  if (ticks_++ == 0) began_ = connected_ = now;
  if (now - state.sampled_at > kLate) ++picture_.late_ticks;
  change_connection(now);
  receive(now);
  obey_person();
  obey_script(now);
  const auto session = seat_->session_time(now);
  if (sim_ != nullptr) sim_->set_session_time(seat_->clock_stands() ? std::nullopt : session);  // a stopped hand waits
  seat_->note_late_ticks(picture_.late_ticks);
  held_ = seat_->on_servo(now, state);
  send(now);
  see_handover();

  const wire::Telemetry& t = seat_->sample().telemetry;
  picture_.force_peak_n = std::max(picture_.force_peak_n, norm(t.f_out));
  if (samples_ != nullptr)
    samples_->push({session.value_or(-seconds(now - began_)), t.q, t.x, t.f_cmd, triple(seat_->tip_force()), t.f_out,
                    seat_->sample().gate, seat_->authority(), seat_->link().freshness().heard() ? seconds(seat_->link().freshness().silence(now)) : -1});
  if (ticks_ % kLookEvery == 1 || seat_->closed()) look(now);
  if (seat_->closed() && !std::exchange(told_, true)) {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(finished_.get(), &one, sizeof one);
  }
  return held_;
}

void SeatPump::lost(hal::Errc) noexcept {
  lost_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(finished_.get(), &one, sizeof one);
}

void SeatPump::finished_read() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(finished_.get(), &count, sizeof count);
}

void SeatPump::change_connection(Time now) noexcept {
  if (next_.load(std::memory_order_relaxed) == nullptr) return;
  Handover* const handover = next_.exchange(nullptr, std::memory_order_acquire);
  before_ = counts();
  std::swap(socket_, handover->socket);
  seat_->rejoin(handover->connection);
  old_.store(handover, std::memory_order_release);
  connected_ = now;
  told_ = seat_->closed();
  ++picture_.rejoins;
}

SeatPump::Counts SeatPump::counts() const noexcept {
  const link::LinkStats& l = seat_->link().stats();
  Counts all = before_;
  all.sent += l.sent;
  all.accepted += l.accepted;
  all.late += l.late;
  for (const auto r : l.refused) all.refused += r;
  return all;
}

void SeatPump::receive(Time now) noexcept {
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(socket_.fd.get());
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!in_.too_long(i)) seat_->on_datagram(now, in_.bytes(i));
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
  }
}

void SeatPump::obey_person() noexcept {
  if (reset_.exchange(false, std::memory_order_relaxed)) seat_->press_reset();
  if (resume_.exchange(false, std::memory_order_relaxed)) seat_->press_resume();
  if (stop_.exchange(false, std::memory_order_relaxed)) seat_->press_stop();  // after a resume: a stop wins
  if (stop_all_.exchange(false, std::memory_order_relaxed)) static_cast<void>(seat_->press_stop_all());
  if (leave_.load(std::memory_order_relaxed)) seat_->leave();
  while (const control::Weights* wish = wishes_.front()) {
    seat_->request_authority(static_cast<std::uint32_t>(seat_->setup().seat.tool), std::span{*wish}.first(masters_));
    script_asked_.reset();
    wishes_.pop();
  }
}

void SeatPump::obey_script(Time now) noexcept {
  const link::Freshness& f = seat_->link().freshness();
  if (!f.heard() || f.unanswered(now) > kScriptWaits) return;  // while there is no server, its time stands still
  // A person who is refused sees it and says it again; for a script this does, as long as nothing else was asked for.
  if (script_asked_ && seat_->force().handover == wire::Handover::kCalledOff && now - *script_asked_ > kScriptAgain && now - *script_asked_ < kScriptStands)
    ask_script(now);
  const auto t = seat_->server_time(now);
  const double due = t.value_or(0) + wire::kHandoverNotice / seat_->setup().tick_hz;
  if (!t || next_change_ >= script_.size() || script_[next_change_].at > due) return;
  while (next_change_ + 1 < script_.size() && script_[next_change_ + 1].at <= due) ++next_change_;
  ++next_change_;
  ask_script(now);
}

/// For what the script came to last.
void SeatPump::ask_script(Time now) noexcept {
  script_asked_ = now;
  seat_->request_authority(static_cast<std::uint32_t>(seat_->setup().seat.tool), std::span{script_[next_change_ - 1].alpha}.first(masters_));
}

void SeatPump::send(Time now) noexcept {
  while (out_.size() < kSendMax) {
    auto& buffer = buffers_[out_.size()];
    const auto size = seat_->poll_transmit(now, buffer);
    if (!size) break;
    out_.add(std::span{buffer}.first(*size), nullptr, nullptr);
  }
  if (out_.size() > 0) out_.send(socket_.fd.get());  // what cannot be sent is lost, as on any network
}

/// An announcement lasts 50 ticks and people look less often: it is kept for them, and as long as the weight moves.
void SeatPump::see_handover() noexcept {
  const wire::ForceMessage& f = seat_->force();
  const bool anew = f.handover != wire::Handover::kNone && (f.handover != handover_ || f.authority_version != handover_version_);
  handover_ = f.handover;
  handover_version_ = f.authority_version;
  if (anew) {
    picture_.handover = f.handover;
    picture_.handover_parties = f.handover_parties;
    picture_.handover_from = f.alpha;
    ++picture_.handovers;
    handover_told_ = ticks_;
    handover_begins_ = handover_moved_ = ticks_ + f.handover_ticks;
  }
  if (std::abs(f.alpha - handover_alpha_) > kAlphaStands) handover_moved_ = std::max(handover_begins_, ticks_);
  handover_alpha_ = f.alpha;
  picture_.handover_s = (static_cast<double>(handover_begins_) - static_cast<double>(ticks_)) / seat_->setup().tick_hz;
  picture_.handover_done = ticks_ > handover_moved_ + kHandoverSettled;
  const bool long_ago = ticks_ - handover_told_ > kHandoverShown;
  const bool told = f.session == wire::SessionState::kRunning || f.session == wire::SessionState::kStopped || f.session == wire::SessionState::kPaused;
  if (!anew && (!told || (long_ago && picture_.handover_done))) picture_.handover = wire::Handover::kNone;
}

void SeatPump::look(Time now) noexcept {
  const wire::StateMessage& sample = seat_->sample();
  const wire::Telemetry& t = sample.telemetry;
  const link::Freshness& f = seat_->link().freshness();
  ClientStatus& p = picture_;
  p.session = seat_->force().session;
  p.gate = sample.gate;
  p.heard = f.heard();
  p.closed = seat_->closed();
  p.close_reason = seat_->close_reason();
  p.stops = seat_->force().stops;
  p.missing = seat_->force().missing;
  if (const auto time = seat_->server_time(now)) p.session_time = *time;  // back at a server that waits for others: what was last shown
  p.silence_s = seconds(f.heard() ? f.unanswered(now) : now - connected_);
  p.alpha = seat_->authority();
  p.authority_version = seat_->force().authority_version;
  p.touching = seat_->force().touching;
  p.own_stop = seat_->stopped();
  p.distance_m.reset();
  if (seat_->setup().port == PortSpace::kTip && f.heard()) p.distance_m = distance_to_tool();
  const auto beside = seat_->beside_leader(now);
  p.beside_leader_m = beside ? std::optional{beside->norm()} : std::nullopt;
  p.force_n = norm(t.f_out);
  p.x = t.x;
  p.rtt_ms = 1e3 * seconds(f.rtt());
  p.rtt_p50_ms = 1e3 * seconds(f.rtt_p50());
  p.rtt_p99_ms = 1e3 * seconds(f.rtt_p99());
  p.down_loss_percent = t.down_loss_percent;
  p.down_longest_gap_ms = t.down_longest_gap_ms;
  p.down_age_p99_ms = t.down_age_p99_ms;
  p.energy_in_j = sum_j(sample.port.e_in);
  p.energy_out_j = sum_j(t.e_out);
  p.dissipated_j = t.dissipated_j;
  p.refused_j = t.refused_j;
  p.delivered_j = t.delivered_j;
  p.margin_min_j = t.margin_min_j;
  p.given_after_loss_max_j = seat_->gate().given_after_loss_max();
  p.gate_trips = sample.gate_trips;
  p.motors_hot = seat_->over_temperature().hot();
  p.motors_latched = seat_->over_temperature().latched();
  p.hot_trips = seat_->over_temperature().all();
  if (seat_->heat() && !(p.heat_max >= seat_->heat())) p.heat_max = seat_->heat();
  const Counts all = counts();
  p.sent = all.sent;
  p.accepted = all.accepted;
  p.late_datagrams = all.late;
  p.refused_datagrams = all.refused;
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = p;
}

/// Between the hand and the tool as this seat last heard of it [m]. Axes of a tip come first, three at most.
double SeatPump::distance_to_tool() const noexcept {
  double square = 0;
  for (std::size_t a = 0; a < std::min<std::size_t>(seat_->setup().dof, 3); ++a) {
    const double d = seat_->force().port.x[a] - seat_->sample().port.x[a];
    square += d * d;
  }
  return std::sqrt(square);
}

ClientStatus SeatPump::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

}  // namespace tandem::client
