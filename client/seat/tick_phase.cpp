#include "client/seat/tick_phase.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace tandem::client {
namespace {

constexpr double kTurn = 2 * std::numbers::pi;
constexpr double kResultantMin = 0.5;
constexpr double kWaitMin = 1.0 / 6, kWaitMax = 0.5;  ///< [ticks]
constexpr double kNegligible = 0.05;                  ///< [ticks]; a smaller error needs no shift

}  // namespace

void TickPhase::observe(const transport::LinkTiming& timing, Time now) noexcept {
  if (timing.rtt_samples() == 0 || timing.arrived() == heard_) return;
  heard_ = timing.arrived();
  record(timing.peer_silence(), timing.loop_age(now));
}

void TickPhase::record(Duration waited, Duration loop) noexcept {
  if (left_ != Duration{}) return;
  if (ignored_ > 0) {
    --ignored_;
    return;
  }
  const double angle = kTurn * seconds(waited % tick_) / seconds(tick_);
  cosines_ += std::cos(angle), sines_ += std::sin(angle);
  if (++count_ < kSamples) return;
  plan(loop);
  cosines_ = sines_ = 0, count_ = 0;
}

void TickPhase::plan(Duration loop) noexcept {
  const double resultant = std::hypot(cosines_, sines_) / count_;
  if (!(resultant >= kResultantMin)) return;
  const double sigma = std::sqrt(std::max(0.0, -2 * std::log(resultant))) / kTurn;
  const double wait = std::clamp(3 * sigma, kWaitMin, kWaitMax);
  const double error = std::remainder(std::atan2(sines_, cosines_) / kTurn - wait, 1.0);
  if (std::abs(error) < kNegligible) return;
  left_ = from_seconds(error * seconds(tick_));
  ignored_ = std::clamp<std::int64_t>(loop / tick_, 0, 10'000) + 2;
}

Duration TickPhase::next_shift() noexcept {
  const Duration most = tick_ / kTicksPerShift;
  const Duration shift = std::clamp(left_, -most, most);
  left_ -= shift;
  return shift;
}

}  // namespace tandem::client
