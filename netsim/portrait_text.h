#pragma once

#include <cstddef>
#include <string>

#include "netsim/portrait.h"

/// Portraits for a terminal: pictures of delay over time and of its distribution. Pure.
namespace tandem::netsim {

struct PictureStyle {
  std::size_t width = 100;  ///< characters in a line; at least 40 are used
  bool utf8 = true;         ///< else plain ASCII
};

/// Delay over the time shown. Each character is a span of time and one of delay, and as dark as the share of what was
/// sent in that time that took so long; a line below is as dark as the share that was lost. The scale of delay is linear
/// when its ends are close and logarithmic when not.
[[nodiscard]] std::string delay_picture(const PortraitWay& way, Duration shown, const PictureStyle& style);

/// How many of all took how long, as bars on the same scale.
[[nodiscard]] std::string delay_histogram(const PortraitWay& way, const PictureStyle& style);

}  // namespace tandem::netsim
