#pragma once

#include <algorithm>
#include <cstddef>
#include <map>

#include "common/auth/origin.h"
#include "common/base/time.h"

namespace tandem::auth {

/// Addresses from which a seat was joined within the last `kLife`. A client that lost its connection returns from there
/// before its resume secret expires. Only addresses of joined seats are stored, so unknown senders cannot fill the
/// table. When it is full, the oldest entry is replaced.
class ReturningAddresses {
 public:
  static constexpr Duration kLife =
      std::chrono::minutes(15);  ///< a resume secret is valid for 10 min after its connection was lost
  static constexpr std::size_t kMax = 2048;

  void note(const Origin& origin, Time now) {
    noted_[origin] = now;
    if (noted_.size() > kMax)
      noted_.erase(std::ranges::min_element(noted_, {}, [](const auto& entry) { return entry.second; }));
  }
  [[nodiscard]] bool contains(const Origin& origin, Time now) const {
    const auto found = noted_.find(origin);
    return found != noted_.end() && now - found->second <= kLife;
  }

 private:
  std::map<Origin, Time> noted_;
};

}  // namespace tandem::auth
