#include "netsim/score/score_figures.h"

#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::netsim::score {
namespace {

constexpr std::size_t kPiecesMax = 400;  // of a path; later changes of the holder keep the colour
constexpr double kBandGap = 0.004;       // of the duration: contacts with less time between them are one band
constexpr double kPathSpan = 10;         // [mm] smallest range of a plane
constexpr double kCurveSpan = 0.02;      // of the experts' median: smallest range of a learning curve
constexpr std::size_t kCurvesOfAuthority = 8;

std::vector<plot::Point2> over_time(const LessonGrid& grid, const std::vector<double>& values, double factor) {
  std::vector<plot::Point2> out;
  out.reserve(values.size());
  for (std::size_t k = 0; k < values.size(); ++k) out.push_back({grid.time(k), values[k] * factor});
  return out;
}

std::vector<plot::Band> contact_bands(const SeatView& view) {
  std::vector<plot::Band> out;
  const double gap = kBandGap * (view.scores.end_s - view.scores.begin_s);
  for (const Stretch& s : view.grid.runs([&](std::size_t k) { return view.tool.contact[k] != 0; })) {
    const double from = view.grid.time(s.begin), to = view.grid.time(s.end - 1) + view.grid.dt();
    if (!out.empty() && from - out.back().to < gap) {
      out.back().to = to;
    } else {
      out.push_back({from, to, ""});
    }
  }
  return out;
}

/// Intervals in which the learner's seat has no new sample.
std::vector<plot::Band> missing_samples(const SeatView& view) {
  const LessonGrid& grid = view.grid;
  const LessonSeat& seat = view.lesson.seats[view.own];
  std::vector<plot::Band> out;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    const bool fresh =
        grid.has_row(k) && (seat.fresh.empty() || seat.fresh[grid.row(k)] != 0) && known(view.seats[view.own].x_raw[k]);
    if (k > 0 && grid.tick(k) - grid.tick(k - 1) > 1) out.push_back({grid.time(k - 1) + grid.dt(), grid.time(k), ""});
    if (fresh) continue;
    const double from = grid.time(k), to = from + grid.dt();
    if (!out.empty() && from - out.back().to < grid.dt() / 2) {
      out.back().to = to;
    } else {
      out.push_back({from, to, ""});
    }
  }
  return out;
}

plot::Panel panel_over_time(const SeatView& view, const char* title, const char* label, double height) {
  plot::Panel panel;
  panel.title = title;
  panel.y_label = label;
  panel.height = height;
  panel.x = plot::Range{view.scores.begin_s, view.scores.end_s};
  return panel;
}

plot::Curve curve_of(std::string label, std::string ink, std::vector<plot::Point2> points) {
  plot::Curve curve;
  curve.label = std::move(label);
  curve.ink = std::move(ink);
  curve.points = std::move(points);
  return curve;
}

}  // namespace

SeatView::SeatView(const Lesson& of, const LessonScores& with, std::size_t own_seat)
    : lesson(of), scores(with), grid(of, with.options.gap_flagged_s), own(own_seat) {
  for (std::size_t i = 0; i < lesson.scene.masters(); ++i) seats.push_back(seat_track(lesson, grid, i, scores.options));
  tool = tool_track(lesson, grid, seats[own].tool, scores.options);
  parts = parts_of(lesson, grid, seats[own].tool, scores.options);
}

std::vector<PathPiece> path_pieces(const SeatView& view) {
  const SeatTrack& hand = view.seats[view.own];
  const std::string& name = view.lesson.scene.seats[view.own].name;
  const std::string own_key = "held:" + name;
  std::vector<PathPiece> out;
  if (std::ranges::any_of(view.tool.x, known)) out.push_back({"slave", "tool", view.tool.x});
  const Part *own = nullptr, *shared = nullptr;
  for (const Part& part : view.parts) {
    if (part.key == own_key) own = &part;
    if (part.key == "shared") shared = &part;
  }
  const bool split = std::ranges::any_of(view.parts, [](const Part& p) { return p.kind == Part::Kind::kHeldBy; });
  const auto kind_at = [&](std::size_t k) {
    if (!split || (own != nullptr && own->has(k))) return 0;
    return shared != nullptr && shared->has(k) ? 2 : 1;
  };
  const std::string labels[] = {split ? "hand of " + name + ", which holds the tool" : "hand of " + name,
                                "hand of " + name + ", another seat holds the tool",
                                "hand of " + name + ", no seat holds the tool alone"};
  constexpr const char* kInks[] = {"series0", "series1", "series5"};
  const std::size_t before = out.size();
  int kind = -1;
  for (const Stretch& s : view.grid.stretches())
    for (std::size_t k = s.begin; k < s.end; ++k) {
      const int now = kind_at(k);
      if ((now != kind || k == s.begin) && out.size() - before < kPiecesMax) {
        const bool joined = k > s.begin && out.size() > before;
        out.push_back({kInks[now], labels[now], {}});
        if (joined) out.back().points.push_back(hand.x[k - 1]);
        kind = now;
      }
      out.back().points.push_back(hand.x[k]);
    }
  return out;
}

