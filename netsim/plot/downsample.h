#pragma once

#include <cstddef>
#include <span>
#include <vector>

/// Reduces the number of points of a curve without a visible change. Pure functions.
namespace tandem::netsim::plot {

struct Point2 {
  double x = 0, y = 0;
  friend bool operator==(const Point2&, const Point2&) = default;
};

/// Reduces a curve over an ascending x. The samples are divided into parts of equal count; of each part the lowest and
/// the highest point are kept, in order, so that no peak is lost. First and last points stay. Points that are not
/// finite are left out.
/// @param most  at least 4; the result never has more points
[[nodiscard]] std::vector<Point2> downsample_extremes(std::span<const Point2> curve, std::size_t most);

/// Reduces a path in a plane, where x may decrease. A point is kept if it is at least `step` away from the last kept
/// one; both ends are always kept. While more than `most` points remain, the step is doubled.
/// @param step  in units of the axes; > 0
[[nodiscard]] std::vector<Point2> downsample_path(std::span<const Point2> path, double step, std::size_t most);

}  // namespace tandem::netsim::plot
