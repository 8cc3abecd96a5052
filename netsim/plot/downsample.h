#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Fewer points that draw the same picture. Pure.
namespace tandem::netsim::plot {

struct Point2 {
  double x = 0, y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// A curve over an ascending x: the span is cut into equal numbers of samples, and of each the lowest and the highest
/// are kept, in order, so that no peak is lost. First and last points stay. Points that are not finite are left out.
/// @param most  at least 4; the result never has more points
[[nodiscard]] std::vector<Point2> downsample_extremes(std::span<const Point2> curve, std::size_t most);

/// A path in a plane (x goes back and forth): a point is kept when it is at least `step` away from the last one kept,
/// and the ends always; while there are still more than `most`, the step is doubled.
/// @param step  in units of the axes; > 0
[[nodiscard]] std::vector<Point2> downsample_path(std::span<const Point2> path, double step, std::size_t most);

}  // namespace tandem::netsim::plot
