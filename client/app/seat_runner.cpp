#include "client/app/seat_runner.h"

#include <sys/eventfd.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

using namespace std::chrono_literals;

constexpr int kRounds = 4;  // batches read per tick: a datagram flood cannot stall the servo thread
constexpr Duration kLate = 1ms;
constexpr Duration kScriptWaits = 200ms;        // silence of the server after which the script pauses
constexpr Duration kScriptAgain = 200ms;        // delay before a rejected script request is repeated
constexpr Duration kScriptStands = 1500ms;      // a rejection later than this belongs to another participant's request
constexpr std::uint64_t kSnapshotEvery = 64;    // ticks between two published snapshots
constexpr std::uint64_t kTransferShown = 1000;  // smallest number of ticks for which a transfer is shown
constexpr std::uint64_t kTransferSettled =
    100;  // ticks without a change of authority after which a transfer is done; longer than usual network gaps
constexpr double kAlphaStands = 1e-6;

double sum_j(const EnergyArray& nj) {
  double sum = 0;
  for (const auto e : nj) sum += static_cast<double>(e) * 1e-9;
  return sum;
}

std::array<double, 3> triple(const hal::Vec3& v) { return {v[0], v[1], v[2]}; }

double norm(const std::array<double, 3>& v) { return std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]); }

}  // namespace

SeatRunner::SeatRunner(io::UdpSocket socket, Seat& seat, hal::sim::SimDevice* sim,
                       std::vector<AuthorityScript::Change> script, SampleQueue* samples, Duration exchange)
    : socket_(std::move(socket)),
      finished_(eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)),
      seat_(&seat),
      sim_(sim),
      script_(std::move(script)),
      samples_(samples),
      masters_(seat.setup().masters.size()),
      pace_(from_seconds(1.0 / seat.setup().tick_hz), exchange) {}

SeatRunner::~SeatRunner() {
  delete next_.load();
  delete old_.load();
}

hal::Command SeatRunner::tick(const hal::State& state) noexcept {
  const Time now = io::monotonic_now();
  if (!pace_.due(now)) return command_;
  if (ticks_++ == 0) began_ = connected_ = now;
  if (now - state.sampled_at > kLate) ++snapshot_.late_ticks;
  change_connection(now);
  receive(now);
  apply_user_input();
  apply_script(now);
  const auto session = seat_->session_time(now);
  // While the session clock is halted, a simulated device holds its position.
  if (sim_ != nullptr) sim_->set_session_time(seat_->clock_stopped() ? std::nullopt : session);
  seat_->set_late_ticks(snapshot_.late_ticks);
  command_ = seat_->on_servo(now, state);
  send(now);
  track_transfer();

  const wire::Telemetry& t = seat_->sample().telemetry;
  snapshot_.force_peak_n = std::max(snapshot_.force_peak_n, norm(t.f_out));
  if (samples_ != nullptr)
    samples_->push({session.value_or(-seconds(now - began_)), t.q, t.x, t.f_cmd, triple(seat_->tip_force()), t.f_out,
                    seat_->sample().gate, seat_->authority(),
                    seat_->link().timing().heard() ? seconds(seat_->link().timing().silence(now)) : -1});
  if (ticks_ % kSnapshotEvery == 1 || seat_->closed()) snapshot(now);
  if (seat_->closed() && !std::exchange(close_signalled_, true)) {
    const std::uint64_t one = 1;
    [[maybe_unused]] const auto written = ::write(finished_.get(), &one, sizeof one);
  }
  return command_;
}

void SeatRunner::lost(hal::Errc) noexcept {
  lost_.store(true, std::memory_order_release);
  const std::uint64_t one = 1;
  [[maybe_unused]] const auto written = ::write(finished_.get(), &one, sizeof one);
}

void SeatRunner::clear_finished() noexcept {
  std::uint64_t count = 0;
  [[maybe_unused]] const auto read = ::read(finished_.get(), &count, sizeof count);
}

