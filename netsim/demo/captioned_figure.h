#pragma once

#include <string>
#include <string_view>

#include "netsim/plot/svg_plot.h"

/// A figure of the report with its title and caption. Pure functions.
namespace tandem::netsim::demo {

struct CaptionedFigure {
  std::string anchor;   ///< "fig7"
  std::string title;    ///< "Figure 7: joint angles"
  std::string caption;  ///< sentences that describe what the figure shows
  plot::Figure figure;
};

/// Returns a <figure> element with the id `prefix-anchor`. It contains the drawing twice: at full width, and with one
/// column of panels for narrow screens, where scaled text is too small. The style sheet shows one of the two.
[[nodiscard]] std::string to_html(const CaptionedFigure& figure, std::string_view prefix);

}  // namespace tandem::netsim::demo
