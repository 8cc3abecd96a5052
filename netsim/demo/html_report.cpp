#include "netsim/demo/html_report.h"

#include <cmath>

#include "netsim/demo/animation.h"
#include "netsim/demo/comparison_table.h"
#include "netsim/demo/headline.h"
#include "netsim/demo/overlay.h"
#include "netsim/demo/report_style.h"
#include "netsim/demo/setup_picture.h"
#include "netsim/plot/plot_style.h"
#include "netsim/plot/svg_plot.h"
#include "netsim/plot/ticks.h"

namespace tandem::netsim::demo {

using namespace plot;

namespace {

std::string violations_html(const ReportNumbers& report) {
  if (report.violations.empty()) return "none";
  std::string text;
  for (const ViolationNumbers& v : report.violations) {
    text += (text.empty() ? "" : "; ") + escaped(v.invariant) + (v.seat.empty() ? "" : " (" + escaped(v.seat) + ")") +
            " at " + number_text(v.at_s, 3) + " s" + (v.expected ? ", not promised by this law" : "");
  }
  return text;
}

/// Returns, for example, "2.3 / 2.4 ms".
std::string pair_text(double a, double b, int decimals, const char* unit) {
  return number_text(a, decimals) + " / " + number_text(b, decimals) + unit;
}

std::string facts_html(const RunResult& run, const std::string& note) {
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
  row("distance to the tool, RMS, whole run", number_text(1e3 * r.trainer.tracking_m, 2) + " mm",
      number_text(1e3 * r.trainee.tracking_m, 2) + " mm");
  std::string html =
      "<div class=\"scroll\"><table class=\"facts\">\n" + rows +
      "</table></div>\n<p class=\"facts\">Network: " + network_text(run.plan->setting) +
      ". Verdict: " + tag("b", r.passed ? "pass" : "fail", r.passed ? "class=\"met\"" : "class=\"missed\"") +
      ". Broken invariants: " + violations_html(r) + ". Gate trips: " + number_text(r.gate_trips, 0) +
      ". Ticks more than 1 ms late: " +
      (std::isfinite(r.late_ticks) ? number_text(r.late_ticks, 0) : "none, virtual time") +
      ". Processor time: " + number_text(r.cpu_s, 2) + " s for " + number_text(r.duration_s, 1) + " s. Trace: <code>" +
      escaped(r.trace_hash.substr(0, 16)) + "</code>.</p>\n<p>" + note + "</p>\n<pre>";
  for (const std::string& command : run.commands) html += escaped(command) + "\n";
  return html + "</pre>\n";
}

std::string first_screen(const Headline& headline, const RunInfo& where) {
  std::string html = tag("p", escaped(headline.sentence), "class=\"headline\"") + "\n";
  if (!headline.disturbed.empty()) html += tag("p", escaped(headline.disturbed), "class=\"missed\"") + "\n";
  if (!headline.missed.empty()) {
    html += "<ul class=\"missed\">";
    for (const std::string& limit : headline.missed) html += tag("li", escaped(limit));
    html += "</ul>\n";
  }
  html += "<div class=\"first\"><div class=\"numbers\">\n";
  for (const KeyNumber& number : headline.numbers)
    html += "<div class=\"number\">" + tag("b", escaped(number.value)) + tag("span", escaped(number.what)) +
            tag("span", escaped(number.beside), "class=\"soft\"") + "</div>\n";
  return html + "</div>\n" + setup_picture(where.real_time) + "</div>\n";
}

std::string introduction(const RunInfo& where) {
  std::string text =
      "<p>Tandem couples several participants, each with a haptic device at their own workstation, to the same tool. A "
      "server "
      "shares the authority α among the hands, and every hand feels the tool’s forces. This page repeats the two "
      "experiments of Licona, Liu, Lelevé, Eberard and Pham, “Collaborative Hands-on Training on Haptic Simulators” "
      "(ICVARS 2019), with simulated Touch devices and hands: a gesture in free motion, and contact with a bone-like "
      "block. Each runs with the paper’s gains, with Tandem’s defaults, and with the defaults through a network of " +
      escaped(network_text(Setting::kBadNetwork)) + ".</p>\n";
  text +=
      where.real_time
          ? "<p class=\"soft\">In real time: a server, two clients and the network simulator ran as processes on "
            "this machine and exchanged UDP datagrams. Hands are drawn from the traces of their workstations, the "
            "tool from the trace of the server. Table and figures compare the same moments. The clock of the "
            "network’s delays is aligned with the session to about 0.1 s."
          : "<p class=\"soft\">In virtual time (<code>--quick</code>): the same server, client and network cores "
            "ran in one process without sockets and clocks, one round per millisecond. The same seed gives the same "
            "bytes.";
  text += "</p>\n<p class=\"soft\">" +
          escaped(where.date + " · " + where.machine + " · Tandem " + where.version + " · repeat with ") +
          tag("code", escaped(where.repeat)) + "</p>\n";
  return text;
}

std::string head() {
  return "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
         "content=\"width=device-width, initial-scale=1\">\n<title>Tandem: two people, one tool</title>\n<style>" +
         std::string(kPlotColours) + std::string(kReportStyle) + std::string(kPlotRules) + "</style>\n</head>\n";
}

std::string run_section(const RunResult& run, const RunInfo& where) {
  const std::string note = where.real_time ? "These commands repeat the run. Start each in a terminal of its own, in "
                                             "this order, from the folder in which the demo was started:"
                                           : "This command repeats the run, from the folder in which the demo was "
                                             "started. It writes the same trace, byte for byte:";
  return "<details id=\"" + std::string(run.plan->name) + "\">\n<summary>" + escaped(title_of(*run.plan)) +
         "</summary>\n" + facts_html(run, note) + run.figures_html + "</details>\n";
}

}  // namespace

std::string html_report(std::span<const RunResult> runs, const Comparison& comparison, const RunInfo& where) {
  std::string html = head() + "<body>\n<header>\n<h1>Tandem: two people, one tool</h1>\n" +
                     first_screen(headline_of(runs, comparison), where) +
                     "<nav><a href=\"#motion\">Watch it</a><a href=\"#overlays\">Settings compared</a>"
                     "<a href=\"#numbers\">Numbers</a><a href=\"#runs\">Each run</a></nav>\n" +
                     introduction(where) + "</header>\n<main>\n" + animation_html(runs);
  html += "<h2 id=\"overlays\">The settings over each other</h2>\n";
  for (const CaptionedFigure& figure : overlay_figures(runs)) html += to_html(figure, "settings");
  html +=
      "<h2 id=\"numbers\">The paper’s numbers beside ours</h2>\n<p class=\"soft\">✓ and ✗: within what is asked of "
      "that "
      "column, or not. A number without a limit is shown for comparison.</p>\n" +
      to_html(comparison);
  html +=
      "<h2 id=\"runs\">Each run: the paper’s figures, redrawn</h2>\n<p class=\"soft\">Axes: x right, y away from the "
      "user, z up; 0 is the working pose of the device. In contact the block begins at x = 0. Open a run to see its "
      "figures and the commands that repeat it.</p>\n";
  for (const RunResult& run : runs) html += run_section(run, where);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace tandem::netsim::demo
