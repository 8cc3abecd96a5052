#include "client/app/seat_runner.h"

#include <utility>

#include "common/io/clock.h"

namespace tandem::client {
namespace {

constexpr Duration kLate = std::chrono::milliseconds(1);

}  // namespace

SeatRunner::SeatRunner(io::UdpSocket socket, Seat& seat, hal::sim::SimDevice* sim,
                       std::vector<AuthorityScript::Change> script, SampleQueue* samples, Duration exchange)
    : seat_(&seat),
      socket_(std::move(socket)),
      script_(std::move(script), seat.setup().tick_hz),
      sim_(sim),
      samples_(samples),
      pace_(from_seconds(1.0 / seat.setup().tick_hz), exchange),
      phase_(from_seconds(1.0 / seat.setup().tick_hz)),
      recorder_(seat.setup().tick_hz) {}

hal::Command SeatRunner::tick(const hal::State& state) noexcept {
  const Time now = io::monotonic_now();
  if (!pace_.due(now)) return command_;
  if (ticks_++ == 0) first_tick_ = now;
  swap_connection(now);
  socket_.receive(now, *seat_);
  phase_.observe(seat_->link().timing(), now);
  if (commands_.apply(*seat_)) script_.cancel_retry();
  request_scripted_authority(now);
  const auto session_time = seat_->clock().session_time(now);
  // While the session clock is halted, a simulated device holds its position.
  if (sim_ != nullptr) sim_->set_session_time(seat_->clock().stopped() ? std::nullopt : session_time);
  seat_->set_late_ticks(recorder_.count_late_tick(now - state.sampled_at > kLate));
  command_ = seat_->on_servo(now, state);
  socket_.send(now, *seat_);
  record(now, session_time);
  return command_;
}

/// If only some exchanges are ticks, a shift of the exchange would not shift the tick.
Duration SeatRunner::next_shift() noexcept { return pace_.takes_all() ? phase_.next_shift() : Duration{}; }

void SeatRunner::swap_connection(Time now) noexcept {
  std::unique_ptr<ConnectionSwap> swap = connections_.take_next();
  if (!swap) return;
  recorder_.on_reconnect(now, *seat_);
  socket_.swap(swap->socket);
  seat_->reconnect(swap->connection);
  phase_.restart();
  connections_.return_old(std::move(swap));
  status_pace_.restart();
}

void SeatRunner::request_scripted_authority(Time now) noexcept {
  const control::MasterArray* const alpha = script_.due(now, seat_->link().timing().unanswered_for(now),
                                                        seat_->force().transfer, seat_->clock().server_time(now));
  if (alpha != nullptr) seat_->requests().change_own_tool(*alpha);
}

void SeatRunner::record(Time now, const std::optional<double>& session_time) noexcept {
  recorder_.on_tick(now, *seat_);
  if (samples_ != nullptr) {
    const wire::Telemetry& t = seat_->sample().telemetry;
    const hal::Vec3 f = seat_->device().tip_force(seat_->effort());
    const transport::LinkTiming& timing = seat_->link().timing();
    samples_->push({session_time.value_or(-seconds(now - first_tick_)),
                    t.q,
                    t.x,
                    t.f_cmd,
                    {f[0], f[1], f[2]},
                    t.f_out,
                    seat_->sample().gate,
                    seat_->tools().authority(),
                    timing.heard() ? seconds(timing.silence(now)) : -1});
  }
  const bool closed = seat_->closed();
  if (!status_pace_.due(closed)) return;
  const bool published = published_.publish(recorder_.update(now, *seat_));
  if (status_pace_.on_publish(published, closed)) finished_.signal();
}

void SeatRunner::lost(hal::Errc) noexcept {
  lost_.store(true, std::memory_order_release);
  finished_.signal();
}

void SeatRunner::clear_finished() noexcept { finished_.clear(); }

}  // namespace tandem::client
