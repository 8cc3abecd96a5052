#include "netsim/demo/overlay.h"

#include <algorithm>
#include <cmath>

#include "netsim/demo/experiment_times.h"
#include "netsim/demo/plot_axes.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {

constexpr double kPathStep = 0.2;  ///< smallest distance of two kept points of a path [mm]

/// Returns the distance of two tips in space [mm].
double distance(const Column3& a, const Column3& b, std::size_t k) {
  return kMilli * std::hypot(a[0][k] - b[0][k], a[1][k] - b[1][k], a[2][k] - b[2][k]);
}
double norm(const Column3& a, std::size_t k) { return std::hypot(a[0][k], a[1][k], a[2][k]); }

/// A panel over time with one curve per setting.
struct Subject {
  const char *title, *y_label;
  double (*value)(const TraceData&, std::size_t row);
  double mark = kUnknown;  ///< position of a horizontal line
  const char* mark_label = "";
};

constexpr std::array<Subject, 3> kFreeMotion{{
    {"trainer to tool: distance of the tips", "distance [mm]",
     [](const TraceData& d, std::size_t k) { return distance(d.trainer.x, d.tool.x, k); }, 8.2,
     "RMS in the paper, leader"},
    {"trainee to tool: distance of the tips", "distance [mm]",
     [](const TraceData& d, std::size_t k) { return distance(d.trainee.x, d.tool.x, k); }, 6.0,
     "RMS in the paper, follower"},
    {"force on the trainer’s hand", "force [N]",
     [](const TraceData& d, std::size_t k) { return norm(d.trainer.f_out, k); }},
}};
constexpr std::array<Subject, 3> kContact{{
    {"position of the tool along x", "x [mm]",
     [](const TraceData& d, std::size_t k) { return kMilli * d.tool.x[0][k]; }, 0, "wall"},
    {"position of the trainer’s hand along x", "x [mm]",
     [](const TraceData& d, std::size_t k) { return kMilli * d.trainer.x[0][k]; }, 0, "wall"},
    {"force the trainer feels along x", "force [N]",
     [](const TraceData& d, std::size_t k) { return -d.trainer.f_out[0][k]; }},
}};
constexpr std::span<const Subject> subjects(Task task) { return task == Task::kFreeMotion ? kFreeMotion : kContact; }

constexpr TimeLabels kOverlayLabels{"trainee pushes", "trainer pushes", "α moves", "reaches the wall",
                                    "trainee aligned"};

struct Ink {
  const char *label, *ink;
};
constexpr std::array<Ink, kSettings> kInks{
    {{"the paper’s gains", "second"}, {"Tandem’s defaults", "first"}, {"defaults, bad network", "third"}}};

Curve curve_of(const RunResult& run, std::size_t index, bool path) {
  const Ink& ink = kInks[static_cast<std::size_t>(run.plan->setting)];
  return {ink.label, ink.ink, index < run.overlay.size() ? run.overlay[index] : std::vector<Point2>{}, path};
}

Panel network_panel(const NetworkSeries& network, std::size_t way, Task task, double duration) {
  Panel p{.title = way == 0 ? "bad network, to the server: delay" : "bad network, from the server: delay",
          .x_label = way == 1 ? kTimeAxis : "",
          .y_label = "delay [ms]",
          .curves = {{"", way == 0 ? "up" : "down", network.delay[way]}},
          .rug = network.lost[way],
          .height = 90};
  mark_times(p, task, duration, {});
  const Range range = range_of(p.curves, true, 1);
  p.y = Range{0, std::max(1.0, range.hi)};
  return p;
}

CaptionedFigure overlay_of(Task task, std::span<const RunResult> runs) {
  const bool free_motion = task == Task::kFreeMotion;
  CaptionedFigure f{
      free_motion ? "free" : "contact",
      free_motion ? "Free motion: the three settings over each other" : "Contact: the three settings over each other",
      free_motion ? "Same gesture, same hands: the paper’s gains without a network, Tandem’s defaults "
                    "without one, and the defaults on the bad network. The path is that of the tool, "
                    "seen from the front. Delays are those "
                    "of the trainer’s datagrams; red marks are lost ones."
                  : "The tool stops at the block (x = 0). The hands go on into it by force / stiffness. "
                    "A Touch delivers 3.3 N at most. Delays are those of the trainer’s datagrams; red "
                    "marks are lost ones.",
      {"Curves of the paper's gains, Tandem's defaults and the bad network over each other", 1, {}}};
  double duration = 0;
  const NetworkSeries* network = nullptr;
  for (const RunResult& run : runs) {
    if (run.plan->task != task) continue;
    duration = run.plan->duration_s;
    if (!run.network.delay[0].empty()) network = &run.network;
  }
  const std::span<const Subject> rows = subjects(task);
  for (std::size_t s = 0; s < rows.size(); ++s) {
    Panel p{.title = rows[s].title, .y_label = rows[s].y_label, .height = 140};
    for (const RunResult& run : runs)
      if (run.plan->task == task) p.curves.push_back(curve_of(run, s, false));
    if (std::isfinite(rows[s].mark)) p.horizontals = {{rows[s].mark, rows[s].mark_label}};
    mark_times(p, task, duration, s == 0 ? kOverlayLabels : TimeLabels{});
    if (s + 1 == rows.size() && network == nullptr) p.x_label = kTimeAxis;
    f.figure.panels.push_back(std::move(p));
  }
  if (network != nullptr)
    for (const std::size_t way : {0u, 1u}) f.figure.panels.push_back(network_panel(*network, way, task, duration));
  if (free_motion) {
    Panel path{.title = "path of the tool, seen from the front",
               .x_label = "x, right [mm]",
               .y_label = "z, up [mm]",
               .equal_scale = true,
               .height = 280};
    for (const RunResult& run : runs)
      if (run.plan->task == task) path.curves.push_back(curve_of(run, rows.size(), true));
    f.figure.panels.push_back(std::move(path));
  }
  return f;
}

}  // namespace

OverlaySeries overlay_series(const RunPlan& plan, const TraceData& trace) {
  OverlaySeries series;
  std::vector<Point2> points(trace.rows());
  for (const Subject& subject : subjects(plan.task)) {
    for (std::size_t k = 0; k < trace.rows(); ++k) points[k] = {trace.t[k], subject.value(trace, k)};
    series.push_back(downsample_extremes(points, kCurvePointsMax));
  }
  if (plan.task == Task::kFreeMotion) {
    for (std::size_t k = 0; k < trace.rows(); ++k)
      points[k] = {kMilli * trace.tool.x[0][k], kMilli * trace.tool.x[2][k]};
    series.push_back(downsample_path(points, kPathStep, kCurvePointsMax));
  }
  return series;
}

std::vector<CaptionedFigure> overlay_figures(std::span<const RunResult> runs) {
  std::vector<CaptionedFigure> figures;
  for (const Task task : {Task::kFreeMotion, Task::kContact})
    if (std::ranges::any_of(runs, [&](const RunResult& run) { return run.plan->task == task && !run.overlay.empty(); }))
      figures.push_back(overlay_of(task, runs));
  return figures;
}

}  // namespace tandem::netsim::demo
