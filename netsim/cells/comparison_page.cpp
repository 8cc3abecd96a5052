#include "netsim/cells/comparison_page.h"

#include <cmath>

#include "common/base/format.h"
#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/report_style.h"
#include "netsim/plot/plot_style.h"

namespace tandem::netsim {
namespace {

using plot::escaped;

constexpr std::string_view kPageStyle = R"css(
body { max-width: 1400px; } table.all td, table.all th { text-align: right; padding: 2px 6px; }
table.all td:nth-child(-n+3), table.all th:nth-child(-n+3) { text-align: left; color: var(--fg); } table.all { font-size: 12px; }
table.all td:last-child { text-align: left; } table.words td, table.words th { text-align: left; white-space: normal; color: var(--fg); }
)css";

std::string words(std::string_view text) { return escaped(text); }

std::string introduction(const ComparisonResult& c, const std::string& version) {
  const std::string file = c.typed;
  std::string html = "<h1>Laws and couplings compared</h1>\n<p class=\"headline\">" + words(c.spec.summary) +
                     "</p>\n<p>Cells of " + words(c.spec.name) + ": " + std::to_string(c.finished()) + " of " +
                     std::to_string(c.cells.size()) + " cells, each with " + std::to_string(c.spec.seeds) +
                     " seeds: other hands and other random networks. Tables show the median over the seeds; the worst "
                     "seed is named beside it or appears on pointing at a square. Devices, gate and coupling of the "
                     "devices are those of scene <code>" +
                     words(c.spec.scene.value) + "</code>. All runs are in virtual time with simulated hands.</p>\n";
  if (c.finished() < c.cells.size())
    html += "<p class=\"missed\">The sweep is not complete: cells that were not run are left out.</p>\n";
  html += "<p class=\"soft\">Tandem " + words(version) + " · all cells: <code>tandem-netsim sweep --cells " +
          words(file) + " --html comparison.html</code> · one cell alone, with the same numbers: <code>" +
          words(repeat_command(file, 1)) +
          "</code>; the number of a cell appears on pointing at its square, and the last table "
          "has the whole command of each.</p>\n<nav>";
  html += "<a href=\"#numbers\">Definitions of the numbers</a><a href=\"#default\">The default against all others</a>";
  for (std::size_t g = 0; g < c.spec.grids.size(); ++g)
    html += "<a href=\"#grid-" + c.spec.grids[g].name + "\">" + words(c.spec.grids[g].name) + "</a>";
  return html + "<a href=\"#all\">All cells</a></nav>\n";
}

std::string definitions() {
  std::string html = "<h2 id=\"numbers\">Definitions of the numbers</h2>\n<table class=\"words\"><tbody>\n";
  for (const CellNumberRow& row : kCellNumbers)
    html += "<tr><th>" + std::string(row.title) + " [" + std::string(row.unit) + "]</th><td>" + words(row.definition) +
            "</td></tr>\n";
  return html +
         "</tbody></table>\n<p class=\"soft\">– : the task has no such number, or the leader was not in contact. ! : a "
         "session did not run, or broke an invariant that its law promises. Colours are the same in all maps of a "
         "number: the stronger, the worse.</p>\n";
}

std::string figures(const ComparisonResult& c) {
  std::string html;
  const auto add = [&](const char* anchor, const char* title, const char* caption, plot::Figure figure) {
    if (figure.panels.empty()) return;
    html += demo::to_html({anchor, title, caption, std::move(figure)}, "comparison");
  };
  add("laws", "Laws over the delay",
      "Medians. Two hands, all authority at the leader, no jitter and no loss. Errors above 40 mm leave the panel. "
      "Cells in which most seeds are unstable are left out.",
      laws_figure(c));
  add("couplings", "Couplings between hands over the delay", "Medians, law pd, in the same conditions.",
      couplings_figure(c));
  return html;
}

std::string default_section(const ComparisonResult& c) {
  std::string html =
      "<h2 id=\"default\">The default against all others</h2>\n<p>In each condition the median of law replica with "
      "coupling esc is compared with the best of all other laws and couplings that are stable with every seed. A row "
      "names a condition in which another one is more than 10 % better.</p>\n";
  for (const DefaultVerdict& verdict : judge_default(c)) {
    if (verdict.compared == 0) continue;
    const CellNumberRow& row = row_of(verdict.number);
    html += format("<details><summary>%s: best or within 10 %% in %zu of %zu conditions</summary>\n",
                   std::string(row.title).c_str(), verdict.compared - verdict.exceptions.size(), verdict.compared);
    if (!verdict.exceptions.empty()) {
      html +=
          "<div class=\"scroll\"><table class=\"heat\"><thead><tr><th>condition</th><th>delay [ms]</th><th>default [" +
          std::string(row.unit) + "]</th><th>best</th><th>law</th></tr></thead><tbody>\n";
      for (const DefaultVerdict::Exception& e : verdict.exceptions)
        html += "<tr><th>" + words(condition_text(c.cells[e.own])) +
                format("</th><td>%.9g</td><td>", c.cells[e.own].delay_ms) + report_text(row, e.own_value) +
                "</td><td>" + report_text(row, e.best_value) + "</td><td>" + words(law_text(c.cells[e.best])) +
                "</td></tr>\n";
      html += "</tbody></table></div>";
    }
    html += "</details>\n";
  }
  return html;
}

std::string all_cells(const ComparisonResult& c) {
  std::string html = "<h2 id=\"all\">All cells</h2>\n<p class=\"soft\">Median / worst seed.</p>\n<details><summary>" +
                     std::to_string(c.finished()) +
                     " cells</summary><div class=\"scroll\"><table class=\"all\"><thead><tr><th>cell</th><th>law, "
                     "coupling</th><th>condition</th><th>delay [ms]</th>";
  for (const CellNumberRow& row : kCellNumbers)
    html += "<th>" + std::string(row.title) + " [" + std::string(row.unit) + "]</th>";
  html += "<th>command</th></tr></thead><tbody>\n";
  for (std::size_t i = 0; i < c.cells.size(); ++i) {
    if (!c.results[i]) continue;
    const Cell& cell = c.cells[i];
    html += "<tr><td>" + std::to_string(cell.number) + (c.results[i]->sound() ? "" : "!") + "<td>" +
            words(law_text(cell)) + "<td>" + words(condition_text(cell)) + format("<td>%.9g", cell.delay_ms);
    for (const CellNumberRow& row : kCellNumbers) {
      const CellResult::Summary sum = c.of(i, row.number);
      html += "<td>";
      if (std::isnan(sum.median)) continue;
      html += report_text(row, sum.median);
      if (row.number != CellNumber::kUnstable) html += "/" + report_text(row, sum.worst);
    }
    html += "<td><code>" + words(repeat_command(c.typed, cell.number)) + "</code>\n";
  }
  return html + "</tbody></table></div></details>\n";
}

}  // namespace

std::string comparison_page(const ComparisonResult& c, const std::string& version) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Tandem: laws and couplings compared (" +
      words(c.spec.name) + ")</title>\n<style>" + std::string(plot::kPlotColours) + std::string(demo::kReportStyle) +
      std::string(plot::kPlotRules) + std::string(kPageStyle) + heat_style() + "</style>\n</head>\n<body>\n<header>\n" +
      introduction(c, version) + "</header>\n<main>\n" + figures(c) + definitions() + default_section(c);
  for (std::size_t g = 0; g < c.spec.grids.size(); ++g)
    html += "<h2 id=\"grid-" + c.spec.grids[g].name + "\">Grid " + words(c.spec.grids[g].name) + "</h2>\n" +
            heat_maps(c, g);
  return html + all_cells(c) + "</main>\n</body>\n</html>\n";
}

}  // namespace tandem::netsim
