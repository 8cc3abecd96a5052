#pragma once

#include <array>
#include <cstdint>

namespace tandem::netsim {

/// Separates first deliveries from copies, by the index of the datagram. An index that a newer one displaced from the
/// 1024 slots counts as a copy. The replay window of a connection has the same length.
class FirstSeenFilter {
 public:
  [[nodiscard]] bool is_first(std::uint64_t index) noexcept {
    std::uint64_t& place = seen_[index % seen_.size()];
    if (place >= index + 1) return false;
    place = index + 1;
    return true;
  }

 private:
  std::array<std::uint64_t, 1024> seen_{};
};

}  // namespace tandem::netsim
