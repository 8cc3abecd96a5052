#include "netsim/demo/html_report.h"

#include <cmath>

#include "netsim/demo/report_style.h"
#include "netsim/demo/text_table.h"
#include "netsim/plot/plot_style.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {

std::string tag(const std::string& name, const std::string& text, const std::string& attributes = "") {
  return "<" + name + (attributes.empty() ? "" : " " + attributes) + ">" + text + "</" + name + ">";
}

std::string cell_html(const Cell& cell) {
  std::string value = cell.value;
  std::string limit = escaped(cell.limit);
  if (cell.mark != Mark::kNone) {
    const bool met = cell.mark == Mark::kMet;
    limit += std::string(" ") + tag("span", std::string(symbol(cell.mark)),
                                    met ? "class=\"met\" title=\"met\"" : "class=\"missed\" title=\"missed\"");
    if (!met) value = tag("span", value, "class=\"missed\"");
  }
  return tag("td", value, "class=\"value\"") + tag("td", limit, "class=\"limit\"");
}

/// Spaces at the beginning indent.
std::string indented(const std::string& label) {
  const std::size_t spaces = label.find_first_not_of(' ');
  return (spaces == 0 ? "" : "&emsp;") + escaped(label.substr(spaces));
}

std::string table_html(const Comparison& comparison) {
  std::string html =
      "<div class=\"scroll\"><table>\n<thead><tr><th></th><th></th><th>paper</th><th colspan=\"2\">our "
      "reproduction<br>(the paper’s "
      "gains)</th><th colspan=\"2\">Tandem’s<br>defaults</th><th colspan=\"2\">defaults on the<br>bad "
      "network</th></tr></thead>\n";
  for (const Section& section : comparison.sections) {
    html += "<tbody><tr class=\"section\">" + tag("th", escaped(section.title), "colspan=\"9\"") + "</tr>\n";
    for (const Row& row : section.rows) {
      std::string notes;
      for (const char letter : row.notes)
        notes += (notes.empty() ? "" : ",") + ("<a href=\"#note-" + std::string(1, letter) + "\">" + letter + "</a>");
      html += "<tr>" + tag("td", indented(row.label) + (notes.empty() ? "" : " " + tag("sup", notes))) +
              tag("td", escaped(row.unit)) + tag("td", row.paper, "class=\"paper\"");
      for (const Cell& cell : row.cells) html += cell_html(cell);
      html += "</tr>\n";
    }
    html += "</tbody>\n";
  }
  html += "</table></div>\n<ol class=\"notes\">\n";
  char letter = 'a';
  for (const std::string& note : comparison.footnotes)
    html += tag("li", escaped(note), "id=\"note-" + std::string(1, letter++) + "\"") + "\n";
  return html + "</ol>\n";
}

std::string violations_html(const ReportNumbers& report) {
  if (report.violations.empty()) return "none";
  std::string text;
  for (const ViolationNumbers& v : report.violations) {
    text += (text.empty() ? "" : "; ") + escaped(v.invariant) + (v.seat.empty() ? "" : " (" + escaped(v.seat) + ")") +
            " at " + number_text(v.at_s, 3) + " s" + (v.expected ? ", not promised by this law" : "");
  }
  return text;
}

/// "2.3 / 2.4 ms"
std::string pair_text(double a, double b, int decimals, const char* unit) {
  return number_text(a, decimals) + " / " + number_text(b, decimals) + unit;
}

