#pragma once

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <utility>
#include <vector>

namespace tandem::netsim {

/// Order in which the clients of a simulation run within a tick: by the time at which they wake up, then by number.
/// Clients send in this order, so that on a shared link no datagram enters before an older one.
class WakeOrder {
 public:
  /// @param clients  how many, numbered from 0
  explicit WakeOrder(std::size_t clients) : order_(clients) { std::iota(order_.begin(), order_.end(), std::size_t{0}); }

  /// Returns the numbers of all clients in order. Allocates nothing.
  /// @param wake_time  returns the time at which a client wakes up in this tick
  template <typename WakeTime>
  const std::vector<std::size_t>& sort(const WakeTime& wake_time) {
    std::ranges::sort(order_, {}, [&](std::size_t client) { return std::pair{wake_time(client), client}; });
    return order_;
  }

 private:
  std::vector<std::size_t> order_;
};

}  // namespace tandem::netsim
