#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdio>

#include "common/base/format.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/tradeoff/reference.h"
#include "netsim/tradeoff/stable_stiffness.h"
#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim::tradeoff {
namespace {

const char* integrator_name(const Row& row) {
  return control::kIntegratorNames[static_cast<std::size_t>(row.numerics.integrator)].data();
}
const char* precision_name(const Row& row) {
  return control::kPrecisionNames[static_cast<std::size_t>(row.numerics.precision)].data();
}
std::string number_or(const std::optional<double>& value, const char* pattern, const char* otherwise) {
  if (!value) return otherwise;
  char text[64];
  std::snprintf(text, sizeof text, pattern, *value);
  return text;
}
/// A whole count of instructions; a fraction would suggest a precision that the mean of a loop lacks.
std::string count_text(const std::optional<double>& value) { return number_or(value, "%.0f", "-"); }

std::string stiffness_text(const Row& row) {
  if (row.stiffness_max_n_m >= kStiffnessMost) return format("> %.0e", kStiffnessMost);
  return row.stiffness_max_n_m <= 0 ? "none" : format("%.3g", row.stiffness_max_n_m);
}

std::string line_of(const Row& row, bool times) {
  std::string out = format("%8.5g  %-19s  %-6s  %8u  %8s  %8s", row.tick_hz, integrator_name(row), precision_name(row),
                           static_cast<unsigned>(row.numerics.substeps), count_text(row.cost.tool_instructions).c_str(),
                           count_text(row.cost.seat_instructions).c_str());
  if (times) out += format("  %7s  %7s", count_text(row.cost.tool_ns).c_str(), count_text(row.cost.seat_ns).c_str());
  if (row.stable) {
    out += format("  %9.3g  %9.3g  %9.3g  %9.3g", 1e6 * row.path_rms_m, 1e6 * row.integrator_rms_m,
                  1e3 * row.force_rms_n, 1e6 * row.energy_rms_j);
  } else {
    out += format("  %9s  %9s  %9s  %9s", "unstable", "-", "-", "-");
  }
  out += format("  %9s  %s%s", stiffness_text(row).c_str(), row.pareto ? "P" : " ",
                row.numerics.keeps_proof() ? "" : " unsafe");
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string header(bool times) {
  std::string out = format("%8s  %-19s  %-6s  %8s  %8s  %8s", "tick", "integrator", "type", "substeps", "tool", "seat");
  if (times) out += format("  %7s  %7s", "tool", "seat");
  out += format("  %9s  %9s  %9s  %9s  %9s\n", "path", "of it by", "force", "energy", "stiffest");
  out += format("%8s  %-19s  %-6s  %8s  %8s  %8s", "[Hz]", "", "", "[1]", "[instr]", "[instr]");
  if (times) out += format("  %7s  %7s", "[ns]", "[ns]");
  return out + format("  %9s  %9s  %9s  %9s  %9s\n", "[um]", "step [um]", "[mN]", "[uJ]", "[N/m]");
}

std::string words_of(const Row& row) {
  std::string name(integrator_name(row)), type(precision_name(row));
  for (char& c : name) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  for (char& c : type) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return format("tick_hz: %g  numerics { integrator: %s substeps: %u precision: %s }%s", row.tick_hz, name.c_str(),
                static_cast<unsigned>(row.numerics.substeps), type.c_str(),
                row.numerics.keeps_proof() ? "" : "  unsafe_gains: true");
}

}  // namespace

std::string tradeoff_text(const Tradeoff& tradeoff, bool all, bool times) {
  const ToolTask& task = tradeoff.task;
  std::string out = format(
      "%s: tool %.3g kg, %.3g N s/m; hand %.4g N/m, %.3g N s/m; %zu axes, %zu surfaces without friction; %g s\n"
      "RMS over the ticks against the truth: long double, at least %g steps per tick, hand in continuous motion.\n"
      "Force of the truth: %.4g N RMS.%s\n\n",
      tradeoff.scene.c_str(), task.tool.m, task.tool.b, task.k_c, task.b_rel, task.axes, task.contacts.size(),
      ToolTask::kDuration, kReferencePerTick, tradeoff.force_rms_n,
      all ? "" : " Rows: Pareto front (P) of force error and work per second, and the default.");
  out += header(times);
  for (const Row& row : tradeoff.rows)
    if (all || row.pareto || (row.numerics.is_default() && row.tick_hz == tradeoff.scene_tick_hz))
      out += line_of(row, times);
  out += "\n";
  for (const Advice& advice : tradeoff.advice)
    out += format("%s: %s\n  (%s)\n", advice.use.c_str(), advice.row ? words_of(*advice.row).c_str() : "no row",
                  advice.rule.c_str());
  for (const std::string& note : tradeoff.notes) out += "note: " + note + "\n";
  return out;
}

std::string tradeoff_csv(const Tradeoff& tradeoff, bool times) {
  std::string out =
      "tick[Hz],integrator,precision,substeps[1],tool[instructions],seat[instructions],stable,path_rms[m],integrator_"
      "rms[m],force_rms[N],energy_rms[J],stiffness_max[N/m],pareto,proof";
  out += times ? ",tool[ns],seat[ns]\n" : "\n";
  for (const Row& row : tradeoff.rows) {
    out +=
        format("%g,%s,%s,%u,%s,%s,%d", row.tick_hz, integrator_name(row), precision_name(row),
               static_cast<unsigned>(row.numerics.substeps), number_or(row.cost.tool_instructions, "%.0f", "").c_str(),
               number_or(row.cost.seat_instructions, "%.0f", "").c_str(), row.stable ? 1 : 0);
    if (row.stable) {
      out += format(",%.6g,%.6g,%.6g,%.6g", row.path_rms_m, row.integrator_rms_m, row.force_rms_n, row.energy_rms_j);
    } else {
      out += ",,,,";
    }
    out += format(",%.4g,%d,%d", row.stiffness_max_n_m, row.pareto ? 1 : 0, row.numerics.keeps_proof() ? 1 : 0);
    if (times) out += "," + number_or(row.cost.tool_ns, "%.1f", "") + "," + number_or(row.cost.seat_ns, "%.1f", "");
    out += "\n";
  }
  return out;
}

std::string tradeoff_svg(const Tradeoff& tradeoff) {
  constexpr std::array kInk{"trainer", "trainee", "third", "slave", "mark"};
  plot::Figure figure{.description = "Force error over work of every integrator", .columns = 2, .panels = {}};
  for (const auto precision : {control::Precision::kDouble, control::Precision::kFloat}) {
    plot::Panel panel{.title = tradeoff.scene + ", one step per tick, " +
                               std::string(control::kPrecisionNames[static_cast<std::size_t>(precision)]),
                      .x_label = "log10 of work per second",
                      .y_label = "log10 of force error [N]",
                      .height = 260};
    for (std::size_t i = 0; i < control::kIntegrators; ++i) {
      plot::Curve curve{
          .label = precision == control::Precision::kDouble ? std::string(control::kIntegratorNames[i]) : "",
          .ink = kInk[i],
          .points = {}};
      for (const Row& row : tradeoff.rows)
        if (row.stable && row.force_rms_n > 0 && row.numerics.substeps == 1 && row.numerics.precision == precision &&
            static_cast<std::size_t>(row.numerics.integrator) == i)
          curve.points.push_back({std::log10(row.work_per_s()), std::log10(row.force_rms_n)});
      panel.curves.push_back(std::move(curve));
    }
    for (const Row& row : tradeoff.rows)
      if (row.pareto && row.numerics.precision == precision)
        panel.notes.push_back({{std::log10(row.work_per_s()), std::log10(std::max(row.force_rms_n, 1e-12))},
                               format("%g Hz, %u", row.tick_hz, static_cast<unsigned>(row.numerics.substeps))});
    figure.panels.push_back(std::move(panel));
  }
  return plot::to_svg_file(figure);
}

}  // namespace tandem::netsim::tradeoff
