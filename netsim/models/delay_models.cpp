#include "netsim/models/delay_models.h"

#include <algorithm>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

enum DelayPurpose : std::uint64_t { kDelayState = 1, kDelayLength, kDelayBody };
enum BoundaryPurpose : std::uint64_t { kBoundaryLoss = 1, kBoundaryStall, kBoundaryFloor };

constexpr std::int64_t kCycles = 256;

Duration between(Duration lo, Duration hi, double u) noexcept {
  return lo + Duration{static_cast<std::int64_t>(u * static_cast<double>((hi - lo).count() + 1))};
}

}  // namespace

Regimes::Regimes(const std::vector<RegimeSpec>& specs, RandomKey key)
    : state_key_(key.derive(kDelayState)), length_key_(key.derive(kDelayLength)) {
  for (std::size_t i = 0; i < specs.size(); ++i) {
    const double mean = static_cast<double>(specs[i].mean.count());
    mean_sum_ += mean;
    regimes_.push_back({mean, specs[i].floor, BodyDelay{specs[i].body, key.derive(kDelayBody).derive(i)}});
  }
  block_length_ = Duration{std::max<std::int64_t>(1, static_cast<std::int64_t>(mean_sum_) * kCycles)};
}

std::size_t Regimes::state_at(Time t) noexcept {
  const std::int64_t block = t.time_since_epoch() / block_length_;
  if (block != block_ || t < begin_) {
    block_ = block;
    draw_ = static_cast<std::uint64_t>(block) << kDrawBits;
    double place = state_key_.uniform(draw_) * mean_sum_;
    state_ = 0;
    while (state_ + 1 < regimes_.size() && place >= regimes_[state_].mean) place -= regimes_[state_++].mean;
    end_ = Time{block_length_ * block};
    next();
  }
  while (end_ <= t) {
    const auto others = static_cast<double>(regimes_.size() - 1);
    const auto other = static_cast<std::size_t>(state_key_.uniform(draw_) * others);
    state_ = other < state_ ? other : std::min(other + 1, regimes_.size() - 1);
    next();
  }
  return state_;
}

void Regimes::next() noexcept {
  const Time block_end{block_length_ * (block_ + 1)};
  constexpr std::uint64_t kLastDraw = (std::uint64_t{1} << kDrawBits) - 1;
  begin_ = end_;
  if ((draw_ & kLastDraw) == kLastDraw) {
    end_ = block_end;
    return;
  }
  const double length = regimes_[state_].mean * exponential_quantile(length_key_.uniform(draw_++));
  end_ = std::min(block_end, end_ + Duration{std::max<std::int64_t>(1, static_cast<std::int64_t>(length))});
}

Duration Regimes::drawn(Time t, std::uint64_t index) noexcept {
  Regime& regime = regimes_[state_at(t)];
  return regime.floor + regime.body.at(t, index);
}

Boundary::Boundary(const BoundarySpec& spec, RandomKey key) noexcept
    : spec_(spec),
      loss_key_(key.derive(kBoundaryLoss)),
      stall_key_(key.derive(kBoundaryStall)),
      floor_key_(key.derive(kBoundaryFloor)) {
  if (spec.period == Duration::zero()) {
    spec_ = {};
    spec_.period = Duration::max();
    spec_.phase = Duration::max();
  }
}

std::int64_t Boundary::number(Time t) const noexcept {
  const Duration into = t.time_since_epoch() - spec_.phase;
  return into < Duration::zero() ? -1 : into / spec_.period;
}

Duration Boundary::since(Time t) const noexcept {
  const Duration into = t.time_since_epoch() - spec_.phase;
  return into < Duration::zero() ? Duration::max() : into % spec_.period;
}

Duration Boundary::floor(Time t) const noexcept {
  if (spec_.floor_high == Duration::zero()) return Duration::zero();
  return between(Duration::zero(), spec_.floor_high, floor_key_.uniform(static_cast<std::uint64_t>(number(t) + 1)));
}

Time Boundary::release(Time t) const noexcept {
  if (spec_.stall_high == Duration::zero()) return t;
  const std::int64_t here = number(t);
  if (here < 0) return t;
  const Duration stall =
      between(spec_.stall_low, spec_.stall_high, stall_key_.uniform(static_cast<std::uint64_t>(here)));
  return std::max(t, Time{spec_.phase + spec_.period * here} + stall);
}

Time Slots::release(Time due, std::size_t size) noexcept {
  if (spec_.period == Duration::zero()) return due;
  const Duration since = due.time_since_epoch();
  const std::int64_t wanted = since / spec_.period + (since % spec_.period > Duration::zero() ? 1 : 0);
  const bool full = (spec_.datagrams > 0 && datagrams_ >= spec_.datagrams) ||
                    (spec_.bytes > 0 && datagrams_ > 0 && bytes_ + size > spec_.bytes);
  if (wanted > slot_ || full) {
    slot_ = std::max(wanted, slot_ + 1);
    datagrams_ = bytes_ = 0;
  }
  ++datagrams_;
  bytes_ += size;
  return Time{spec_.period * slot_};
}

}  // namespace tandem::netsim