void SeatRunner::change_connection(Time now) noexcept {
  if (next_.load(std::memory_order_relaxed) == nullptr) return;
  ConnectionSwap* const handover = next_.exchange(nullptr, std::memory_order_acquire);
  earlier_counts_ = counts();
  std::swap(socket_, handover->socket);
  seat_->reconnect(handover->connection);
  old_.store(handover, std::memory_order_release);
  connected_ = now;
  close_signalled_ = seat_->closed();
  ++snapshot_.reconnects;
}

SeatRunner::Counts SeatRunner::counts() const noexcept {
  const transport::SecureChannelStats& l = seat_->link().stats();
  Counts all = earlier_counts_;
  all.sent += l.sent;
  all.accepted += l.accepted;
  all.late += l.late;
  for (const auto r : l.dropped) all.refused += r;
  return all;
}

void SeatRunner::receive(Time now) noexcept {
  for (int round = 0; round < kRounds; ++round) {
    const int count = in_.receive(socket_.fd.get());
    for (int k = 0; k < count; ++k) {
      const auto i = static_cast<std::size_t>(k);
      if (!in_.too_long(i)) seat_->on_datagram(now, in_.bytes(i));
    }
    if (count < static_cast<int>(io::ReceiveBatch::kMax)) return;
  }
}

void SeatRunner::apply_user_input() noexcept {
  if (reset_.exchange(false, std::memory_order_relaxed)) seat_->request_gate_reset();
  if (resume_.exchange(false, std::memory_order_relaxed)) seat_->request_resume();
  if (stop_.exchange(false, std::memory_order_relaxed))
    seat_->request_local_stop();  // after resume: stop takes precedence
  if (stop_all_.exchange(false, std::memory_order_relaxed)) static_cast<void>(seat_->request_stop_all());
  if (leave_.load(std::memory_order_relaxed)) seat_->leave();
  while (const control::MasterArray* request = authority_requests_.front()) {
    seat_->request_authority(static_cast<std::uint32_t>(seat_->setup().seat.tool), std::span{*request}.first(masters_));
    script_requested_.reset();
    authority_requests_.pop();
  }
}

void SeatRunner::apply_script(Time now) noexcept {
  const transport::LinkTiming& f = seat_->link().timing();
  if (!f.heard() || f.unanswered_for(now) > kScriptWaits) return;  // session time halts while the server is silent
  // A user sees a rejected request and can repeat it. A script request is repeated here, unless the user made another
  // request since.
  if (script_requested_ && seat_->force().transfer == wire::TransferNotice::kCancelled &&
      now - *script_requested_ > kScriptAgain && now - *script_requested_ < kScriptStands)
    request_scripted_authority(now);
  const auto t = seat_->server_time(now);
  const double due = t.value_or(0) + wire::kTransferNoticeTicks / seat_->setup().tick_hz;
  if (!t || next_change_ >= script_.size() || script_[next_change_].at > due) return;
  while (next_change_ + 1 < script_.size() && script_[next_change_ + 1].at <= due) ++next_change_;
  ++next_change_;
  request_scripted_authority(now);
}

/// Requests the authority of the newest due script row.
void SeatRunner::request_scripted_authority(Time now) noexcept {
  script_requested_ = now;
  seat_->request_authority(static_cast<std::uint32_t>(seat_->setup().seat.tool),
                           std::span{script_[next_change_ - 1].alpha}.first(masters_));
}

void SeatRunner::send(Time now) noexcept {
  while (out_.size() < kSendMax) {
    auto& buffer = buffers_[out_.size()];
    const auto size = seat_->poll_transmit(now, buffer);
    if (!size) break;
    out_.add(std::span{buffer}.first(*size), nullptr, nullptr);
  }
  if (out_.size() > 0) out_.send(socket_.fd.get());  // a datagram that cannot be sent counts as lost
}

