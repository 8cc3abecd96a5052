#include "netsim/models/loss.h"

#include <algorithm>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

enum LossPurpose : std::uint64_t {
  kAlone = 1,
  kInPeriod,
  kPeriods,
  kGilbertElliott,
  kFourState,
  kBursts,
  kPattern,
  kInQueue,
  kInStall
};

}  // namespace

BadPeriods::BadPeriods(const BadPeriodsSpec& spec, RandomKey key) noexcept
    : key_(key),
      good_mean_(spec.good_mean),
      bad_mean_(spec.bad_mean),
      bad_share_(seconds(spec.bad_mean) / (seconds(spec.good_mean) + seconds(spec.bad_mean))),
      block_length_((spec.good_mean + spec.bad_mean) * static_cast<std::int64_t>(kCycles)) {}

bool BadPeriods::bad_at(Time t) noexcept {
  const std::int64_t block = t.time_since_epoch() / block_length_;
  if (block != block_) start_block(block);
  while (end_ <= t) next_period();  // terminates: the last draw of a block lasts until the end of the block
  return bad_;
}

void BadPeriods::start_block(std::int64_t block) noexcept {
  block_ = block;
  draw_ = static_cast<std::uint64_t>(block) << kDrawBits;
  bad_ = !(key_.uniform(draw_++) < bad_share_);  // next_period inverts it
  end_ = Time{block_length_ * block};
  next_period();
}

void BadPeriods::next_period() noexcept {
  bad_ = !bad_;
  const Time block_end{block_length_ * (block_ + 1)};
  constexpr std::uint64_t kLastDraw = (std::uint64_t{1} << kDrawBits) - 1;
  if ((draw_ & kLastDraw) == kLastDraw) {
    end_ = block_end;
    return;
  }
  const double mean = static_cast<double>((bad_ ? bad_mean_ : good_mean_).count());
  const auto length = static_cast<std::int64_t>(mean * exponential_quantile(key_.uniform(draw_++)));
  end_ = std::min(block_end, end_ + Duration{std::max<std::int64_t>(length, 1)});
}

Loss::Loss(const LossSpec& spec, RandomKey key, std::uint64_t salt)
    : probability_(spec.probability),
      salt_(salt),
      models_(spec.periods || spec.gilbert_elliott || spec.four_state || spec.bursts || spec.pattern || spec.trace),
      independent_key_(key.derive(kAlone)),
      period_key_(key.derive(kInPeriod)),
      queue_key_(key.derive(kInQueue)),
      stall_key_(key.derive(kInStall)),
      congestion_(spec.congestion) {
  if (spec.periods) {
    loss_good_ = spec.periods->loss_good;
    loss_bad_ = spec.periods->loss_bad;
    periods_.emplace(*spec.periods, key.derive(kPeriods));
  }
  if (spec.gilbert_elliott) gilbert_elliott_.emplace(*spec.gilbert_elliott, key.derive(kGilbertElliott), salt);
  if (spec.four_state) four_state_.emplace(*spec.four_state, key.derive(kFourState));
  if (spec.bursts) bursts_.emplace(*spec.bursts, key.derive(kBursts));
  if (spec.pattern) pattern_.emplace(*spec.pattern, key.derive(kPattern), salt);
  if (spec.trace) player_.emplace(spec.trace);
}

void Loss::set_salt(std::uint64_t salt) noexcept {
  salt_ = salt;
  if (gilbert_elliott_) gilbert_elliott_->begin(salt);
  if (pattern_) pattern_->set_salt(salt);
}

bool Loss::lost_by_model(Time now, std::uint64_t index) noexcept {
  bool lost = false;
  const std::uint64_t draw = index | salt_;
  if (periods_) lost = period_key_.uniform(draw) < (periods_->bad_at(now) ? loss_bad_ : loss_good_);
  if (gilbert_elliott_ && gilbert_elliott_->lost(draw)) lost = true;
  if (four_state_ && four_state_->lost(draw)) lost = true;
  if (bursts_ && bursts_->lost(now)) lost = true;
  if (pattern_ && pattern_->lost(now, index)) lost = true;
  if (player_ && player_->lost(now, index)) lost = true;
  return lost;
}

bool Loss::lost_in_queue(Duration wait, std::uint64_t index) const noexcept {
  if (!congestion_ || wait <= congestion_->wait_low) return false;
  const Duration span = congestion_->wait_high - congestion_->wait_low;
  const double share = std::min(1.0, seconds(wait - congestion_->wait_low) / seconds(span));
  return queue_key_.uniform(index | salt_) < congestion_->probability * share;
}

}  // namespace tandem::netsim
