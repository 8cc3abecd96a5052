#pragma once

#include <cstddef>
#include <string>

#include "netsim/profiles/profile_preview.h"

/// Profile previews for a terminal: delay over time and its distribution. Pure functions.
namespace tandem::netsim {

/// Size and character set of a text picture.
struct PictureStyle {
  std::size_t width = 100;  ///< characters per line, at least 40
  bool utf8 = true;         ///< false: plain ASCII
};

/// Draws delay over the shown time. Each character is one interval of time and one of delay. Its darkness is the share
/// of datagrams sent in that time with such a delay. A further line shows the share of lost datagrams. The delay scale
/// is linear if its ends are close, else logarithmic.
[[nodiscard]] std::string delay_picture(const ProfilePreviewDirection& way, Duration shown, const PictureStyle& style);

/// Draws the distribution of all delays as bars on the same scale.
[[nodiscard]] std::string delay_histogram(const ProfilePreviewDirection& way, const PictureStyle& style);

}  // namespace tandem::netsim
