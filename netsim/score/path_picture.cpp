#include "netsim/score/path_picture.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "common/base/format.h"
#include "netsim/plot/downsample.h"
#include "netsim/plot/svg_plot.h"

namespace tandem::netsim::score {
namespace {

constexpr double kWidth = 640, kMargin = 40, kLegendRow = 22;
constexpr double kLabelRoom = 112;  // left of the drawing, for the label of its upright edge
constexpr double kDrawing = kWidth - kLabelRoom - kMargin;
constexpr double kBoxMin = 0.010;                            // [m] shortest edge of the box
constexpr std::size_t kPointsMax = 1500;                     // per piece
constexpr double kCosine = 0.8660254037844386, kSine = 0.5;  // of 30 degrees

/// Bounding box and projection.
class Isometric {
 public:
  explicit Isometric(const std::vector<PathPiece>& pieces) {
    LessonTriple low{INFINITY, INFINITY, INFINITY}, high{-INFINITY, -INFINITY, -INFINITY};
    for (const PathPiece& piece : pieces)
      for (const LessonTriple& p : piece.points)
        for (std::size_t c = 0; c < 3 && known(p); ++c) {
          low[c] = std::min(low[c], p[c]);
          high[c] = std::max(high[c], p[c]);
        }
    for (std::size_t c = 0; c < 3; ++c) {
      const double middle = low[c] <= high[c] ? (low[c] + high[c]) / 2 : 0;
      const double half = low[c] <= high[c] ? std::max(high[c] - low[c], kBoxMin) / 2 : kBoxMin / 2;
      low_[c] = middle - half;
      high_[c] = middle + half;
    }
    const LessonTriple size = minus(high_, low_);
    const double wide = (size[0] + size[1]) * kCosine, tall = size[2] + (size[0] + size[1]) * kSine;
    scale_ = std::min(kDrawing / wide, kDrawing * 0.8 / tall);
    left_ = kLabelRoom + (kDrawing - wide * scale_) / 2;
    height_ = tall * scale_;
  }

  /// Position in the drawing [px].
  [[nodiscard]] plot::Point2 at(const LessonTriple& p) const {
    const double x = p[0] - low_[0], y = p[1] - low_[1], z = p[2] - low_[2];
    const double base = (high_[0] - low_[0]) * kSine;  // depth of the lowest corner below the nearest left one
    return {left_ + (x + y) * kCosine * scale_, kMargin + height_ - (z + (y - x) * kSine + base) * scale_};
  }
  /// Corner of the box; 0: lower end of an axis, 1: upper end.
  [[nodiscard]] LessonTriple corner(int x, int y, int z) const {
    return {x == 0 ? low_[0] : high_[0], y == 0 ? low_[1] : high_[1], z == 0 ? low_[2] : high_[2]};
  }
  [[nodiscard]] double edge(std::size_t axis) const { return high_[axis] - low_[axis]; }
  [[nodiscard]] double floor() const { return low_[2]; }
  [[nodiscard]] double height() const { return height_ + 2 * kMargin; }

