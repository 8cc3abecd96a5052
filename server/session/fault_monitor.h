#pragma once

#include <cstdint>
#include <optional>
#include <utility>

#include "common/base/time.h"

namespace tandem::server {

/// Detects a defective control step. One non-finite result may be a bad reading; two within a second show a fault.
class FaultMonitor {
 public:
  static constexpr Duration kMemory = std::chrono::seconds(1);

  /// @param not_finite  steps with a non-finite result so far; never falls
  /// @return true at the second such result within a second, and at each further one
  [[nodiscard]] bool faulty(Time now, std::uint64_t not_finite) noexcept {
    if (not_finite == std::exchange(not_finite_, not_finite)) return false;
    const std::optional<Time> before = std::exchange(last_, now);
    return before && now - *before < kMemory;
  }

 private:
  std::uint64_t not_finite_ = 0;
  std::optional<Time> last_;
};

}  // namespace tandem::server
