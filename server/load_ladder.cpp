#include "server/load_ladder.h"

#include <algorithm>

namespace tandem::server {

namespace {
constexpr std::uint32_t kTenth = 10;  // of a window's ticks: fewer are stragglers

constexpr Rung next(Rung rung, int by) noexcept { return static_cast<Rung>(static_cast<int>(rung) + by); }
}  // namespace

LoadLadder::LoadLadder(Duration period) noexcept
    : period_(period), window_(static_cast<std::uint32_t>(std::max<std::int64_t>(1, kWindow / period))) {}

Relief LoadLadder::step(Time now, Duration late, Duration used) noexcept {
  const double cost = seconds(used) / seconds(period_), strain = std::max(cost, seconds(late) / seconds(kLateMost));
  const auto on = [&](Rung rung) { return rung == Rung::kNewcomers ? cost : strain; };
  const Rung rung = relief_.rung;
  above_ += rung < Rung::kNewcomers && on(next(rung, 1)) > threshold(next(rung, 1)) ? 1 : 0;
  not_calm_ += rung > Rung::kNothing && on(rung) > threshold(rung) - kHysteresis ? 1 : 0;
  if (++ticks_ >= window_) judge_window(now);
  judge_lateness(now, late);
  return relief_;
}

void LoadLadder::judge_window(Time now) noexcept {
  if (above_ * kTenth > window_) {
    rungs_.troubled(now);
    relief_.rung = next(relief_.rung, 1);
    restless_ = now;
  } else if (not_calm_ * kTenth > window_) {
    restless_ = now;
  } else if (relief_.rung > Rung::kNothing && now - restless_ >= rungs_.wait()) {
    relief_.rung = next(relief_.rung, -1);
    restless_ = now;
    rungs_.eased(now);
  }
  ticks_ = above_ = not_calm_ = 0;
}

void LoadLadder::judge_lateness(Time now, Duration late) noexcept {
  late_ = late > kLateMost ? std::min(late_ + 1, kLateTicks) : 0;
  if (late_ == kLateTicks) {
    if (!relief_.passive) hands_.troubled(now);
    relief_.passive = true;
    too_late_ = now;
  } else if (relief_.passive && now - too_late_ >= hands_.wait()) {
    relief_.passive = false;
    hands_.eased(now);
  }
}

}  // namespace tandem::server
