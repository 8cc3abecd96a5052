#include "netsim/score/score_page.h"

#include <algorithm>
#include <chrono>
#include <cmath>

#include "common/base/format.h"
#include "netsim/demo/captioned_figure.h"
#include "netsim/demo/report_style.h"
#include "netsim/plot/plot_style.h"
#include "netsim/score/score_figures.h"
#include "netsim/score/score_tables.h"
#include "proto/spec/access_role.h"

namespace tandem::netsim::score {
namespace {

using plot::escaped;

constexpr std::size_t kCurvesShown = 8;

constexpr std::string_view kScoreStyle = R"css(
body { max-width: 1080px; } h2 { margin-top: 36px; } td.words, th.words { white-space: normal; text-align: left; color: var(--fg); }
table.scores td:nth-child(2) { color: var(--soft); max-width: 44ch; } table.scores th, table.all th, table.links th, table.progress th { white-space: normal; }
table.all td:nth-child(2), table.all th:nth-child(2), table.links td:nth-child(3), table.progress td:nth-child(2) { text-align: right; color: var(--fg); }
table.progress th:nth-child(2), table.links th:nth-child(2) { color: var(--fg); } table.links td.met, table.links td.missed { font-weight: 600; }
table.events, table.sheets { width: auto; } table.events td:first-child { white-space: nowrap; vertical-align: top; }
td.missed { font-weight: 400; } abbr { text-decoration: none; color: var(--missed); font-weight: 700; cursor: help; }
dl { columns: 2; column-gap: 32px; } dt { font-weight: 600; } dd { margin: 0 0 6px; break-before: avoid; } dt, dd { break-inside: avoid; }
svg.isometric { max-width: 640px; margin: 0 auto; } ul.doubts { color: var(--missed); font-size: 14px; padding-left: 20px; }
.tiles { display: grid; grid-template-columns: repeat(auto-fit, minmax(170px, 1fr)); gap: 14px 24px; margin: 18px 0 6px; }
.tile { border-left: 4px solid var(--trainer); padding: 2px 0 2px 12px; } .tile b { font-size: 26px; line-height: 1.15; display: block; } .tile span { color: var(--soft); font-size: 14px; }
@media (max-width: 640px) { dl { columns: 1; } table.scores, table.scores tbody { display: block; } table.scores thead { display: none; }
  table.scores tr { display: grid; grid-template-columns: 1fr auto; gap: 0 10px; padding: 7px 0; border-bottom: 1px solid var(--grid); }
  table.scores td { border: 0; padding: 1px 0; white-space: normal; } table.scores td:first-child { font-weight: 600; }
  table.scores td:nth-child(2) { grid-column: 1 / 3; order: 9; font-size: 13px; max-width: none; }
  table.scores td.held, table.scores td.median, table.scores td.mark, table.scores td.standing { grid-column: 1 / 3; text-align: left; font-size: 13px; }
  td.held::before { content: "holding the tool: "; color: var(--soft); } td.median::before { content: "experts' median: "; color: var(--soft); } td.mark::before { content: "pass mark: "; color: var(--soft); } }
@media print { @page { size: A4; margin: 14mm; } h2 { break-after: avoid; margin-top: 20pt; } tr { break-inside: avoid; } table.scores td:nth-child(2) { max-width: none; }
  table.compared td:nth-child(2), table.compared th:nth-child(2) { display: none; } svg.isometric { max-width: 105mm; } .tiles { grid-template-columns: repeat(4, 1fr); } .tile b { font-size: 15pt; } }
)css";

std::string tile(const PartScore& part, Metric metric) {
  const MetricRow& row = row_of(metric);
  const double value = of(part.values, metric);
  const Trust trust = trust_in(part.quality, metric, value).trust;
  if (trust == Trust::kAbsent) return {};
  const std::string text = trust == Trust::kWithheld ? "withheld" : value_with_unit(row, value);
  return "<div class=\"tile\"><b>" + escaped(text) + (trust == Trust::kFlagged ? " <abbr>!</abbr>" : "") +
         "</b><span>" + std::string(row.title) + "</span></div>\n";
}

std::string date_text(std::int64_t unix_ns) {
  if (unix_ns <= 0) return {};
  const std::chrono::sys_time<std::chrono::nanoseconds> at{std::chrono::nanoseconds{unix_ns}};
  const auto day = std::chrono::floor<std::chrono::days>(at);
  const std::chrono::year_month_day date{day};
  const std::chrono::hh_mm_ss time{std::chrono::floor<std::chrono::minutes>(at - day)};
  return format("%04d-%02u-%02u %02d:%02d UTC", static_cast<int>(date.year()), static_cast<unsigned>(date.month()),
                static_cast<unsigned>(date.day()), static_cast<int>(time.hours().count()),
                static_cast<int>(time.minutes().count()));
}

std::string headline(const SeatScore& seat, const PartScore& whole) {
  const double share = of(whole.values, Metric::kAuthorityShare);
  Trust worst = Trust::kGood;
  for (const Doubt& doubt : whole.quality.doubts) worst = std::max(worst, doubt.trust);
  std::string text = escaped(seat.person.empty() ? seat.name : seat.person) + " (" +
                     std::string(to_text(access_role(seat.role))) + ")";
  if (std::isfinite(share)) text += format(" had %.0f %% of the authority over the tool", 100 * share);
  text += ". ";
  if (worst == Trust::kGood && (!whole.quality.freshness_known || !whole.quality.gate_known))
    return text + "As far as this recording states it, link and data were good.";
  constexpr const char* kWords[] = {"Link and data were good: all scores count.",
                                    "Some scores are flagged (!): the reasons are below the table.",
                                    "Too much data is missing: the scores concerned are withheld."};
  return text + kWords[static_cast<std::size_t>(worst)];
}

std::string introduction(const ScoreResult& result, const LessonScores& lesson, const SeatScore& seat,
                         const std::string& version) {
  const PartScore& whole = seat.parts.front();
  const std::string date = date_text(lesson.start_unix_ns);
  std::string html = "<h1>Lesson: " + escaped(lesson.session) + "</h1>\n<p class=\"headline\">" +
                     headline(seat, whole) + "</p>\n<p class=\"soft\">Recording " + escaped(lesson.file) +
                     (date.empty() ? "" : ", " + date) +
                     format(", %.1f s at %g Hz. Tandem ", lesson.end_s - lesson.begin_s, lesson.rate_hz) +
                     escaped(version) + ".</p>\n<div class=\"tiles\">\n";
  for (const Metric metric : {Metric::kTime, Metric::kPathLength, Metric::kForcePeak, Metric::kSparc})
    html += tile(whole, metric);
  html +=
      "</div>\n<nav><a href=\"#scores\">Scores</a><a href=\"#path\">Path</a><a href=\"#time\">Force and "
      "authority</a><a href=\"#events\">Events</a>";
  if (!result.curves.empty()) html += "<a href=\"#progress\">Progress</a>";
  return html +
         "<a href=\"#link\">Link</a><a href=\"#evaluators\">Evaluators</a><a href=\"#all\">All scores</a></nav>\n";
}

std::string pairs_html(const LessonScores& lesson, const std::string& seat) {
  std::string html;
  for (const NamedPair& pair : lesson.pairs) {
    if (pair.first != seat && pair.second != seat) continue;
    const std::string names = escaped(pair.first) + " and " + escaped(pair.second);
    if (std::isfinite(pair.score.conflict))
      html += "<p>" + names +
              format(": the forces on both hands opposed each other by %.0f %% in %.1f s of common force.",
                     100 * pair.score.conflict, pair.score.both_feel_s) +
              "</p>\n";
    if (std::isfinite(pair.score.both_move_share))
      html += "<p>" + names +
              format(", two hands of one person: both moved in %.0f %% of the time in which one did.",
                     100 * pair.score.both_move_share) +
              "</p>\n";
  }
  return html;
}

std::string definitions_html(const SeatScore& seat) {
  std::string html = "<dl class=\"soft\">\n";
  for (const MetricRow& row : metric_rows())
    if (std::ranges::any_of(seat.parts, [&](const PartScore& p) { return std::isfinite(of(p.values, row.metric)); }))
      html += "<dt>" + std::string(row.title) + "</dt><dd>" + std::string(row.definition) + "</dd>\n";
  return html + "</dl>\n";
}

std::string list_of(const std::vector<std::string>& lines) {
  std::string html = "<ul class=\"soft\">\n";
  for (const std::string& line : lines) html += "<li>" + escaped(line) + "</li>\n";
  return html + "</ul>\n";
}

}  // namespace

