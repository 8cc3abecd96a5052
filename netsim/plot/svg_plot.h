#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/plot/downsample.h"

/// Line plots as inline SVG. Pure: numbers in, text out. Colours and fonts are classes that the page's style sheet
/// defines (plot_style.h), so that one drawing serves light, dark and paper.
namespace tandem::netsim::plot {

struct Curve {
  std::string label;  ///< in the legend, once per figure; empty: not there
  std::string ink;    ///< class of the line
  std::vector<Point2> points;
  bool path = false;  ///< goes back and forth in x: thinned as a path
};
/// A span of x that is shaded, named at its top.
struct Band {
  double from = 0, to = 0;
  std::string label;
};
/// A line across the whole panel.
struct Line {
  double at = 0;
  std::string label;
};
/// A dot with a name beside it.
struct Note {
  Point2 at;
  std::string label;
};
struct Range {
  double lo = 0, hi = 1;
};

struct Panel {
  std::string title = {}, x_label = {}, y_label = {};  ///< labels carry their unit: "time [s]"
  std::vector<Curve> curves = {};
  std::vector<Band> bands = {};
  std::vector<Band> rug = {};  ///< spans marked along the lower edge, at least a pixel wide each
  std::vector<Line> verticals = {}, horizontals = {};
  std::vector<Note> notes = {};
  std::optional<Range> x = {}, y = {};  ///< default: what the curves need, and a margin
  double y_span_min = 0;                ///< the automatic y range is at least so wide: noise stays small
  bool equal_scale = false;             ///< one unit is as long along x as along y
  double height = 150;                  ///< of the plot area [px]
};

struct Figure {
  std::string description;    ///< for those who cannot see it
  std::size_t columns = 1;    ///< panels side by side
  std::vector<Panel> panels;  ///< row by row
};

inline constexpr double kFigureWidth = 1080;          ///< of the drawing [px]; the page scales it
inline constexpr double kNarrowWidth = 372;           ///< the same for a screen of 400 px, where scaled text is too small
inline constexpr double kTwoColumnsFrom = 600;        ///< narrower figures have one column of panels
inline constexpr std::size_t kCurvePointsMax = 1000;  ///< per curve

/// The figure as one <svg> element.
/// @param width  of the drawing [px], at least 200
[[nodiscard]] std::string to_svg(const Figure& figure, double width = kFigureWidth);

/// The same as a file of its own, with its style sheet and a background.
[[nodiscard]] std::string to_svg_file(const Figure& figure);

/// The range a panel shows along y (or x): the curves' extremes and 6 % on each side, at least `span_min` wide.
/// No finite point: [0, 1].
[[nodiscard]] Range range_of(const std::vector<Curve>& curves, bool along_y, double span_min);

/// Text with &, <, > and quotes escaped.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace tandem::netsim::plot
