#include "netsim/plot/svg_plot.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>

#include "common/base/wrap_words.h"
#include "netsim/plot/plot_style.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::plot {
namespace {

constexpr double kLeft = 62, kRight = 14, kTitle = 20, kTop = 8, kTickRow = 18, kLabelRow = 18, kLegend = 26;
constexpr double kMarkRow = 14,
                 kCharacter = 6.2;  // height of a row of labels above a panel; width of a character

/// Position of a panel's plot area, and the range that it shows.
struct Frame {
  double left = 0, top = 0, width = 0, height = 0;
  Range x, y;
  [[nodiscard]] double px(double v) const { return (v - x.lo) / (x.hi - x.lo) * width; }
  [[nodiscard]] double py(double v) const { return (y.hi - v) / (y.hi - y.lo) * height; }
};

/// Returns a coordinate in tenths of a pixel.
long long tenths(double v) { return std::llround(std::clamp(v, -1e6, 1e6) * 10); }

/// Returns a coordinate to a tenth of a pixel, in ASCII.
std::string px_text(double v) {
  const long long t = tenths(v), magnitude = std::abs(t);
  return (t < 0 ? "-" : "") + std::to_string(magnitude / 10) +
         (magnitude % 10 != 0 ? "." + std::to_string(magnitude % 10) : "");
}

void text_at(std::ostream& out, double x, double y, std::string_view kind, std::string_view text,
             std::string_view more = "") {
  out << "<text class=\"" << kind << "\" x=\"" << px_text(x) << "\" y=\"" << px_text(y) << '"' << more << '>'
      << escaped(text) << "</text>";
}

void line(std::ostream& out, double x1, double y1, double x2, double y2, std::string_view kind) {
  out << "<line class=\"" << kind << "\" x1=\"" << px_text(x1) << "\" y1=\"" << px_text(y1) << "\" x2=\"" << px_text(x2)
      << "\" y2=\"" << px_text(y2) << "\"/>";
}

void draw_curve(std::ostream& out, const Frame& f, const Curve& curve) {
  // More than two points per pixel are not visible.
  const auto most = std::clamp<std::size_t>(static_cast<std::size_t>(2 * f.width), 4, kCurvePointsMax);
  std::vector<Point2> at;
  at.reserve(curve.points.size());
  for (const Point2& p : curve.points) at.push_back({f.px(p.x), f.py(p.y)});
  at = curve.path ? downsample_path(at, 1.0, most) : downsample_extremes(at, most);
  if (at.empty()) return;
  // Relative moves in tenths of a pixel. Their exact sum keeps rounding errors from accumulating.
  long long x = tenths(at.front().x), y = tenths(at.front().y);
  out << "<path class=\"line " << curve.ink << "\" d=\"M" << px_text(at.front().x) << ' ' << px_text(at.front().y)
      << 'l';
  bool first = true;
  for (std::size_t k = 1; k < at.size(); ++k) {
    const long long nx = tenths(at[k].x), ny = tenths(at[k].y);
    if (nx == x && ny == y) continue;
    const std::string dx = px_text(static_cast<double>(nx - x) / 10), dy = px_text(static_cast<double>(ny - y) / 10);
    out << (first || dx.front() == '-' ? "" : " ") << dx << (dy.front() == '-' ? "" : " ") << dy;
    x = nx, y = ny;
    first = false;
  }
  if (first) out << "0 0";
  out << "\"/>";
}

void draw_axes(std::ostream& out, const Frame& f, const Panel& panel, bool x_numbers) {
  const Ticks xs = round_ticks(f.x.lo, f.x.hi, std::max(2, static_cast<int>(f.width / 62)));
  const Ticks ys = round_ticks(f.y.lo, f.y.hi, std::max(2, static_cast<int>(f.height / 34)));
  for (const double v : xs.values) {
    line(out, f.left + f.px(v), f.top, f.left + f.px(v), f.top + f.height, "grid");
    if (x_numbers) text_at(out, f.left + f.px(v), f.top + f.height + 15, "tick mid", number_text(v, xs.decimals));
  }
  for (const double v : ys.values) {
    line(out, f.left, f.top + f.py(v), f.left + f.width, f.top + f.py(v), "grid");
    text_at(out, f.left - 6, f.top + f.py(v) + 4, "tick end", number_text(v, ys.decimals));
  }
  out << "<rect class=\"frame\" x=\"" << px_text(f.left) << "\" y=\"" << px_text(f.top) << "\" width=\""
      << px_text(f.width) << "\" height=\"" << px_text(f.height) << "\"/>";
  const double middle = f.top + f.height / 2;
  text_at(out, f.left - 46, middle, "label mid", panel.y_label,
          " transform=\"rotate(-90 " + px_text(f.left - 46) + " " + px_text(middle) + ")\"");
  if (x_numbers) text_at(out, f.left + f.width / 2, f.top + f.height + 32, "label mid", panel.x_label);
}

/// Draws the intervals; those in the same pixel become one.
void draw_rug(std::ostream& out, const Frame& f, const std::vector<Band>& rug) {
  constexpr double kHeight = 7;
  double done = -1;
  for (std::size_t i = 0; i < rug.size();) {
    const double from = std::max(f.px(rug[i].from), done);
    double to = std::max(f.px(rug[i].to), from + 1);
    for (++i; i < rug.size() && f.px(rug[i].from) <= to; ++i) to = std::max(to, f.px(rug[i].to));
    done = to;
    out << "<rect class=\"rug\" x=\"" << px_text(from) << "\" y=\"" << px_text(f.height - kHeight) << "\" width=\""
        << px_text(to - from) << "\" height=\"" << px_text(kHeight) << "\"/>";
  }
}

/// The label of a band or line above a panel: x from the panel's left edge, row 0 is the lowest.
struct PlacedMark {
  double x = 0;
  std::size_t row = 0;
  const std::string* label = nullptr;
};

/// Places each label in the lowest row in which it covers no other label.
std::vector<PlacedMark> placed_marks(const Frame& f, const Panel& panel) {
  std::vector<PlacedMark> marks;
  for (const Band& b : panel.bands) marks.push_back({std::clamp(f.px((b.from + b.to) / 2), 0.0, f.width), 0, &b.label});
  for (const Line& v : panel.verticals) marks.push_back({f.px(v.at), 0, &v.label});
  std::erase_if(marks, [](const PlacedMark& m) { return m.label->empty(); });
  std::ranges::sort(marks, {}, &PlacedMark::x);
  std::vector<double> row_ends;  // the title starts the lowest row
  if (!panel.title.empty()) row_ends.push_back(static_cast<double>(display_width(panel.title) + 2) * kCharacter);
  for (PlacedMark& m : marks) {
    const double half = static_cast<double>(display_width(*m.label)) * kCharacter / 2;
    m.x = std::clamp(m.x, std::min(half - kLeft, f.width), std::max(f.width + kRight - half, 0.0));
    while (m.row < row_ends.size() && row_ends[m.row] > m.x - half) ++m.row;
    if (m.row == row_ends.size()) row_ends.push_back(0);
    row_ends[m.row] = m.x + half + kCharacter;
  }
  return marks;
}

/// Returns the height of the area above a panel: its title, or the labels of its bands and lines.
double head_height(const Frame& f, const Panel& panel) {
  std::size_t rows = panel.title.empty() ? 0 : 1;
  for (const PlacedMark& m : placed_marks(f, panel)) rows = std::max(rows, m.row + 1);
  return rows == 0 ? kTop : kTitle + kMarkRow * static_cast<double>(rows - 1);
}

void draw_panel(std::ostream& out, const Frame& f, const Panel& panel, bool x_numbers) {
  if (!panel.title.empty()) text_at(out, f.left, f.top - 7, "title", panel.title);
  for (const Band& b : panel.bands) {
    const double from = std::clamp(f.px(b.from), 0.0, f.width), to = std::clamp(f.px(b.to), 0.0, f.width);
    out << "<rect class=\"band\" x=\"" << px_text(f.left + from) << "\" y=\"" << px_text(f.top) << "\" width=\""
        << px_text(to - from) << "\" height=\"" << px_text(f.height) << "\"/>";
  }
  draw_axes(out, f, panel, x_numbers);
  // A nested svg clips what is outside the plot area.
  out << "<svg x=\"" << px_text(f.left) << "\" y=\"" << px_text(f.top) << "\" width=\"" << px_text(f.width)
      << "\" height=\"" << px_text(f.height) << "\">";
  for (const Line& v : panel.verticals) line(out, f.px(v.at), 0, f.px(v.at), f.height, "mark");
  for (const Line& h : panel.horizontals) line(out, 0, f.py(h.at), f.width, f.py(h.at), "mark");
  for (const Curve& c : panel.curves) draw_curve(out, f, c);
  draw_rug(out, f, panel.rug);
  out << "</svg>";
  for (const PlacedMark& m : placed_marks(f, panel))
    text_at(out, f.left + m.x, f.top - 6 - kMarkRow * static_cast<double>(m.row), "note mid", *m.label);
  for (const Line& h : panel.horizontals)
    text_at(out, f.left + f.width - 5, f.top + f.py(h.at) - 5, "note end", h.label);
  for (const Note& n : panel.notes) {
    const double x = f.px(n.at.x), y = f.py(n.at.y);
    if (!(x >= 0 && x <= f.width && y >= 0 && y <= f.height)) continue;
    out << "<circle class=\"dot\" cx=\"" << px_text(f.left + x) << "\" cy=\"" << px_text(f.top + y) << "\" r=\"4\"/>";
    const bool right = x < f.width * 0.7;
    text_at(out, f.left + x + (right ? 8 : -8), f.top + y + (y < 20 ? 14 : -6), right ? "note" : "note end", n.label);
  }
}

/// Returns the legend entries in the order of their first use: label and ink.
std::vector<const Curve*> legend_of(const Figure& figure) {
  std::vector<const Curve*> entries;
  for (const Panel& p : figure.panels)
    for (const Curve& c : p.curves)
      if (!c.label.empty() && std::ranges::none_of(entries, [&](const Curve* e) { return e->label == c.label; }))
        entries.push_back(&c);
  return entries;
}

Range widened(Range r, double span) {
  const double add = std::max(0.0, span - (r.hi - r.lo)) / 2;
  return {r.lo - add, r.hi + add};
}

Frame frame_of(const Panel& panel, double left, double top, double width) {
  Frame f{left, top, width, panel.height, {}, {}};
  f.x = panel.x ? *panel.x : range_of(panel.curves, false, 0);
  f.y = panel.y ? *panel.y : range_of(panel.curves, true, panel.y_span_min);
  if (panel.equal_scale) {
    const double per_px = std::max((f.x.hi - f.x.lo) / f.width, (f.y.hi - f.y.lo) / f.height);
    f.x = widened(f.x, per_px * f.width);
    f.y = widened(f.y, per_px * f.height);
  }
  return f;
}

struct Entity {
  char character;
  std::string_view text;
};
constexpr std::array<Entity, 4> kEntities{{{'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}}};

}  // namespace

std::string escaped(std::string_view text) {
  std::string out;
  out.reserve(text.size());
  for (const char c : text) {
    const auto* const entity = std::ranges::find(kEntities, c, &Entity::character);
    if (entity == kEntities.end()) {
      out += c;
    } else {
      out += entity->text;
    }
  }
  return out;
}

Range range_of(const std::vector<Curve>& curves, bool along_y, double span_min) {
  double lo = INFINITY, hi = -INFINITY;
  for (const Curve& c : curves)
    for (const Point2& p : c.points) {
      const double v = along_y ? p.y : p.x;
      if (!std::isfinite(v)) continue;
      lo = std::min(lo, v);
      hi = std::max(hi, v);
    }
  if (!(lo <= hi)) return {0, 1};
  const double margin = along_y ? 0.06 * (hi - lo) : 0.03 * (hi - lo);
  const double least = span_min > 0 ? span_min : std::max(1e-9, 1e-6 * std::max(std::abs(lo), std::abs(hi)));
  return widened({lo - margin, hi + margin}, least);
}

std::string to_svg(const Figure& figure, double width) {
  const std::size_t columns = width < kTwoColumnsFrom ? 1 : std::max<std::size_t>(1, figure.columns);
  const double cell = width / static_cast<double>(columns);
  std::ostringstream body;

  double x = kLeft, top = 0;
  for (const Curve* entry : legend_of(figure)) {
    const double wide = 37 + 6.7 * static_cast<double>(display_width(entry->label));
    if (top == 0 || x + wide > width) {
      x = top == 0 && width >= kTwoColumnsFrom ? kLeft : kRight;
      top += kLegend;
    }
    body << "<path class=\"line " << entry->ink << "\" d=\"M" << px_text(x) << ' ' << px_text(top - 14) << "h30\"/>";
    text_at(body, x + 37, top - 10, "legend", entry->label);
    x += wide + 30;
  }
  for (std::size_t first = 0; first < figure.panels.size(); first += columns) {
    const std::size_t end = std::min(first + columns, figure.panels.size());
    std::vector<Frame> frames;
    bool numbered = false;
    double head = 0, height = 0;
    for (std::size_t i = first; i < end; ++i) {
      const Panel& panel = figure.panels[i];
      frames.push_back(frame_of(panel, cell * static_cast<double>(i - first) + kLeft, 0, cell - kLeft - kRight));
      head = std::max(head, head_height(frames.back(), panel));
      numbered = numbered || !panel.x_label.empty();
      height = std::max(height, panel.height);
    }
    top += head;
    for (std::size_t i = first; i < end; ++i) {
      frames[i - first].top = top;
      draw_panel(body, frames[i - first], figure.panels[i], !figure.panels[i].x_label.empty());
    }
    top += height + (numbered ? kTickRow + kLabelRow : kTop);
  }
  std::ostringstream out;
  out << "<svg class=\"figure\" viewBox=\"0 0 " << px_text(width) << ' ' << px_text(top + 4)
      << "\" role=\"img\" xmlns=\"http://www.w3.org/2000/svg\"><title>" << escaped(figure.description) << "</title>"
      << body.str() << "</svg>\n";
  return out.str();
}

std::string to_svg_file(const Figure& figure) {
  std::string svg = to_svg(figure);
  const std::size_t inside = svg.find("</title>") + 8;
  svg.insert(inside, "<style>" + std::string(kPlotColours) + std::string(kPlotRules) +
                         "</style><rect width=\"100%\" height=\"100%\" style=\"fill:var(--bg)\"/>");
  return "<?xml version=\"1.0\" encoding=\"UTF-8\"?>\n" + svg;
}

}  // namespace tandem::netsim::plot