std::string facts_html(const RunResult& run) {
  const ReportNumbers& r = run.report;
  std::string rows;
  const auto row = [&](const std::string& what, const std::string& trainer, const std::string& trainee) {
    rows += "<tr>" + tag("td", what) + tag("td", trainer) + tag("td", trainee) + "</tr>\n";
  };
  const auto link = [&](const std::string& what, auto read) { row(what, read(r.trainer_link), read(r.trainee_link)); };
  rows += "<tr><th></th><th>trainer</th><th>trainee</th></tr>\n";
  link("round trip, median / 99 %",
       [](const LinkNumbers& l) { return pair_text(l.rtt_p50_ms, l.rtt_p99_ms, 1, " ms"); });
  link("lost, up / down",
       [](const LinkNumbers& l) { return pair_text(l.loss_up_percent, l.loss_down_percent, 2, " %"); });
  link("longest gap, up / down", [](const LinkNumbers& l) { return pair_text(l.gap_up_ms, l.gap_down_ms, 1, " ms"); });
  row("distance to the slave, RMS, whole run", number_text(1e3 * r.trainer.tracking_m, 2) + " mm",
      number_text(1e3 * r.trainee.tracking_m, 2) + " mm");
  std::string html =
      "<div class=\"scroll\"><table class=\"facts\">\n" + rows +
      "</table></div>\n<p class=\"facts\">Network: " + network_text(run.plan->setting) +
      ". Verdict: " + tag("b", r.passed ? "pass" : "fail", r.passed ? "class=\"met\"" : "class=\"missed\"") +
      ". Broken invariants: " + violations_html(r) + ". Gate trips: " + number_text(r.gate_trips, 0) +
      ". Ticks more than 1 ms late: " +
      (std::isfinite(r.late_ticks) ? number_text(r.late_ticks, 0) : "none, virtual time") +
      ". Processor time: " + number_text(r.cpu_s, 2) + " s for " + number_text(r.duration_s, 1) + " s. Trace: <code>" +
      escaped(r.trace_hash.substr(0, 16)) + "</code>.</p>\n<pre>";
  for (const std::string& command : run.commands) html += escaped(command) + "\n";
  return html + "</pre>\n";
}

std::string introduction(const Circumstances& where) {
  std::string text =
      "<p>Tandem lets several people, each with a haptic device at a workstation of their own, hold the same tool: a "
      "server shares "
      "the authority α among the hands, and everybody feels the tool’s forces, also those who only follow. Here it "
      "repeats the two "
      "experiments of Licona, Liu, Lelevé, Eberard and Pham, “Collaborative Hands-on Training on Haptic Simulators” "
      "(ICVARS 2019), "
      "with simulated Touch devices and hands: a gesture in free motion, and contact with a bone-like block. Each is "
      "run with the "
      "paper’s gains, with Tandem’s defaults, and with the defaults through a network of 20 ms + 0–5 ms jitter and 5 % "
      "loss each way.</p>\n";
  text += where.real_time ? "<p class=\"soft\">In real time: a server, two clients and the network simulator, each a "
                            "process of its own, talked "
                            "over UDP on this machine. Hands are drawn from what their workstations wrote, the slave "
                            "from what the server wrote; "
                            "table and figures compare what happened at the same moment."
                          : "<p class=\"soft\">In virtual time (<code>--quick</code>): the same server, client and "
                            "network cores in one process, one "
                            "round per millisecond, without sockets and clocks. The same seed gives the same bytes.";
  text += "</p>\n<p class=\"soft\">" +
          escaped(where.date + " · " + where.machine + " · Tandem " + where.version + " · repeat with ") +
          tag("code", escaped(where.repeat)) + "</p>\n";
  return text;
}

}  // namespace

std::string html_report(std::span<const RunResult> runs, const Comparison& comparison, const Circumstances& where) {
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, "
      "initial-scale=1\">\n<title>Tandem: three hands on one tool</title>\n<style>" +
      std::string(kPlotColours) + std::string(kReportStyle) + std::string(kPlotRules) + "</style>\n</head>\n<body>\n<header>\n<h1>Tandem: three hands on one tool</h1>\n" +
      introduction(where) + "<nav><a href=\"#numbers\">Numbers</a>";
  for (const RunResult& run : runs)
    html += "<a href=\"#" + std::string(run.plan->name) + "\">" + escaped(title_of(*run.plan)) + "</a>";
  html +=
      "</nav>\n</header>\n<main>\n<h2 id=\"numbers\">The paper’s numbers beside ours</h2>\n<p class=\"soft\">✓ and ✗: "
      "within what is asked of "
      "that column, or not. A number without a limit is shown for comparison.</p>\n" +
      table_html(comparison);
  html +=
      "<h2 id=\"runs\">The paper’s figures, redrawn from each run</h2>\n<p class=\"soft\">Axes: x right, y away from "
      "the user, z up; 0 is the "
      "working pose of the device. In contact the block begins at x = 0.</p>\n";
  for (const RunResult& run : runs) {
    html += "<section id=\"" + std::string(run.plan->name) + "\">\n" + tag("h3", escaped(title_of(*run.plan))) + "\n" +
            facts_html(run) + run.figures_html + "</section>\n";
  }
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace tandem::netsim::demo
