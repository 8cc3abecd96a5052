#include "client/diagnostics/transit_time.h"

#include <algorithm>
#include <cstdlib>

namespace tandem::client {

void TransitTime::add(Time arrived, Duration sent) noexcept {
  const std::int64_t transit = (arrived.time_since_epoch() - sent).count();
  if (!second_began_) {
    second_began_ = arrived;
    floor_ = second_floor_ = transit;
  }
  if (arrived - *second_began_ >= std::chrono::seconds(1)) {
    if (floors_.size() < kSecondsMax) floors_.push_back(second_floor_);
    second_floor_ = transit;
    *second_began_ = arrived;
  }
  second_floor_ = std::min(second_floor_, transit);
  floor_ = std::min(floor_, transit);
  delay_.add(transit - floor_);
}

std::optional<double> TransitTime::largest_step() const noexcept {
  if (floors_.size() < 2) return std::nullopt;
  std::int64_t step = 0;
  for (std::size_t i = 1; i < floors_.size(); ++i) {
    const std::int64_t change = floors_[i] - floors_[i - 1];
    if (std::abs(change) > std::abs(step)) step = change;
  }
  return seconds(Duration{step});
}

}  // namespace tandem::client
