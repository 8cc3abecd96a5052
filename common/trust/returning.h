#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "common/base/time.h"
#include "common/trust/origin.h"

namespace tandem::trust {

/// Addresses that somebody on a seat came from within the last `kLife`: whoever lost a connection comes back from there before a resume
/// secret runs out. Only addresses behind which a seat was given are noted, so strangers cannot fill it. Full: the oldest note goes.
class ReturningAddresses {
 public:
  static constexpr Duration kLife = std::chrono::minutes(15);  ///< a resume secret is good for 10 min after its connection was lost
  static constexpr std::size_t kMax = 2048;

  void note(const Origin& origin, Time now) {
    noted_[origin] = now;
    if (noted_.size() > kMax) noted_.erase(std::ranges::min_element(noted_, {}, [](const auto& entry) { return entry.second; }));
  }
  [[nodiscard]] bool contains(const Origin& origin, Time now) const {
    const auto found = noted_.find(origin);
    return found != noted_.end() && now - found->second <= kLife;
  }

 private:
  std::map<Origin, Time> noted_;
};

}  // namespace tandem::trust
