#include "server/policy/load_shedder.h"

#include <algorithm>

#include "common/base/enumerator_count.h"

namespace tandem::server {

static_assert(kShedLevels == enumerator_count<ShedLevel>());

namespace {
constexpr std::uint32_t kTenth = 10;  // 1/10 of a window's ticks; fewer are outliers

constexpr ShedLevel next(ShedLevel rung, int by) noexcept {
  return static_cast<ShedLevel>(static_cast<int>(rung) + by);
}
}  // namespace

LoadShedder::LoadShedder(Duration period) noexcept
    : period_(period), window_(static_cast<std::uint32_t>(std::max<std::int64_t>(1, kWindow / period))) {}

LoadState LoadShedder::step(Time now, Duration late, Duration used) noexcept {
  const double cost = seconds(used) / seconds(period_), strain = std::max(cost, seconds(late) / seconds(kLateMost));
  const auto on = [&](ShedLevel rung) { return rung == ShedLevel::kNewJoins ? cost : strain; };
  const ShedLevel rung = load_state_.level;
  above_ += rung < ShedLevel::kNewJoins && on(next(rung, 1)) > threshold(next(rung, 1)) ? 1 : 0;
  above_release_ += rung > ShedLevel::kNone && on(rung) > threshold(rung) - kHysteresis ? 1 : 0;
  if (++ticks_ >= window_) update_level(now);
  update_overload(now, late);
  return load_state_;
}

void LoadShedder::update_level(Time now) noexcept {
  if (above_ * kTenth > window_) {
    level_backoff_.on_overload(now);
    load_state_.level = next(load_state_.level, 1);
    last_busy_window_ = now;
  } else if (above_release_ * kTenth > window_) {
    last_busy_window_ = now;
  } else if (load_state_.level > ShedLevel::kNone && now - last_busy_window_ >= level_backoff_.wait()) {
    load_state_.level = next(load_state_.level, -1);
    last_busy_window_ = now;
    level_backoff_.on_recovery(now);
  }
  ticks_ = above_ = above_release_ = 0;
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
