#pragma once

#include <array>
#include <string>
#include <vector>

#include "netsim/plot/svg_plot.h"
#include "netsim/profiles/profile_preview.h"

namespace tandem::netsim {

/// Expected quantile of the delay, drawn as a dot.
struct ExpectedQuantile {
  Direction direction = Direction::kUp;
  double share = 0;  ///< (0, 1)
  double delay_ms = 0;
};

/// Draws a preview: delay over the shown time for each direction, and both distributions on a scale of nines, which
/// resolves the tail. Losses are marks along the lower edge; outages of at least 5 ms are shaded. Pure function.
[[nodiscard]] plot::Figure profile_preview_figure(const ProfilePreview& portrait, const std::string& title,
                                                  const std::vector<ExpectedQuantile>& promised);

}  // namespace tandem::netsim
