#include "common/base/format.h"
#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/report_style.h"
#include "netsim/plot/plot_style.h"
#include "netsim/tradeoff/reference.h"
#include "netsim/tradeoff/tradeoff.h"

namespace tandem::netsim::tradeoff {
namespace {

using plot::escaped;

constexpr std::string_view kPageStyle = R"css(
body { max-width: 1400px; } table.rows { font-size: 13px; } table.rows td, table.rows th { padding: 3px 6px; }
table.rows td:nth-child(2), table.rows td:nth-child(3), table.tiers td { color: var(--fg); } table.tiers { width: auto; } table.rows td:nth-child(3), table.rows th:nth-child(3) { text-align: left; }
details tr.front td { font-weight: 600; } tr.front td:last-child { color: var(--met); } td.unstable { color: var(--missed); }
table.advice td, table.advice th { text-align: left; } table.advice td { text-align: left; white-space: normal; color: var(--fg); } table.advice td:last-child { color: var(--soft); }
)css";

/// Head of a table from its column titles.
std::string head_of(const char* style, const std::vector<std::string>& titles) {
  std::string html = std::string("<div class=\"scroll\"><table class=\"") + style + "\"><thead><tr>";
  for (const std::string& title : titles) html += "<th>" + escaped(title) + "</th>";
  return html + "</tr></thead><tbody>\n";
}
constexpr std::string_view kTableEnd = "</tbody></table></div>\n";

std::string html_line(const RowCells& cells, bool front) {
  std::string html = front ? "<tr class=\"front\">" : "<tr>";
  const auto add = [&](const std::string& text) {
    html += (text == "unstable" ? "<td class=\"unstable\">" : "<td>") + escaped(text) + "</td>";
  };
  for (const std::string* text : {&cells.tick, &cells.integrator, &cells.type, &cells.substeps}) add(*text);
  for (const std::string& text : cells.costs) add(text);
  for (const std::string& text : cells.numbers) add(text);
  return html + "</tr>\n";
}

/// The rows of the front, and all rows behind a summary.
template <class Rows>
std::string tables_of(const Rows& rows, const std::vector<std::string>& titles, bool times) {
  const std::string head = head_of("rows", titles);
  std::string front = head, all = head;
  for (const auto& row : rows) {
    const std::string line = html_line(cells_of(row, times), row.pareto);
    all += line;
    if (row.pareto) front += line;
  }
  return "<h4>Pareto front</h4>\n" + front + std::string(kTableEnd) +
         format("<details><summary>All %zu rows</summary>\n", rows.size()) + all + std::string(kTableEnd) +
         "</details>\n";
}

std::string figure_html(const char* anchor, const char* title, plot::Figure figure) {
  if (figure.panels.empty()) return {};
  return demo::to_html({anchor, title,
                        "Lines: one step per tick at every tick rate. Dots: Pareto front of force error and work per "
                        "second, all substeps; labels are tick rates. Work is the number of instructions, or of steps "
                        "where instructions were not counted. Errors below 1e-12 N are drawn there.",
                        std::move(figure)},
                       "tradeoff");
}

std::string tool_section(const Tradeoff& t, bool times) {
  if (t.rows.empty()) return {};
  std::vector<std::string> titles{"tick [Hz]", "integrator", "type", "substeps", "tool [instr]", "seat [instr]"};
  if (times) titles.insert(titles.end(), {"tool [ns]", "seat [ns]"});
  titles.insert(titles.end(),
                {"path [µm]", "of it by step [µm]", "force [mN]", "energy [µJ]", "stiffest [N/m]", "front"});
  std::string html = format(
      "<h2 id=\"tool\">Simulated tool</h2>\n<p>Tool of %.3g kg and %.3g N s/m; hand of %.4g N/m and %.3g N s/m; %zu "
      "axes; surfaces without friction: %zu; %g s. Errors are RMS over the ticks against the truth: long double, at "
      "least %g steps per tick, hand in continuous motion. The force of the truth is %.4g N RMS. "
      "<code>unsafe</code>: needs <code>unsafe_gains: true</code>.</p>\n",
      t.task.tool.m, t.task.tool.b, t.task.k_c, t.task.b_rel, t.task.axes, t.task.contacts.size(), ToolTask::kDuration,
      kReferencePerTick, t.force_rms_n);
  html += "<h4>Recommended</h4>\n" + head_of("advice", {"use", "keys of the scene", "rule"});
  for (const Advice& advice : t.advice)
    html += "<tr><td>" + escaped(advice.use) + "</td><td>" +
            (advice.row ? "<code>" + escaped(words_of(*advice.row)) + "</code>" : "no row") + "</td><td>" +
            escaped(advice.rule) + "</td></tr>\n";
  return html + std::string(kTableEnd) + figure_html("tool", "Force error over work", tool_figure(t)) +
         tables_of(t.rows, titles, times);
}

std::string device_section(const Tradeoff& t, bool times) {
  if (t.devices.empty()) return {};
  std::vector<std::string> titles{"tick [Hz]", "integrator", "type", "substeps", "model [instr]"};
  if (times) titles.emplace_back("model [ns]");
  titles.insert(titles.end(), {"path [µm]", "force [mN]", "energy [µJ]", "front"});
  return "<h2 id=\"device\">Simulated device</h2>\n<p>Model: " + escaped(model_name(t.devices[0])) +
         "; contact: " + escaped(contact_name(t.devices[0])) +
         ". The keys are <code>device { numerics { } }</code> of a seat and <code>slave { numerics { } }</code> of a "
         "tool. "
         "<code>built_in</code> is the scheme without the key: linearly implicit steps of at most 0.25 ms.</p>\n" +
         figure_html("device", "Force error over work", device_figure(t)) + tables_of(t.devices, titles, times);
}

std::string tier_section(const Tradeoff& t, bool times) {
  if (t.tiers.empty()) return {};
  std::vector<std::string> titles{"model", "contact", "cost [instr]"};
  if (times) titles.emplace_back("cost [ns]");
  titles.insert(titles.end(),
                {"path [µm]", "force [mN]", "energy [µJ]", "from the fullest [µm]", "from the fullest [mN]"});
  std::string html =
      "<h2 id=\"models\">Models</h2>\n<p>The same hand moves each model with its default numerics at the scene's tick. "
      "Errors are against the truth of the same model; the last columns are distances between the truths of a model "
      "and "
      "of the fullest one. No reference solves friction of surfaces.</p>\n" +
      head_of("tiers", titles);
  const auto cell = [](const std::optional<double>& value, double scale) {
    return "<td>" + (value ? format("%.3g", scale * *value) : std::string("–")) + "</td>";
  };
  for (const ModelRow& row : t.tiers) {
    html += "<tr><td>" + escaped(model_name(row)) + "</td><td>" + escaped(contact_name(row)) + "</td>" +
            (row.cost.instructions ? format("<td>%.0f</td>", *row.cost.instructions) : std::string("<td>–</td>"));
    if (times) html += row.cost.ns ? format("<td>%.0f</td>", *row.cost.ns) : std::string("<td>–</td>");
    html += cell(row.path_rms_m, 1e6) + cell(row.force_rms_n, 1e3) + cell(row.energy_rms_j, 1e6) +
            cell(row.apart_path_m, 1e6) + cell(row.apart_force_n, 1e3) + "</tr>\n";
  }
  return html + std::string(kTableEnd);
}

}  // namespace