plot::Figure planes_figure(const SeatView& view) {
  constexpr struct {
    const char* title;
    const char* across;
    const char* up;
    std::size_t a, b;
  } kPlanes[] = {{"From the front", "x, right [mm]", "z, up [mm]", 0, 2},
                 {"From above", "x, right [mm]", "y, away [mm]", 0, 1},
                 {"From the side", "y, away [mm]", "z, up [mm]", 1, 2}};
  plot::Figure figure;
  figure.description = "Path of hand and tool in three planes";
  figure.columns = 3;
  const std::vector<PathPiece> pieces = path_pieces(view);
  for (const auto& plane : kPlanes) {
    plot::Panel panel;
    panel.title = plane.title;
    panel.x_label = plane.across;
    panel.y_label = plane.up;
    panel.equal_scale = true;
    panel.y_span_min = kPathSpan;
    panel.height = 230;
    for (const PathPiece& piece : pieces) {
      std::vector<plot::Point2> points;
      for (const LessonTriple& p : piece.points)
        if (known(p)) points.push_back({1e3 * p[plane.a], 1e3 * p[plane.b]});
      plot::Curve curve = curve_of(piece.label, piece.ink, std::move(points));
      curve.path = true;
      panel.curves.push_back(std::move(curve));
    }
    if (view.tool.has_surface) {
      const auto axis = static_cast<std::size_t>(view.tool.surface.axis);
      const plot::Line line{1e3 * view.tool.surface.at, "surface"};
      if (axis == plane.a) panel.verticals.push_back(line);
      if (axis == plane.b) panel.horizontals.push_back(line);
    }
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

plot::Figure time_figure(const SeatView& view) {
  const SeatTrack& hand = view.seats[view.own];
  const ScoreOptions& options = view.scores.options;
  plot::Figure figure;
  figure.description = "Speed of the hand, force and authority over time";
  figure.panels.push_back(panel_over_time(view, "Speed of the hand", "[mm/s]", 110));
  figure.panels.back().curves.push_back(curve_of("", "series0", over_time(view.grid, hand.speed, 1e3)));
  figure.panels.back().rug = missing_samples(view);

  figure.panels.push_back(panel_over_time(view, "Force; contact is shaded", "[N]", 150));
  plot::Panel& force = figure.panels.back();
  force.bands = contact_bands(view);
  if (std::ranges::any_of(view.tool.force, [](double f) { return std::isfinite(f); }))
    force.curves.push_back(
        curve_of("force of the environment on the tool", "slave", over_time(view.grid, view.tool.force, 1)));
  force.curves.push_back(curve_of("force on the hand", "series0", over_time(view.grid, hand.force, 1)));
  force.y = plot::range_of(force.curves, true, 0.5);
  force.y->lo = 0;
  if (options.force_limit < force.y->hi) force.horizontals.push_back({options.force_limit, "force limit"});

  figure.panels.push_back(panel_over_time(view, "Authority over the tool", "[1]", 90));
  plot::Panel& authority = figure.panels.back();
  authority.y = plot::Range{-0.05, 1.1};
  for (std::size_t i = 0; i < view.seats.size() && authority.curves.size() < kCurvesOfAuthority; ++i) {
    if (view.seats[i].tool != hand.tool) continue;
    const std::string ink = i == view.own ? "series0" : "series" + std::to_string(1 + authority.curves.size() % 7);
    authority.curves.push_back(
        curve_of("authority of " + view.lesson.scene.seats[i].name, ink, over_time(view.grid, view.seats[i].alpha, 1)));
  }
  for (const NamedIntervention& i : view.scores.interventions)
    authority.verticals.push_back({i.from_s, i.seat + " takes over"});
  figure.panels.back().x_label = "session time [s]";
  return figure;
}

plot::Figure curves_figure(const ScoreResult& result, std::size_t most) {
  plot::Figure figure;
  figure.description = "Scores over the sessions, with the experts' median and pass mark";
  figure.columns = 2;
  if (result.lessons.size() < 2) return figure;
  for (const LearningCurve& curve : result.curves) {
    const bool main = std::ranges::find(main_metrics(), curve.metric) != main_metrics().end();
    if (figure.panels.size() >= most || curve.part != "whole" || !main) continue;
    const MetricRow& row = row_of(curve.metric);
    std::vector<plot::Point2> points;
    for (std::size_t i = 0; i < curve.points.size(); ++i)
      if (curve.points[i].counts) points.push_back({static_cast<double>(i + 1), curve.points[i].value * row.factor});
    if (points.size() < 2) continue;
    plot::Panel panel;
    panel.title = std::string(row.title);
    panel.x_label = "session";
    panel.y_label = row.unit.empty() ? "" : "[" + std::string(row.unit) + "]";
    panel.height = 130;
    panel.y_span_min = kCurveSpan * std::abs(curve.threshold.median * row.factor);
    const double last = static_cast<double>(curve.points.size());
    panel.curves.push_back(
        curve_of("experts' median", "slave",
                 {{1, curve.threshold.median * row.factor}, {last, curve.threshold.median * row.factor}}));
    panel.curves.push_back(
        curve_of("pass mark", "series5",
                 {{1, curve.threshold.pass_mark * row.factor}, {last, curve.threshold.pass_mark * row.factor}}));
    panel.curves.push_back(curve_of("learner", "series0", std::move(points)));
    figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace tandem::netsim::score
