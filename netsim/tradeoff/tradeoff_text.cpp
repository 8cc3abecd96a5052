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

std::string upper(std::string_view name) {
  std::string out(name);
  for (char& c : out) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return out;
}

std::string cell(const std::optional<double>& value, double scale) {
  return value ? format("%.3g", scale * *value) : "-";
}

/// Pads each cell to its column.
std::string line_of(const RowCells& row) {
  std::string out =
      format("%8s  %-19s  %-6s  %8s", row.tick.c_str(), row.integrator.c_str(), row.type.c_str(), row.substeps.c_str());
  for (const std::string& text : row.costs) out += format("  %8s", text.c_str());
  for (const std::string& text : row.numbers) out += format("  %9s", text.c_str());
  out.erase(out.find_last_not_of(' ') + 1);
  return out + "\n";
}

std::string header(bool times) {
  std::vector<std::string> what{"tool", "seat"}, unit{"[instr]", "[instr]"};
  if (times) {
    what.insert(what.end(), {"tool", "seat"});
    unit.insert(unit.end(), {"[ns]", "[ns]"});
  }
  return line_of({"tick",
                  "integrator",
                  "type",
                  "substeps",
                  what,
                  {"path", "of it by", "force", "energy", "stiffest", "front"}}) +
         line_of({"[Hz]", "", "", "[1]", unit, {"[um]", "step [um]", "[mN]", "[uJ]", "[N/m]"}});
}

std::string model_header(bool times) {
  std::vector<std::string> what{"model"}, unit{"[instr]"};
  if (times) {
    what.emplace_back("model");
    unit.emplace_back("[ns]");
  }
  return line_of({"tick", "integrator", "type", "substeps", what, {"path", "force", "energy", "front"}}) +
         line_of({"[Hz]", "", "", "[1]", unit, {"[um]", "[mN]", "[uJ]"}});
}

/// The tiers: cost of each model, and its distance from the fullest.
std::string tiers_text(const std::vector<ModelRow>& tiers, bool times) {
  if (tiers.empty()) return {};
  std::string out =
      "Models with the same hand, default numerics; path and force against the truth of each; from the fullest: "
      "between "
      "the truths.\n\n";
  const std::string ns = times ? format("  %8s", "[ns]") : "";
  out += format("%-29s  %-8s  %8s%s  %9s  %9s  %12s  %12s\n", "model", "contact", "[instr]", ns.c_str(), "path [um]",
                "force[mN]", "from fullest", "[mN]");
  for (const ModelRow& row : tiers) {
    const std::string time = times ? format("  %8s", count_text(row.cost.ns).c_str()) : "";
    out += format("%-29s  %-8s  %8s%s  %9s  %9s  %9s um  %12s\n", model_name(row).c_str(), contact_name(row).c_str(),
                  count_text(row.cost.instructions).c_str(), time.c_str(), cell(row.path_rms_m, 1e6).c_str(),
                  cell(row.force_rms_n, 1e3).c_str(), cell(row.apart_path_m, 1e6).c_str(),
                  cell(row.apart_force_n, 1e3).c_str());
  }
  return out + "\n";
}

std::string devices_text(const std::vector<ModelRow>& devices, bool all, bool times, double scene_tick_hz) {
  if (devices.empty()) return {};
  std::string out = "Device: " + model_name(devices[0]) + ", contact: " + contact_name(devices[0]) +
                    ". Its numerics are device { numerics { } }, or slave { numerics { } }.\n\n" + model_header(times);
  for (const ModelRow& row : devices)
    if (all || row.pareto || (!row.choice.numerics && row.choice.tick_hz == scene_tick_hz))
      out += line_of(cells_of(row, times));
  return out + "\n";
}

std::string csv_line(const ModelRow& row, bool times) {
  const RowCells cells = cells_of(row, false);
  const auto number = [](const std::optional<double>& value) { return number_or(value, "%.6g", ""); };
  std::string out =
      format("%s,%s,%g,%s,%s,%s,%s,,%d,%s,,%s,%s,,%d,,%s,%s", model_name(row).c_str(), contact_name(row).c_str(),
             row.choice.tick_hz, cells.integrator.c_str(), cells.type.c_str(), cells.substeps.c_str(),
             number_or(row.cost.instructions, "%.0f", "").c_str(), row.stable ? 1 : 0, number(row.path_rms_m).c_str(),
             number(row.force_rms_n).c_str(), number(row.energy_rms_j).c_str(), row.pareto ? 1 : 0,
             number(row.apart_path_m).c_str(), number(row.apart_force_n).c_str());
  if (times) out += "," + number_or(row.cost.ns, "%.1f", "") + ",";
  return out + "\n";
}

}  // namespace

std::string model_name(const ModelRow& row) {
  return std::string(kModelTierNames[static_cast<std::size_t>(row.choice.model)]);
}
std::string contact_name(const ModelRow& row) {
  return std::string(kContactTierNames[static_cast<std::size_t>(row.choice.contact)]);
}