std::string tradeoff_page(const Tradeoff& t, bool times, const std::string& version) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Tandem: numerics of " +
      escaped(t.scene) + "</title>\n<style>" + std::string(plot::kPlotColours) + std::string(demo::kReportStyle) +
      std::string(plot::kPlotRules) + std::string(kPageStyle) +
      "</style>\n</head>\n<body>\n<header>\n<h1>Numerics of scene " + escaped(t.scene) +
      "</h1>\n<p class=\"headline\">Cost and error of every choice</p>\n<p class=\"soft\">Tandem " + escaped(version) +
      " · <code>tandem-netsim tradeoff " + escaped(t.scene) + " --html FILE</code></p>\n<nav>";
  if (!t.rows.empty()) html += "<a href=\"#tool\">Simulated tool</a>";
  if (!t.devices.empty()) html += "<a href=\"#device\">Simulated device</a>";
  if (!t.tiers.empty()) html += "<a href=\"#models\">Models</a>";
  html += "</nav>\n</header>\n<main>\n";
  if (t.interrupted) html += "<p class=\"missed\">The measurement was interrupted: rows are missing.</p>\n";
  for (const std::string& note : t.notes) html += "<p class=\"soft\">Note: " + escaped(note) + ".</p>\n";
  return html + tool_section(t, times) + device_section(t, times) + tier_section(t, times) +
         "</main>\n</body>\n</html>\n";
}

}  // namespace tandem::netsim::tradeoff
