#pragma once

#include <array>
#include <cstdint>

namespace tandem::netsim {

/// Tells copies from datagrams that came for the first time, by their index; of those far behind the newest it says nothing is new,
/// as no end lets them act (the replay window is as long).
class Distinct {
 public:
  [[nodiscard]] bool first(std::uint64_t index) noexcept {
    std::uint64_t& place = seen_[index % seen_.size()];
    if (place >= index + 1) return false;
    place = index + 1;
    return true;
  }

 private:
  std::array<std::uint64_t, 1024> seen_{};
};

}  // namespace tandem::netsim
