#include "server/session/send_schedule.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace tandem::server {

namespace {
constexpr double kObserverHz = 60;  // FORCE rate to seats that receive no force
// Isolated losses must not trip a gate: at 5 % random loss, five in a row occur every day or two.
constexpr double kIntervalsOfSilence = 6;
}  // namespace

SendSchedule::SendSchedule(const SceneSpec& scene, std::span<SeatEndpoint> seats) noexcept
    : scene_(&scene),
      seats_(seats),
      observer_interval_(static_cast<std::uint32_t>(std::ceil(scene.tick_hz / kObserverHz))),
      evaluator_interval_max_(
          static_cast<std::uint32_t>(std::max(1.0, scene.gate.silence_limit * scene.tick_hz / kIntervalsOfSilence))) {
  last_turn_.fill(~0u);
  for (std::size_t i = 0; i < seats_.size(); ++i) every_tick_[i] = seats_[i].receives_force() && controls(i);
}

bool SendSchedule::controls(std::size_t i) const noexcept {
  return seats_[i].role() != AccessRole::kEvaluator || scene_->seats[i].kind != SeatKind::kMaster ||
         scene_->seats[i].required;
}

std::uint32_t SendSchedule::interval(std::size_t i, ShedLevel level) const noexcept {
  const SeatEndpoint& seat = seats_[i];
  if (!seat.receives_force())
    return observer_interval_ * (level >= ShedLevel::kObservers10Hz ? 6 : level >= ShedLevel::kObservers20Hz ? 3 : 1);
  if (controls(i)) return 1;
  return std::min(evaluator_interval_max_, level >= ShedLevel::kEvaluatorsEvery3rd   ? 3u
                                           : level >= ShedLevel::kEvaluatorsEvery2nd ? 2u
                                                                                     : 1u);
}

/// Sends to evaluators are staggered over ticks, so that no single tick carries all of them.
bool SendSchedule::turn_begins(std::size_t i, std::uint32_t tick, ShedLevel level) noexcept {
  const std::uint32_t staggered = tick + (seats_[i].receives_force() ? static_cast<std::uint32_t>(i) : 0);
  const std::uint32_t turn = every_tick_[i] ? staggered : staggered / interval(i, level);
  return turn != std::exchange(last_turn_[i], turn);
}

void SendSchedule::begin_tick(Time now, std::uint32_t tick, ShedLevel level, const CloseOuts& closing) noexcept {
  rewind();
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const bool due = turn_begins(i, tick, level) && seats_[i].reachable();
    due_[i] = due && (closing.due(i) != nullptr ? !seats_[i].expired(now)
                                                : seats_[i].force_due(now, tick) && seats_[i].may_send(now));
  }
}

std::optional<Transmit> SendSchedule::poll(Time now, std::uint32_t tick, const CloseOuts& closing,
                                           std::span<std::byte> buffer) noexcept {
  for (; next_ < seats_.size(); ++next_) {
    SeatEndpoint& seat = seats_[next_];
    if (const auto challenge = seat.transmit_challenge(now, tick, buffer)) return challenge;
    if (!std::exchange(due_[next_], false)) continue;
    const CloseOut* const close = closing.due(next_);
    const Transmit out =
        close != nullptr ? seat.transmit_close(now, tick, close->reason(), buffer) : seat.transmit(now, tick, buffer);
    if (out.size == 0) continue;
    ++next_;
    return out;
  }
  return std::nullopt;
}

}  // namespace tandem::server