/// Keeps a transfer notice in the snapshot. The server announces a transfer for only 50 ticks, less than the refresh
/// interval of the screen. The notice is therefore kept for 1000 ticks and as long as the authority changes.
void SeatRunner::track_transfer() noexcept {
  const wire::ForceMessage& f = seat_->force();
  const bool anew = f.transfer != wire::TransferNotice::kNone &&
                    (f.transfer != transfer_ || f.authority_version != transfer_version_);
  transfer_ = f.transfer;
  transfer_version_ = f.authority_version;
  if (anew) {
    snapshot_.transfer = f.transfer;
    snapshot_.transfer_parties = f.transfer_parties;
    snapshot_.transfer_from = f.alpha;
    ++snapshot_.transfers;
    transfer_announced_ = ticks_;
    transfer_begins_ = transfer_moved_ = ticks_ + f.transfer_ticks;
  }
  if (std::abs(f.alpha - transfer_alpha_) > kAlphaStands) transfer_moved_ = std::max(transfer_begins_, ticks_);
  transfer_alpha_ = f.alpha;
  snapshot_.transfer_begins_s =
      (static_cast<double>(transfer_begins_) - static_cast<double>(ticks_)) / seat_->setup().tick_hz;
  snapshot_.transfer_done = ticks_ > transfer_moved_ + kTransferSettled;
  const bool long_ago = ticks_ - transfer_announced_ > kTransferShown;
  const bool told = f.session == wire::SessionState::kRunning || f.session == wire::SessionState::kStopped ||
                    f.session == wire::SessionState::kPaused;
  if (!anew && (!told || (long_ago && snapshot_.transfer_done))) snapshot_.transfer = wire::TransferNotice::kNone;
}

void SeatRunner::snapshot(Time now) noexcept {
  const wire::StateMessage& sample = seat_->sample();
  const wire::Telemetry& t = sample.telemetry;
  const transport::LinkTiming& f = seat_->link().timing();
  ClientStatus& p = snapshot_;
  p.session = seat_->force().session;
  p.gate = sample.gate;
  p.heard = f.heard();
  p.closed = seat_->closed();
  p.close_reason = seat_->close_reason();
  p.stops = seat_->force().stops;
  p.missing = seat_->force().missing;
  if (const auto time = seat_->server_time(now))
    p.session_time = *time;  // without a running session, e.g. after a server restart, the last value stays
  p.silence_s = seconds(f.heard() ? f.unanswered_for(now) : now - connected_);
  p.alpha = seat_->authority();
  p.authority_version = seat_->force().authority_version;
  p.touching = seat_->force().touching;
  p.local_stop = seat_->locally_stopped();
  p.distance_m.reset();
  if (seat_->setup().port == PortSpace::kTip && f.heard()) p.distance_m = distance_to_tool();
  const auto beside = seat_->offset_from_leader(now);
  p.offset_from_leader_m = beside ? std::optional{beside->norm()} : std::nullopt;
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
  p.given_after_loss_max_j = seat_->gate().tank().given_max();
  p.gate_trips = sample.gate_trips;
  p.motors_hot = seat_->overtemperature_guard().hot();
  p.motors_latched = seat_->overtemperature_guard().latched();
  p.hot_trips = seat_->overtemperature_guard().trips_total();
  if (seat_->heat() && !(p.heat_max >= seat_->heat())) p.heat_max = seat_->heat();
  const Counts all = counts();
  p.sent = all.sent;
  p.accepted = all.accepted;
  p.late_datagrams = all.late;
  p.refused_datagrams = all.refused;
  const std::unique_lock lock{published_lock_, std::try_to_lock};
  if (lock) published_ = p;
}

/// Returns the distance between the port position sent and the tool position received last [m], over up to 3 axes.
double SeatRunner::distance_to_tool() const noexcept {
  double square = 0;
  for (std::size_t a = 0; a < std::min<std::size_t>(seat_->setup().dof, 3); ++a) {
    const double d = seat_->force().port.x[a] - seat_->sample().port.x[a];
    square += d * d;
  }
  return std::sqrt(square);
}

ClientStatus SeatRunner::status() const {
  const std::lock_guard lock{published_lock_};
  return published_;
}

}  // namespace tandem::client
