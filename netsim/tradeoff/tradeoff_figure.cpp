#include <algorithm>
#include <array>
#include <cmath>

#include "common/base/format.h"
#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim::tradeoff {
namespace {

/// One row as a point of a figure.
struct Dot {
  std::size_t integrator = 0, precision = 0;
  unsigned substeps = 1;
  double tick_hz = 1000, work_per_s = 1, force_rms_n = 0;
  bool pareto = false, built_in = false;
};
/// Errors of rounding alone are drawn here [N].
constexpr double kLeastForce = 1e-12;

plot::Point2 place_of(const Dot& dot) {
  return {std::log10(dot.work_per_s), std::log10(std::max(dot.force_rms_n, kLeastForce))};
}

/// One panel per precision. The front is marked by dots, labelled where the tick rate changes.
plot::Figure figure_of(const std::string& what, const std::vector<Dot>& dots) {
  constexpr std::array kInk{"trainer", "trainee", "third", "slave", "mark"};
  plot::Figure figure{.description = "Force error over work of every integrator: " + what, .columns = 2, .panels = {}};
  for (std::size_t precision = 0; precision < control::kPrecisionNames.size(); ++precision) {
    plot::Panel panel{.title = what + ", " + std::string(control::kPrecisionNames[precision]) + ", one step per tick",
                      .x_label = "log10 of work per second",
                      .y_label = "log10 of force error [N]",
                      .height = 260};
    const auto add = [&](const std::string& label, const char* ink, auto&& shown) {
      plot::Curve curve{.label = precision == 0 ? label : "", .ink = ink, .points = {}};
      for (const Dot& dot : dots)
        if (dot.precision == precision && shown(dot)) curve.points.push_back(place_of(dot));
      if (!curve.points.empty()) panel.curves.push_back(std::move(curve));
    };
    for (std::size_t i = 0; i < control::kIntegrators; ++i)
      add(std::string(control::kIntegratorNames[i]), kInk[i],
          [&](const Dot& dot) { return !dot.built_in && dot.substeps == 1 && dot.integrator == i; });
    add("built_in", "series5", [](const Dot& dot) { return dot.built_in; });
    double labelled = 0;
    for (const Dot& dot : dots) {
      if (!dot.pareto || dot.precision != precision) continue;
      panel.notes.push_back({place_of(dot), dot.tick_hz == labelled ? "" : format("%g Hz", dot.tick_hz)});
      labelled = dot.tick_hz;
    }
    if (!panel.curves.empty()) figure.panels.push_back(std::move(panel));
  }
  return figure;
}

}  // namespace

plot::Figure tool_figure(const Tradeoff& tradeoff) {
  std::vector<Dot> dots;
  for (const Row& row : tradeoff.rows)
    if (row.stable)
      dots.push_back({static_cast<std::size_t>(row.numerics.integrator),
                      static_cast<std::size_t>(row.numerics.precision), row.numerics.substeps, row.tick_hz,
                      row.work_per_s(), row.force_rms_n, row.pareto, false});
  return figure_of("tool", dots);
}

plot::Figure device_figure(const Tradeoff& tradeoff) {
  std::vector<Dot> dots;
  for (const ModelRow& row : tradeoff.devices) {
    if (!row.stable || !row.force_rms_n) continue;
    Dot dot{.tick_hz = row.choice.tick_hz,
            .work_per_s = row.work_per_s(),
            .force_rms_n = *row.force_rms_n,
            .pareto = row.pareto,
            .built_in = !row.choice.numerics};
    if (const auto& numerics = row.choice.numerics) {
      dot.integrator = static_cast<std::size_t>(numerics->integrator);
      dot.precision = static_cast<std::size_t>(numerics->precision);
      dot.substeps = numerics->substeps;
    }
    dots.push_back(dot);
  }
  return figure_of("device", dots);
}

std::string tradeoff_svg(const Tradeoff& tradeoff) {
  return plot::to_svg_file(tradeoff.rows.empty() ? device_figure(tradeoff) : tool_figure(tradeoff));
}

}  // namespace tandem::netsim::tradeoff
