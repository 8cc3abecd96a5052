#pragma once

#include <algorithm>

#include "common/base/time.h"
#include "netsim/models/path_spec.h"

namespace tandem::netsim {

/// Time between two rounds of reading the sockets of a proxy: half of the least delay of all its links, past and
/// present. Reading after the arrival has no effect as long as no datagram can be due earlier.
class ReadingInterval {
 public:
  /// Takes a link into account that clients have or will have.
  void add(const LinkSpec& link) noexcept {
    least_delay_ = std::min({least_delay_, link.up.floor, link.down.floor});
    // Two cases require reading in order of arrival, without interval: a shared link, and decisions that wait for later
    // datagrams.
    immediately_ = immediately_ || link.shared || waits_for_others(link.up) || waits_for_others(link.down);
  }
  /// Returns the interval; 0: read at every arrival.
  [[nodiscard]] Duration value() const noexcept {
    const Duration interval = std::min(least_delay_ / 2, kMax);
    return interval < kMin || immediately_ ? Duration{} : interval;
  }

 private:
  /// The kernel's buffers limit the interval: a flood of 500 000 datagrams/s yields a thousand in 2 ms.
  static constexpr Duration kMax{2'000'000};
  static constexpr Duration kMin{100'000};

  Duration least_delay_ = Duration::max();
  bool immediately_ = false;
};

}  // namespace tandem::netsim
