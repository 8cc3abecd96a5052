#include "netsim/plot/downsample.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim::plot {
namespace {

std::vector<Point2> finite_only(std::span<const Point2> curve) {
  std::vector<Point2> out;
  out.reserve(curve.size());
  for (const Point2& p : curve)
    if (std::isfinite(p.x) && std::isfinite(p.y)) out.push_back(p);
  return out;
}

std::vector<Point2> with_step(const std::vector<Point2>& path, double step) {
  std::vector<Point2> out{path.front()};
  for (std::size_t k = 1; k + 1 < path.size(); ++k) {
    const double dx = path[k].x - out.back().x, dy = path[k].y - out.back().y;
    if (dx * dx + dy * dy >= step * step) out.push_back(path[k]);
  }
  out.push_back(path.back());
  return out;
}

}  // namespace

std::vector<Point2> downsample_extremes(std::span<const Point2> curve, std::size_t most) {
  std::vector<Point2> all = finite_only(curve);
  most = std::max<std::size_t>(most, 4);
  if (all.size() <= most) return all;
  // Between the two ends, every bucket gives two points.
  const std::size_t buckets = (most - 2) / 2, inner = all.size() - 2;
  std::vector<Point2> out{all.front()};
  out.reserve(most);
  for (std::size_t b = 0; b < buckets; ++b) {
    const auto begin = all.begin() + 1 + static_cast<std::ptrdiff_t>(b * inner / buckets);
    const auto end = all.begin() + 1 + static_cast<std::ptrdiff_t>((b + 1) * inner / buckets);
    if (begin == end) continue;
    const auto by_y = [](const Point2& p, const Point2& q) { return p.y < q.y; };
    auto [low, high] = std::minmax_element(begin, end, by_y);
    if (low > high) std::swap(low, high);
    out.push_back(*low);
    if (high != low) out.push_back(*high);
  }
  out.push_back(all.back());
  return out;
}

std::vector<Point2> downsample_path(std::span<const Point2> path, double step, std::size_t most) {
  std::vector<Point2> all = finite_only(path);
  if (all.size() <= 2 || !(step > 0)) return all;
  std::vector<Point2> out = with_step(all, step);
  while (out.size() > std::max<std::size_t>(most, 2)) {
    step *= 2;
    out = with_step(all, step);
    if (!std::isfinite(step)) break;
  }
  return out;
}

}  // namespace tandem::netsim::plot
