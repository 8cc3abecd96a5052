#include "netsim/demo/figures.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "netsim/demo/experiment_times.h"
#include "netsim/demo/plot_axes.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {

constexpr TimeLabels kNamed{"a: trainee pushes", "b: trainer pushes", "α moves", "reaches the wall", "trainee aligned"};
constexpr TimeLabels kUnnamed{};

Curve curve(const std::string& label, const std::string& ink, const Column& x, const Column& y, double x_scale,
            double y_scale, bool path) {
  Curve c{label, ink, {}, path};
  c.points.reserve(x.size());
  for (std::size_t k = 0; k < std::min(x.size(), y.size()); ++k) c.points.push_back({x_scale * x[k], y_scale * y[k]});
  return c;
}

Curve over_time(const TraceData& d, const std::string& label, const std::string& ink, const Column& y,
                double scale = 1) {
  return curve(label, ink, d.t, y, 1, scale, false);
}

/// Returns the curves of the tool, or of the slave device that carries it, and of the hands. The tool is first, because
/// its broad, pale line must lie below the others.
std::vector<Curve> three(const TraceData& d, const char* label, const Column& tool, const Column& trainer,
                         const Column& trainee, double tool_scale, double hand_scale) {
  return {over_time(d, label, "slave", tool, tool_scale), over_time(d, "trainer", "trainer", trainer, hand_scale),
          over_time(d, "trainee", "trainee", trainee, hand_scale)};
}

/// Returns the first row of `t` at or after a time; the last row if there is none.
std::size_t row_at(const TraceData& d, double t) {
  const auto it = std::ranges::lower_bound(d.t, t);
  return std::min<std::size_t>(static_cast<std::size_t>(it - d.t.begin()), d.rows() - 1);
}

struct Plane {
  std::size_t across, up;
  const char *title, *x_label, *y_label;
};
constexpr std::array<Plane, 3> kPlanes{{{0, 2, "seen from the front", "x, right [mm]", "z, up [mm]"},
                                        {0, 1, "seen from above", "x, right [mm]", "y, away [mm]"},
                                        {1, 2, "seen from the side", "y, away [mm]", "z, up [mm]"}}};

Panel path_panel(const TraceData& d, const Plane& plane) {
  Panel p{.title = plane.title, .x_label = plane.x_label, .y_label = plane.y_label, .equal_scale = true, .height = 280};
  for (const auto& [label, ink, x] :
       {std::tuple{"tool", "slave", &d.tool.x}, std::tuple{"trainer", "trainer", &d.trainer.x},
        std::tuple{"trainee", "trainee", &d.trainee.x}})
    p.curves.push_back(curve(label, ink, (*x)[plane.across], (*x)[plane.up], kMilli, kMilli, true));
  return p;
}

Note note_at(const TraceData& d, const Plane& plane, const Column3& x, double t, const char* label) {
  const std::size_t k = row_at(d, t);
  return {{kMilli * x[plane.across][k], kMilli * x[plane.up][k]}, label};
}

CaptionedFigure figure_6(const TraceData& d) {
  CaptionedFigure f{
      "fig6",
      "Figure 6: path in free motion",
      "Tips of both hands and of the tool in space. In a the trainee pulls away while following, in b the trainer; "
      "their devices lead them back.",
      {"Path of trainer, trainee and tool in three projections", 3, {}}};
  for (const Plane& plane : kPlanes) f.figure.panels.push_back(path_panel(d, plane));
  f.figure.panels[0].notes = {
      note_at(d, kPlanes[0], d.tool.x, 0, "start"), note_at(d, kPlanes[0], d.trainee.x, 7.75, "a"),
      note_at(d, kPlanes[0], d.trainer.x, 14.75, "b"), note_at(d, kPlanes[0], d.tool.x, 11.5, "α moves")};
  return f;
}

CaptionedFigure figure_7(const TraceData& d, double duration) {
  CaptionedFigure f{"fig7",
                    "Figure 7: joint angles in free motion",
                    "θ3 is measured against the vertical, as the device reports it. The curve of a following hand may "
                    "deviate from the others by the resistance of that hand.",
                    {"Joint angles of trainer, trainee and slave over time", 1, {}}};
  for (std::size_t j = 0; j < 3; ++j) {
    Panel p{.x_label = j == 2 ? kTimeAxis : "",
            .y_label = "θ" + std::to_string(j + 1) + " [rad]",
            .curves = three(d, "slave", d.tool.q[j], d.trainer.q[j], d.trainee.q[j], 1, 1)};
    mark_times(p, Task::kFreeMotion, duration, j == 0 ? kNamed : kUnnamed);
    f.figure.panels.push_back(std::move(p));
  }
  return f;
}