RowCells cells_of(const Row& row, bool times) {
  RowCells out{format("%.5g", row.tick_hz),
               integrator_name(row),
               precision_name(row),
               std::to_string(row.numerics.substeps),
               {count_text(row.cost.tool_instructions), count_text(row.cost.seat_instructions)},
               {}};
  if (times) out.costs.insert(out.costs.end(), {count_text(row.cost.tool_ns), count_text(row.cost.seat_ns)});
  out.numbers = {"unstable", "-", "-", "-"};
  if (row.stable)
    out.numbers = {format("%.3g", 1e6 * row.path_rms_m), format("%.3g", 1e6 * row.integrator_rms_m),
                   format("%.3g", 1e3 * row.force_rms_n), format("%.3g", 1e6 * row.energy_rms_j)};
  out.numbers.push_back(stiffness_text(row));
  out.numbers.push_back(row.numerics.keeps_proof() ? row.pareto ? "P" : "" : row.pareto ? "P unsafe" : "unsafe");
  return out;
}

RowCells cells_of(const ModelRow& row, bool times) {
  RowCells out{format("%.5g", row.choice.tick_hz), "built_in", "double", "", {count_text(row.cost.instructions)}, {}};
  if (const auto& numerics = row.choice.numerics) {
    out.integrator = control::kIntegratorNames[static_cast<std::size_t>(numerics->integrator)];
    out.type = control::kPrecisionNames[static_cast<std::size_t>(numerics->precision)];
    out.substeps = std::to_string(numerics->substeps);
  }
  if (times) out.costs.push_back(count_text(row.cost.ns));
  out.numbers = {row.stable ? cell(row.path_rms_m, 1e6) : "unstable", cell(row.force_rms_n, 1e3),
                 cell(row.energy_rms_j, 1e6), row.pareto ? "P" : ""};
  return out;
}

std::string words_of(const Row& row) {
  return format("tick_hz: %g  numerics { integrator: %s substeps: %u precision: %s }%s", row.tick_hz,
                upper(integrator_name(row)).c_str(), static_cast<unsigned>(row.numerics.substeps),
                upper(precision_name(row)).c_str(), row.numerics.keeps_proof() ? "" : "  unsafe_gains: true");
}

std::string tradeoff_text(const Tradeoff& tradeoff, bool all, bool times) {
  const ToolTask& task = tradeoff.task;
  std::string out;
  if (!tradeoff.rows.empty()) {
    out = format(
        "%s: tool %.3g kg, %.3g N s/m; hand %.4g N/m, %.3g N s/m; %zu axes; surfaces without friction: %zu; %g s\n"
        "RMS over the ticks against the truth: long double, at least %g steps per tick, hand in continuous motion.\n"
        "Force of the truth: %.4g N RMS.%s\n\n",
        tradeoff.scene.c_str(), task.tool.m, task.tool.b, task.k_c, task.b_rel, task.axes, task.contacts.size(),
        ToolTask::kDuration, kReferencePerTick, tradeoff.force_rms_n,
        all ? "" : " Rows: Pareto front (P) of force error and work per second, and the default.");
    out += header(times);
    for (const Row& row : tradeoff.rows)
      if (all || row.pareto || (row.numerics.is_default() && row.tick_hz == tradeoff.scene_tick_hz))
        out += line_of(cells_of(row, times));
    out += "\n";
  }
  for (const Advice& advice : tradeoff.advice)
    out += format("%s: %s\n  (%s)\n", advice.use.c_str(), advice.row ? words_of(*advice.row).c_str() : "no row",
                  advice.rule.c_str());
  if (!tradeoff.advice.empty()) out += "\n";
  out += devices_text(tradeoff.devices, all, times, tradeoff.scene_tick_hz);
  out += tiers_text(tradeoff.tiers, times);
  for (const std::string& note : tradeoff.notes) out += "note: " + note + "\n";
  return out;
}

std::string tradeoff_csv(const Tradeoff& tradeoff, bool times) {
  std::string out =
      "model,contact,tick[Hz],integrator,precision,substeps[1],tool[instructions],seat[instructions],stable,path_rms[m]"
      ",integrator_"
      "rms[m],force_rms[N],energy_rms[J],stiffness_max[N/m],pareto,proof,from_fullest[m],from_fullest[N]";
  out += times ? ",tool[ns],seat[ns]\n" : "\n";
  const char* const contact = tradeoff.task.contacts.size() == 0 ? "none" : "plane or tissue";
  for (const Row& row : tradeoff.rows) {
    out +=
        format("virtual tool,%s,%g,%s,%s,%u,%s,%s,%d", contact, row.tick_hz, integrator_name(row), precision_name(row),
               static_cast<unsigned>(row.numerics.substeps), number_or(row.cost.tool_instructions, "%.0f", "").c_str(),
               number_or(row.cost.seat_instructions, "%.0f", "").c_str(), row.stable ? 1 : 0);
    if (row.stable) {
      out += format(",%.6g,%.6g,%.6g,%.6g", row.path_rms_m, row.integrator_rms_m, row.force_rms_n, row.energy_rms_j);
    } else {
      out += ",,,,";
    }
    out += format(",%.4g,%d,%d,,", row.stiffness_max_n_m, row.pareto ? 1 : 0, row.numerics.keeps_proof() ? 1 : 0);
    if (times) out += "," + number_or(row.cost.tool_ns, "%.1f", "") + "," + number_or(row.cost.seat_ns, "%.1f", "");
    out += "\n";
  }
  for (const auto* rows : {&tradeoff.devices, &tradeoff.tiers})
    for (const ModelRow& row : *rows) out += csv_line(row, times);
  return out;
}

}  // namespace tandem::netsim::tradeoff
