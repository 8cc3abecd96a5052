#pragma once

#include <array>
#include <cstdint>

#include "common/base/time.h"

namespace tandem::control {

/// Counts the losses of a link. Three within 10 s are to be latched: a flapping link would release a full tank at every
/// loss.
class LossLatch {
 public:
  static constexpr std::uint32_t kLosses = 3;
  static constexpr Duration kWindow = std::chrono::seconds(10);

  /// Records a loss. @return whether it is the third within 10 s
  bool record(Time now) noexcept {
    at_[++trips_ % kLosses] = now;
    return trips_ >= kLosses && now - at_[(trips_ + 1) % kLosses] <= kWindow;
  }
  /// Number of losses so far.
  [[nodiscard]] std::uint32_t trips() const noexcept { return trips_; }

 private:
  std::uint32_t trips_ = 0;
  std::array<Time, kLosses> at_{};  ///< times of the last three losses
};

}  // namespace tandem::control