CaptionedFigure figure_8(const TraceData& d, double duration) {
  CaptionedFigure f{
      "fig8",
      "Figure 8: exchanged torques in free motion, and α",
      "T = Jᵀ f of the force commanded to each device, at the measured pose; the slave’s with the opposite sign, so "
      "that it lies on the leader’s. A hand’s contains what the damper of its own virtual mass takes (12 N s/m with "
      "the paper’s gains). Nothing is touched: the rest is friction, inertia, weight where it is not compensated, and "
      "the pushes a and b.",
      {"Torques of the three joints of trainer, trainee and slave, and alpha, over time", 1, {}}};
  for (std::size_t j = 0; j < 3; ++j) {
    Panel p{.y_label = "T" + std::to_string(j + 1) + " [N m]",
            .curves = three(d, "slave", d.tool.torque[j], d.trainer.torque[j], d.trainee.torque[j], -1, 1),
            .y_span_min = 0.02};
    mark_times(p, Task::kFreeMotion, duration, j == 0 ? kNamed : kUnnamed);
    f.figure.panels.push_back(std::move(p));
  }
  Panel alpha{.x_label = kTimeAxis,
              .y_label = "α [1]",
              .curves = {over_time(d, "α of the trainer", "alpha", d.trainer.alpha)},
              .y = Range{-0.1, 1.1},
              .height = 70};
  mark_times(alpha, Task::kFreeMotion, duration, kUnnamed);
  f.figure.panels.push_back(std::move(alpha));
  return f;
}

CaptionedFigure energy(const RunPlan& plan, const TraceData& d, const std::string& anchor, const std::string& title) {
  const std::array<const char*, 3> joints{"joint 1", "joint 2", "joint 3"}, axes{"x axis", "y axis", "z axis"};
  CaptionedFigure f{
      anchor,
      title,
      "Eₚ of the paper’s equation 3, with its sign: it falls while the sources give energy to the follower. They are "
      "open here and Eₚ is only watched; the energy ledger of each spring keeps hands safe.",
      {"Energy of the flow sources over time, per axis", 1, {}}};
  const bool milli = plan.task == Task::kContact;  // the motion in contact is small
  Panel p{.x_label = kTimeAxis, .y_label = milli ? "Eₚ [mJ]" : "Eₚ [J]", .height = 200};
  const std::array<const char*, 3> inks{"first", "second", "third"};
  for (std::size_t a = 0; a < 3; ++a)
    p.curves.push_back(
        over_time(d, plan.joint_port() ? joints[a] : axes[a], inks[a], d.tool.e_p[a], milli ? kMilli : 1));
  mark_times(p, plan.task, plan.duration_s, kNamed);
  f.figure.panels.push_back(std::move(p));
  return f;
}

CaptionedFigure figure_10(const TraceData& d) {
  CaptionedFigure f{"fig10",
                    "Figure 10: path in contact",
                    "The tool stops at the block (x = 0); the hands go on into it, by force / stiffness.",
                    {"Path of trainer, trainee and tool at the wall, in two projections", 2, {}}};
  for (const Plane& plane : {kPlanes[0], kPlanes[1]}) {
    Panel p = path_panel(d, plane);
    p.verticals = {{0, "wall"}};
    p.height = 240;
    f.figure.panels.push_back(std::move(p));
  }
  f.figure.panels[0].notes = {note_at(d, kPlanes[0], d.tool.x, 0, "start")};
  return f;
}

CaptionedFigure figure_11(const TraceData& d, double duration) {
  CaptionedFigure f{"fig11",
                    "Figure 11: position and force along x in contact",
                    "Forces are those that press towards the block: commanded to each device, and delivered (of the "
                    "tool: the load of the block). A Touch delivers 3.3 N at most.",
                    {"Position along x, commanded and delivered force along x, over time", 1, {}}};
  Panel x{.y_label = "x [mm]",
          .curves = three(d, "tool", d.tool.x[0], d.trainer.x[0], d.trainee.x[0], kMilli, kMilli),
          .height = 170};
  x.horizontals = {{0, "wall"}};
  mark_times(x, Task::kContact, duration, kNamed);
  Panel cmd{.y_label = "commanded [N]",
            .curves = three(d, "tool", d.tool.f_cmd[0], d.trainer.f_cmd[0], d.trainee.f_cmd[0], 1, -1)};
  mark_times(cmd, Task::kContact, duration, kUnnamed);
  Panel out{.x_label = kTimeAxis,
            .y_label = "delivered [N]",
            .curves = three(d, "tool", d.tool.f_env[0], d.trainer.f_out[0], d.trainee.f_out[0], -1, -1)};
  mark_times(out, Task::kContact, duration, kUnnamed);
  f.figure.panels = {std::move(x), std::move(cmd), std::move(out)};
  return f;
}

}  // namespace

std::vector<CaptionedFigure> figures_of(const RunPlan& plan, const TraceData& trace) {
  if (trace.rows() == 0) return {};
  if (plan.task == Task::kFreeMotion)
    return {figure_6(trace), figure_7(trace, plan.duration_s), figure_8(trace, plan.duration_s),
            energy(plan, trace, "fig9", "Figure 9: energy of the flow sources in free motion")};
  return {figure_10(trace), figure_11(trace, plan.duration_s),
          energy(plan, trace, "fig12", "Figure 12: energy of the flow sources in contact")};
}

std::string figures_html(const RunPlan& plan, const TraceData& trace) {
  std::string html;
  for (const CaptionedFigure& f : figures_of(plan, trace)) html += to_html(f, plan.name);
  return html;
}

}  // namespace tandem::netsim::demo