std::string score_page(const Lesson& lesson, const ScoreResult& result, const std::string& version) {
  const LessonScores& scores = result.lessons.back();
  std::string html =
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n<meta name=\"viewport\" "
      "content=\"width=device-width, initial-scale=1\">\n<title>Tandem: lesson " +
      escaped(scores.session) + "</title>\n<style>" + std::string(plot::kPlotColours) +
      std::string(demo::kReportStyle) + std::string(plot::kPlotRules) + std::string(kScoreStyle) +
      "</style>\n</head>\n<body>\n";
  const SeatScore* const seat = scores.seat(result.seat);
  if (seat == nullptr || seat->parts.empty())
    return html + "<h1>Lesson: " + escaped(scores.session) + "</h1>\n<p>The recording has no samples of a hand.</p>\n" +
           list_of(scores.notes) + "</body>\n</html>\n";
  const SeatView view(lesson, scores, seat->seat);
  html += "<header>\n" + introduction(result, scores, *seat, version) + "</header>\n<main>\n<h2 id=\"scores\">Scores" +
          (result.thresholds.empty() ? "" : " against " + std::to_string(result.experts) + " expert recordings") +
          "</h2>\n" + main_scores_html(result, *seat) + pairs_html(scores, seat->name);
  html +=
      "<h2 id=\"path\">Path</h2>\n<figure>" +
      isometric_picture(path_pieces(view), "Path of the hand and of the tool in space") +
      "<figcaption>Path of the hand in space, seen from the right front above; its shadow lies on the "
      "floor.</figcaption></figure>\n" +
      demo::to_html({"planes", "Path in three planes", "The same path from three sides.", planes_figure(view)}, "path");
  html += "<h2 id=\"time\">Force and authority</h2>\n" +
          demo::to_html(
              {"time", "Over the session",
               "Contact of the tool is shaded. Red marks below the speed are missing samples.", time_figure(view)},
              "force");
  html += "<h2 id=\"events\">Events</h2>\n" + events_html(lesson, scores);
  if (!result.curves.empty()) {
    html += "<h2 id=\"progress\">Progress</h2>\n" + progress_html(result);
    if (plot::Figure figure = curves_figure(result, kCurvesShown); !figure.panels.empty())
      html += demo::to_html({"curves", "Learning curves", "Value of each session, in time.", std::move(figure)},
                            "progress");
  }
  html += "<h2 id=\"link\">Link and data</h2>\n" + link_html(scores) + list_of(scores.notes) +
          "<h2 id=\"evaluators\">Evaluators</h2>\n" + evaluators_html(result, scores) +
          "<h2 id=\"all\">All scores of " + escaped(seat->name) + "</h2>\n" + all_scores_html(*seat) +
          "<h2 id=\"definitions\">Definitions and conditions</h2>\n" + list_of(conditions_of(scores.options)) +
          definitions_html(*seat);
  return html + "</main>\n</body>\n</html>\n";
}

}  // namespace tandem::netsim::score
