#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "netsim/plot/downsample.h"

/// Line plots as inline SVG. Pure functions: numbers in, text out. The page's style sheet (plot_style.h) defines the
/// classes of colours and fonts. One drawing therefore works in light mode, in dark mode and in print.
namespace tandem::netsim::plot {

struct Curve {
  std::string label;  ///< in the legend, once per figure; empty: not in the legend
  std::string ink;    ///< CSS class of the line
  std::vector<Point2> points;
  bool path = false;  ///< x may decrease: reduced as a path
};
/// A shaded interval of x, with its label above.
struct Band {
  double from = 0, to = 0;
  std::string label;
};
/// A line across the whole panel.
struct Line {
  double at = 0;
  std::string label;
};
/// A dot with a label beside it.
struct Note {
  Point2 at;
  std::string label;
};
struct Range {
  double lo = 0, hi = 1;
};

struct Panel {
  std::string title = {}, x_label = {}, y_label = {};  ///< axis labels contain their unit: "time [s]"
  std::vector<Curve> curves = {};
  std::vector<Band> bands = {};
  std::vector<Band> rug = {};  ///< intervals marked along the lower edge, each at least one pixel wide
  std::vector<Line> verticals = {}, horizontals = {};
  std::vector<Note> notes = {};
  std::optional<Range> x = {}, y = {};  ///< default: the range of the curves plus a margin
  double y_span_min = 0;                ///< minimum of the automatic y range, so that noise is not magnified
  bool equal_scale = false;             ///< one unit has the same length along x and y
  double height = 150;                  ///< of the plot area [px]
};

struct Figure {
  std::string description;    ///< for readers who cannot see the drawing
  std::size_t columns = 1;    ///< panels side by side
  std::vector<Panel> panels;  ///< row by row
};

inline constexpr double kFigureWidth = 1080;    ///< of the drawing [px]; the page scales it
inline constexpr double kNarrowWidth = 372;     ///< the same for a screen of 400 px, where scaled text is too small
inline constexpr double kTwoColumnsFrom = 600;  ///< narrower figures have one column of panels
inline constexpr std::size_t kCurvePointsMax = 1000;  ///< per curve

/// Returns the figure as one <svg> element.
/// @param width  of the drawing [px], at least 200
[[nodiscard]] std::string to_svg(const Figure& figure, double width = kFigureWidth);

/// Returns the figure as a separate file, with its style sheet and a background.
[[nodiscard]] std::string to_svg_file(const Figure& figure);

/// Returns the range that a panel shows along y (or x): the curves' extremes and 6 % on each side, at least `span_min`
/// wide. Without a finite point it is [0, 1].
[[nodiscard]] Range range_of(const std::vector<Curve>& curves, bool along_y, double span_min);

/// Returns the text with &, <, > and quotes escaped.
[[nodiscard]] std::string escaped(std::string_view text);

}  // namespace tandem::netsim::plot
