#pragma once

#include <array>
#include <string>
#include <vector>

#include "netsim/plot/svg_plot.h"
#include "netsim/portrait.h"

namespace tandem::netsim {

/// A quantile somebody promised, drawn as a dot.
struct PromisedQuantile {
  Direction direction = Direction::kUp;
  double share = 0;  ///< (0, 1)
  double delay_ms = 0;
};

/// Delay over the time shown, each way, with losses as marks along the lower edge and outages of 5 ms and more shaded; and
/// both distributions, by nines, so that the tail is seen. Pure.
[[nodiscard]] plot::Figure portrait_figure(const Portrait& portrait, const std::string& title,
                                           const std::vector<PromisedQuantile>& promised);

}  // namespace tandem::netsim
