#pragma once

#include <string>
#include <string_view>

#include "netsim/plot/svg_plot.h"

/// A figure of the report with its title and caption. Pure.
namespace tandem::netsim::demo {

struct CaptionedFigure {
  std::string anchor;   ///< "fig7"
  std::string title;    ///< "Figure 7: joint angles"
  std::string caption;  ///< what to look at, in sentences
  plot::Figure figure;
};

/// A <figure> element with the id `prefix-anchor`. It holds the drawing twice: at full width, and for narrow screens
/// with one column of panels, where scaled text would be too small. The style sheet shows one of the two.
[[nodiscard]] std::string to_html(const CaptionedFigure& figure, std::string_view prefix);

}  // namespace tandem::netsim::demo
