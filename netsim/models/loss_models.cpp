#include "netsim/models/loss_models.h"

#include <algorithm>
#include <cmath>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

enum LossModelPurpose : std::uint64_t { kLossState = 1, kLoss, kLossFirst };

constexpr double kNsPerMs = 1e6;

LengthLaw law_of(const LossBurstsSpec& spec) noexcept {
  using Law = LossBurstsSpec::Law;
  const bool datagrams = spec.unit == LossBurstsSpec::Unit::kDatagrams;
  const double unit = datagrams ? 1 : kNsPerMs;
  LengthLaw law{.low = spec.length * unit, .high = spec.length * unit, .alpha = spec.alpha, .cap = spec.cap * unit};
  if (spec.law == Law::kParetoII) law.kind = LengthLaw::Kind::kParetoII;
  if (spec.law == Law::kGeometric) law.kind = LengthLaw::Kind::kExponential;
  if (!datagrams) return law;
  // One datagram is always lost; the law counts the further ones. The integer part of an exponential is geometric.
  if (spec.law == Law::kFixed) law.low = law.high = spec.length - 1;
  if (spec.law == Law::kGeometric) law.low = spec.length > 1 ? -1 / natural_log1p(-1 / spec.length) : 0;
  return law;
}

}  // namespace

GilbertElliott::GilbertElliott(const GilbertElliottSpec& spec, RandomKey key, std::uint64_t salt) noexcept
    : spec_(spec),
      state_key_(key.derive(kLossState)),
      loss_key_(key.derive(kLoss)),
      first_key_(key.derive(kLossFirst)) {
  begin(salt);
}

bool GilbertElliott::lost(std::uint64_t index) noexcept {
  if (state_key_.uniform(index) < (bad_ ? spec_.r : spec_.p)) bad_ = !bad_;
  return loss_key_.uniform(index) >= (bad_ ? spec_.h : spec_.k);
}

int FourState::next(double u) const noexcept {
  switch (state_) {
    case 1:
      return u < spec_.p14 ? 4 : u < spec_.p14 + spec_.p13 ? 3 : 1;
    case 2:
      return u < spec_.p23 ? 3 : 2;
    case 3:
      return u < spec_.p32 ? 2 : u < spec_.p32 + spec_.p31 ? 1 : 3;
    default:
      return 1;
  }
}

bool FourState::lost(std::uint64_t index) noexcept {
  state_ = next(key_.uniform(index));
  return state_ >= 3;
}

LossBursts::LossBursts(const LossBurstsSpec& spec, RandomKey key) noexcept
    : datagrams_(spec.unit == LossBurstsSpec::Unit::kDatagrams),
      cap_(static_cast<std::int64_t>(spec.cap)),
      bursts_(spec.rate_per_s, law_of(spec), key) {}

bool LossBursts::lost(Time now) noexcept {
  if (!datagrams_) return bursts_.end_of_chain(now) > now;
  bursts_.begun(last_, now, [this](const PoissonIntervals::Interval& burst) {
    remaining_ = std::max(remaining_, std::min(cap_, 1 + (burst.end - burst.start).count()));
  });
  last_ = now;
  if (remaining_ == 0) return false;
  --remaining_;
  return true;
}

bool LossPattern::lost(Time now, std::uint64_t index) noexcept {
  bool lost = false;
  if (spec_.of > 0) {
    // Selection sampling: probability = losses still due / datagrams still to come, so that the count is exact.
    const auto place = static_cast<std::uint32_t>(index % spec_.of);
    if (place == 0) lost_in_window_ = 0;
    if (key_.uniform(index | salt_) * (spec_.of - place) < spec_.lost - lost_in_window_) {
      ++lost_in_window_;
      lost = true;
    }
  }
  if (spec_.every > 0 && (index + 1) % spec_.every == 0) lost = true;
  if (next_index_ < spec_.indices.size() && spec_.indices[next_index_] == index) {
    ++next_index_;
    lost = true;
  }
  while (next_time_ < spec_.times.size() && now.time_since_epoch() >= spec_.times[next_time_]) {
    ++next_time_;
    lost = true;
  }
  return lost;
}

bool LossTracePlayer::lost(Time now, std::uint64_t index) const noexcept {
  const std::uint64_t entry = trace_->interval > Duration::zero()
                                  ? static_cast<std::uint64_t>(now.time_since_epoch() / trace_->interval)
                                  : index;
  return trace_->lost[entry % trace_->lost.size()];
}

}  // namespace tandem::netsim