 private:
  LessonTriple low_{}, high_{};
  double scale_ = 1, left_ = 0, height_ = 0;
};

std::string path_of_points(const std::vector<plot::Point2>& points) {
  std::string d;
  for (const plot::Point2& p : points) d += format("%s%.1f %.1f", d.empty() ? "M" : "L", p.x, p.y);
  return d;
}

std::string drawn(const Isometric& box, const PathPiece& piece, bool shadow) {
  std::vector<plot::Point2> points;
  for (LessonTriple p : piece.points) {
    if (!known(p)) continue;
    if (shadow) p[2] = box.floor();
    points.push_back(box.at(p));
  }
  if (points.size() < 2) return {};
  return format("<path class=\"line %s\"%s d=\"", shadow ? "grid" : piece.ink.c_str(),
                shadow ? " style=\"stroke-width:2.5\"" : "") +
         path_of_points(plot::downsample_path(points, 1.0, kPointsMax)) + "\"/>";
}

std::string edge_line(const Isometric& box, const LessonTriple& a, const LessonTriple& b) {
  const plot::Point2 from = box.at(a), to = box.at(b);
  return format("<line class=\"grid\" x1=\"%.1f\" y1=\"%.1f\" x2=\"%.1f\" y2=\"%.1f\"/>", from.x, from.y, to.x, to.y);
}

std::string edge_label(const Isometric& box, const LessonTriple& a, const LessonTriple& b, const std::string& text,
                       double dx, double dy, const char* anchor) {
  const plot::Point2 from = box.at(a), to = box.at(b);
  return format("<text class=\"tick %s\" x=\"%.1f\" y=\"%.1f\">", anchor, (from.x + to.x) / 2 + dx,
                (from.y + to.y) / 2 + dy) +
         text + "</text>";
}

std::string frame_of(const Isometric& box) {
  const std::array floor{box.corner(0, 0, 0), box.corner(1, 0, 0), box.corner(1, 1, 0), box.corner(0, 1, 0)};
  std::string points;
  for (const LessonTriple& corner : floor) points += format("%.1f,%.1f ", box.at(corner).x, box.at(corner).y);
  std::string out = "<polygon class=\"box\" points=\"" + points + "\"/>";
  const std::array upper{box.corner(0, 0, 1), box.corner(0, 1, 1), box.corner(1, 1, 1)};
  for (const auto& [x, y] : {std::pair{0, 0}, std::pair{0, 1}, std::pair{1, 1}})
    out += edge_line(box, box.corner(x, y, 0), box.corner(x, y, 1));
  out += edge_line(box, upper[0], upper[1]) + edge_line(box, upper[1], upper[2]);
  out += edge_label(box, floor[0], floor[1], format("x (right) %.0f mm", 1e3 * box.edge(0)), -8, 18, "end");
  out += edge_label(box, floor[1], floor[2], format("y (away) %.0f mm", 1e3 * box.edge(1)), 8, 18, "");
  out += edge_label(box, floor[0], upper[0], format("z (up) %.0f mm", 1e3 * box.edge(2)), -6, 0, "end");
  return out;
}

std::string end_dot(const Isometric& box, const LessonTriple& p, const char* label) {
  const plot::Point2 at = box.at(p);
  return format(
      "<circle class=\"dot\" cx=\"%.1f\" cy=\"%.1f\" r=\"4.5\"/><text class=\"note\" x=\"%.1f\" y=\"%.1f\">%s"
      "</text>",
      at.x, at.y, at.x + 8, at.y - 6, label);
}

}  // namespace

std::string isometric_picture(const std::vector<PathPiece>& pieces, const std::string& description) {
  const Isometric box(pieces);
  std::string body = frame_of(box);
  if (!pieces.empty()) body += drawn(box, pieces.back(), true);
  for (const PathPiece& piece : pieces) body += drawn(box, piece, false);
  const LessonTriple *first = nullptr, *last = nullptr;
  for (const PathPiece& piece : pieces)
    for (const LessonTriple& p : piece.points)
      if (known(p)) first = first == nullptr ? &p : first, last = &p;
  if (first != nullptr) body += end_dot(box, *first, "begin") + end_dot(box, *last, "end");
  std::set<std::string> labels;
  double y = box.height() + 6;
  for (const PathPiece& piece : pieces) {
    if (piece.label.empty() || !labels.insert(piece.label).second) continue;
    body += format("<path class=\"line %s\" d=\"M%g %.1fh30\"/><text class=\"legend\" x=\"%g\" y=\"%.1f\">",
                   piece.ink.c_str(), kMargin, y, kMargin + 38, y + 4) +
            plot::escaped(piece.label) + "</text>";
    y += kLegendRow;
  }
  return format(
             "<svg class=\"figure isometric\" viewBox=\"0 0 %g %.0f\" role=\"img\" "
             "xmlns=\"http://www.w3.org/2000/svg\"><title>",
             kWidth, y) +
         plot::escaped(description) + "</title>" + body + "</svg>\n";
}

}  // namespace tandem::netsim::score
