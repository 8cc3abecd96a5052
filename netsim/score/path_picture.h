#pragma once

#include <string>
#include <vector>

#include "netsim/score/triple.h"

namespace tandem::netsim::score {

/// A piece of a path with one colour.
struct PathPiece {
  std::string ink;                   ///< class of netsim/plot/plot_style.h
  std::string label;                 ///< in the legend, once per picture
  std::vector<LessonTriple> points;  ///< [m]
};

/// Isometric picture of paths as one <svg> element: x to the lower right, y to the upper right, z up, one scale for
/// all. The floor of the bounding box carries the shadow of the last piece's path; its edges state the lengths. Begin
/// and end of the first and last piece are marked. Points that are not finite are left out.
/// @param description  for readers who cannot see the drawing
[[nodiscard]] std::string isometric_picture(const std::vector<PathPiece>& pieces, const std::string& description);

}  // namespace tandem::netsim::score
