#include "server/policy/load_shedder.h"

#include <algorithm>

#include "common/base/enumerator_count.h"

namespace tandem::server {

static_assert(kShedLevels == enumerator_count<ShedLevel>());

namespace {
constexpr std::uint32_t kTenth = 10;  // 1/10 of a window's ticks; fewer are outliers

constexpr ShedLevel kLastOfTicks = ShedLevel::kEvaluatorsEvery3rd;  // above it the share of the thread decides

constexpr ShedLevel next(ShedLevel rung, int by) noexcept {
  return static_cast<ShedLevel>(static_cast<int>(rung) + by);
}
}  // namespace

LoadShedder::LoadShedder(Duration period) noexcept
    : period_(period), window_(static_cast<std::uint32_t>(std::max<std::int64_t>(1, kWindow / period))) {}

LoadState LoadShedder::step(Time now, Duration late, Duration used, Duration worked) noexcept {
  const double strain = std::max(seconds(used) / seconds(period_), seconds(late) / seconds(kLateMost));
  const ShedLevel rung = load_state_.level;
  above_ += rung < kLastOfTicks && strain > threshold(next(rung, 1)) ? 1 : 0;
  above_release_ += rung > ShedLevel::kNone && strain > threshold(rung) - kHysteresis ? 1 : 0;
  worked_ += worked;
  if (window_began_ == Time{}) window_began_ = now - period_;
  if (++ticks_ >= window_) update_level(now);
  update_overload(now, late);
  return load_state_;
}

void LoadShedder::update_level(Time now) noexcept {
  const double share = now > window_began_ ? seconds(worked_) / seconds(now - window_began_) : 0;
  constexpr double kLimit = threshold(ShedLevel::kNewJoins);
  const ShedLevel rung = load_state_.level;
  const bool rises = rung == kLastOfTicks ? share > kLimit : above_ * kTenth > window_;
  const bool stays =
      rung == ShedLevel::kNewJoins ? share > kLimit - kHysteresisOfJoins : above_release_ * kTenth > window_;
  if (rises) {
    level_backoff_.on_overload(now);
    load_state_.level = next(load_state_.level, 1);
    last_busy_window_ = now;
  } else if (stays) {
    last_busy_window_ = now;
  } else if (load_state_.level > ShedLevel::kNone && now - last_busy_window_ >= level_backoff_.wait()) {
    load_state_.level = next(load_state_.level, -1);
    last_busy_window_ = now;
    level_backoff_.on_recovery(now);
  }
  ticks_ = above_ = above_release_ = 0;
  worked_ = {};
  window_began_ = now;
}

void LoadShedder::update_overload(Time now, Duration late) noexcept {
  late_ = late > kLateMost ? std::min(late_ + 1, kLateTicks) : 0;
  if (late_ == kLateTicks) {
    if (!load_state_.overloaded) overload_backoff_.on_overload(now);
    load_state_.overloaded = true;
    last_overload_ = now;
  } else if (load_state_.overloaded && now - last_overload_ >= overload_backoff_.wait()) {
    load_state_.overloaded = false;
    overload_backoff_.on_recovery(now);
  }
}

}  // namespace tandem::server
