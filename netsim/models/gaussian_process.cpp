#include "netsim/models/gaussian_process.h"

#include <algorithm>
#include <bit>
#include <cmath>

#include "netsim/models/distributions.h"

namespace tandem::netsim {
namespace {

constexpr std::int64_t kBlockTaus = 16;
constexpr Duration kStepMax{1'000'000};

}  // namespace

GaussianProcess::GaussianProcess(Duration tau, RandomKey key) noexcept : key_(key) {
  const Duration block = tau * kBlockTaus;
  const Duration step_wanted = std::min(kStepMax, tau / 8);
  while (levels_ < kLevelsMax && (block / (std::int64_t{1} << levels_)) > step_wanted) ++levels_;
  const std::int64_t steps = std::int64_t{1} << levels_;
  step_ = Duration{(block.count() + steps - 1) / steps};
  for (int level = 0; level < levels_; ++level) {
    const Duration half = step_ * (steps >> (level + 1));
    // Conditions the midpoint on block ends that were drawn independently.
    const double b = natural_exp(-seconds(half) / seconds(tau));
    midpoint_[static_cast<std::size_t>(level)] = {b / (1 + b * b), std::sqrt((1 - b * b) / (1 + b * b))};
  }
  step_correlation_ = natural_exp(-seconds(step_) / seconds(tau));
}

double GaussianProcess::draw(std::int64_t block, std::uint64_t node) const noexcept {
  const std::uint64_t counter = (static_cast<std::uint64_t>(block) << kLevelsMax) | node;
  return normal_quantile(open_unit(key_.uniform(counter)));
}

double GaussianProcess::at(Time t) noexcept {
  const std::int64_t steps = t.time_since_epoch() / step_;
  const std::int64_t block = steps >> levels_;
  const auto leaf = static_cast<std::uint32_t>(steps - (block << levels_));
  if (block != block_) {
    // Node 0 of a block is its left end; inner midpoints are numbered from 1, as in a heap.
    level_[0].lo = block == block_ + 1 && block_ >= 0 ? level_[0].hi : draw(block, 0);
    level_[0].hi = draw(block + 1, 0);
    block_ = block;
    descend(0, leaf);
  } else if (leaf != leaf_) {
    descend(levels_ - static_cast<int>(std::bit_width(leaf ^ leaf_)), leaf);
  }
  leaf_ = leaf;
  const Level& ends = level_[static_cast<std::size_t>(levels_)];
  const double w =
      static_cast<double>((t.time_since_epoch() - step_ * steps).count()) / static_cast<double>(step_.count());
  const double v = 1 - w;
  return (v * ends.lo + w * ends.hi) / std::sqrt(v * v + w * w + 2 * v * w * step_correlation_);
}

void GaussianProcess::descend(int from, std::uint32_t leaf) noexcept {
  for (int level = from; level < levels_; ++level) {
    const auto here = static_cast<std::size_t>(level);
    const std::uint32_t prefix = leaf >> (levels_ - level);
    const Midpoint& midpoint = midpoint_[here];
    const Level& ends = level_[here];
    const double middle =
        midpoint.weight * (ends.lo + ends.hi) + midpoint.sd * draw(block_, (std::uint64_t{1} << level) + prefix);
    const bool right = ((leaf >> (levels_ - level - 1)) & 1) != 0;
    level_[here + 1] = right ? Level{middle, ends.hi} : Level{ends.lo, middle};
  }
}

}  // namespace tandem::netsim
