#include <algorithm>
#include <cmath>

#include "netsim/cells/comparison_page.h"

/// Curves of a comparison over the delay.
namespace tandem::netsim {
namespace {

constexpr double kTrackingShown = 0.04;  // [m]; larger errors leave the panel
constexpr double kUnstableShown = 0.5;   // share of the seeds; a cell with more is in no curve
constexpr std::size_t kInks = 8;         // series0 to series7 of netsim/plot/plot_style.h

/// Returns whether only law, coupling, task and delay of a cell differ from the ordinary ones.
bool ordinary(const Cell& cell) {
  return cell.hands == 2 && cell.jitter_ms == 0 && cell.loss_percent == 0 && cell.outage_ms == 0 &&
         cell.alpha == CellAlpha::kOne;
}

/// Returns the curves of a number over the delay, one per name that `name_of` returns; empty: the cell is not in the
/// figure.
template <class NameOf>
std::vector<plot::Curve> curves_of(const ComparisonResult& c, CellTask task, CellNumber number, const NameOf& name_of) {
  std::vector<plot::Curve> curves;
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    const Cell& cell = c.cells[i];
    const std::string name = ordinary(cell) && cell.task == task ? name_of(cell) : std::string();
    const double value = c.of(i, number).median;
    if (name.empty() || std::isnan(value) || c.of(i, CellNumber::kUnstable).median > kUnstableShown) continue;
    auto curve = std::ranges::find(curves, name, &plot::Curve::label);
    if (curve == curves.end()) {
      plot::Curve added;
      added.label = name;
      added.ink = "series" + std::to_string(curves.size() % kInks);
      curve = curves.insert(curves.end(), std::move(added));
    }
    curve->points.push_back({cell.delay_ms, value * row_of(number).factor});
  }
  for (plot::Curve& curve : curves) std::ranges::stable_sort(curve.points, {}, &plot::Point2::x);
  return curves;
}

void add_panel(plot::Figure& figure, const char* title, CellNumber number, std::vector<plot::Curve> curves,
               double shown) {
  if (curves.empty()) return;
  const CellNumberRow& row = row_of(number);
  plot::Panel panel;
  panel.title = title;
  panel.x_label = "delay each way [ms]";
  panel.y_label = std::string(row.key == "stiffness_felt" ? "stiffness" : row.key) + " [" + std::string(row.unit) + "]";
  panel.height = 220;
  const plot::Range range = plot::range_of(curves, true, 0);
  panel.y = plot::Range{0, std::min(range.hi, shown * row.factor)};
  panel.curves = std::move(curves);
  figure.panels.push_back(std::move(panel));
}

}  // namespace

plot::Figure laws_figure(const ComparisonResult& c) {
  plot::Figure figure;
  figure.description = "Distance from hand to tool in free motion, and stiffness felt on bone, over the delay, by law";
  figure.columns = 2;
  const auto law = [](const Cell& cell) {
    return cell.coupling == HandCouplingKind::kEsc ? std::string(law_name_of(cell)) : std::string();
  };
  add_panel(figure, "Circle of 50 mm at 0.5 Hz: hand to tool, RMS", CellNumber::kTracking,
            curves_of(c, CellTask::kFree, CellNumber::kTracking, law), kTrackingShown);
  add_panel(figure, "Stiffness felt on bone", CellNumber::kStiffness,
            curves_of(c, CellTask::kWall, CellNumber::kStiffness, law), INFINITY);
  return figure;
}

plot::Figure couplings_figure(const ComparisonResult& c) {
  plot::Figure figure;
  figure.description = "Distance from hand to tool and drag in free motion over the delay, by coupling, law pd";
  figure.columns = 2;
  const auto coupling = [](const Cell& cell) {
    return cell.law == LawKind::kPd ? std::string(coupling_name_of(cell)) : std::string();
  };
  add_panel(figure, "Circle of 50 mm at 0.5 Hz: hand to tool, RMS", CellNumber::kTracking,
            curves_of(c, CellTask::kFree, CellNumber::kTracking, coupling), kTrackingShown);
  add_panel(figure, "Drag on the leader, RMS", CellNumber::kDrag,
            curves_of(c, CellTask::kFree, CellNumber::kDrag, coupling), INFINITY);
  return figure;
}

}  // namespace tandem::netsim
