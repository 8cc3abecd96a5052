#include "netsim/feel/feel_trace.h"

#include <algorithm>

namespace tandem::netsim {

std::pair<std::size_t, std::size_t> FeelTrace::window(double from, double to) const noexcept {
  const auto row = [&](double at) {
    return static_cast<std::size_t>(std::ranges::lower_bound(t, at - 1e-9) - t.begin());
  };
  const std::size_t first = row(from);
  return {first, std::max(first, row(to))};
}

}  // namespace tandem::netsim
