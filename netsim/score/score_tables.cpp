#include "netsim/score/score_tables.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>

#include "common/base/format.h"
#include "netsim/plot/svg_plot.h"
#include "proto/spec/access_role.h"

namespace tandem::netsim::score {
namespace {

using plot::escaped;

constexpr std::size_t kEventsMax = 200;
constexpr std::size_t kColumnsMax = 6;  // parts side by side on A4

std::string cell(const std::string& text, const char* kind = "") {
  return "<td" + (*kind == '\0' ? std::string() : " class=\"" + std::string(kind) + "\"") + ">" + text + "</td>";
}

std::string value_html(const PartScore* part, const MetricRow& row) {
  if (part == nullptr) return "–";
  const double value = of(part->values, row.metric);
  const MetricTrust trust = trust_in(part->quality, row.metric, value);
  switch (trust.trust) {
    case Trust::kGood:
      return escaped(value_with_unit(row, value));
    case Trust::kFlagged:
      return escaped(value_with_unit(row, value)) + " <abbr title=\"" + escaped(trust.reason) + "\">!</abbr>";
    case Trust::kWithheld:
      return "<abbr title=\"" + escaped(trust.reason) + "\">withheld</abbr>";
    case Trust::kAbsent:
      break;
  }
  return "–";
}

/// Reasons of flags, each once, with the parts that they concern.
std::string doubts_html(const SeatScore& seat) {
  std::string items;
  for (const PartScore& part : seat.parts)
    for (const Doubt& doubt : part.quality.doubts)
      items += "<li>" + escaped(part.title) + ": " + escaped(doubt.reason) +
               (doubt.trust == Trust::kWithheld ? " – values withheld" : "") + "</li>\n";
  return items.empty() ? std::string() : "<ul class=\"doubts\">\n" + items + "</ul>\n";
}

bool exists(const SeatScore& seat, Metric metric) {
  return std::ranges::any_of(seat.parts, [&](const PartScore& p) { return std::isfinite(of(p.values, metric)); });
}

}  // namespace

std::string standing_text(const Threshold& threshold, Metric metric, double value) {
  const MetricRow& row = row_of(metric);
  const bool low = row.better == Better::kLow;
  if (low ? value <= threshold.median : value >= threshold.median) return "as good as the experts, or better";
  if (passes(threshold, metric, value)) return "within the experts' range";
  const double beyond = std::abs(value - threshold.pass_mark);
  return value_with_unit(row, beyond) + (low ? " more" : " less") + " than the pass mark";
}

std::string main_scores_html(const ScoreResult& result, const SeatScore& seat) {
  const bool compared = !result.thresholds.empty();
  const PartScore* const whole = seat.part("whole");
  const PartScore* const held = seat.part("held:" + seat.name);
  std::string html = "<div class=\"scroll\"><table class=\"scores" + std::string(compared ? " compared" : "") +
                     "\"><thead><tr><th>Score</th><th>Definition</th><th>Whole lesson</th>";
  if (held != nullptr) html += "<th>While " + escaped(seat.name) + " holds the tool</th>";
  if (compared) html += "<th>Experts' median</th><th>Pass mark</th><th class=\"words\">Compared with the experts</th>";
  html += "</tr></thead><tbody>\n";
  for (const Metric metric : main_metrics()) {
    if (!exists(seat, metric)) continue;
    const MetricRow& row = row_of(metric);
    html += "<tr><td>" + std::string(row.title) + "</td>" + cell(escaped(row.definition), "words") +
            cell(value_html(whole, row));
    if (held != nullptr) html += cell(value_html(held, row), "held");
    const Threshold* const threshold = compared ? threshold_of(result.thresholds, "whole", metric) : nullptr;
    if (threshold != nullptr && whole != nullptr) {
      const double value = of(whole->values, metric);
      const Trust trust = trust_in(whole->quality, metric, value).trust;
      const bool shown = trust == Trust::kGood || trust == Trust::kFlagged;
      const bool passed = shown && passes(*threshold, metric, value);
      html += cell(escaped(value_with_unit(row, threshold->median)), "median") +
              cell(escaped(value_with_unit(row, threshold->pass_mark)), "mark") +
              cell(shown ? std::string(passed ? "✓ " : "✗ ") + escaped(standing_text(*threshold, metric, value))
                         : "not compared: the value is " + std::string(to_text(trust)),
                   !shown   ? "words"
                   : passed ? "words met"
                            : "words missed");
    } else if (compared) {
      html += "<td></td><td></td><td></td>";
    }
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n" + doubts_html(seat);
}

std::string all_scores_html(const SeatScore& seat) {
  std::string html;
  for (std::size_t from = 0; from < seat.parts.size(); from += kColumnsMax) {
    const auto parts = std::span(seat.parts).subspan(from, std::min(kColumnsMax, seat.parts.size() - from));
    html += "<div class=\"scroll\"><table class=\"all\"><thead><tr><th>Score</th>";
    for (const PartScore& part : parts) html += "<th>" + escaped(part.title) + "</th>";
    html += "</tr></thead><tbody>\n";
    auto group = MetricGroup::kLink;
    bool first = true;
    for (const MetricRow& row : metric_rows()) {
      if (!exists(seat, row.metric)) continue;
      if (first || row.group != group)
        html += format("<tr class=\"section\"><th colspan=\"%zu\">", parts.size() + 1) +
                std::string(title_of(row.group)) + "</th></tr>\n";
      first = false;
      group = row.group;
      html += "<tr><td>" + std::string(row.title) + "</td>";
      for (const PartScore& part : parts) html += cell(value_html(&part, row));
      html += "</tr>\n";
    }
    html += "</tbody></table></div>\n";
  }
  return html;
}

std::string link_html(const LessonScores& lesson) {
  constexpr std::array kMetrics{Metric::kRoundTrip50, Metric::kRoundTrip95, Metric::kLossUp,   Metric::kLossDown,
                                Metric::kGapUp,       Metric::kGapDown,     Metric::kGateTrips};
  const bool measured = std::ranges::any_of(
      lesson.seats, [&](const SeatScore& s) { return exists(s, Metric::kRoundTrip50) || exists(s, Metric::kGapUp); });
  std::string html =
      "<div class=\"scroll\"><table class=\"links\"><thead><tr><th>Seat</th><th>Data</th><th>Missing "
      "samples</th><th>Longest gap</th>";
  for (const Metric metric : kMetrics)
    if (measured) html += "<th>" + std::string(row_of(metric).title) + "</th>";
  html += "</tr></thead><tbody>\n";
  for (const SeatScore& seat : lesson.seats) {
    const PartScore* const whole = seat.part("whole");
    if (whole == nullptr) continue;
    const Quality& q = whole->quality;
    Trust worst = Trust::kGood;
    for (const Doubt& doubt : q.doubts) worst = std::max(worst, doubt.trust);
    constexpr const char* kWords[] = {"good", "doubtful", "too poor to judge"};
    html += "<tr><td>" + escaped(seat.name) + " (" + std::string(to_text(access_role(seat.role))) + ")</td>" +
            cell(kWords[static_cast<std::size_t>(worst)], worst == Trust::kGood ? "met" : "missed") +
            cell(format("%.3g %%", 100 * q.missing_share)) + cell(format("%.4g ms", 1e3 * q.longest_gap_s));
    for (const Metric metric : kMetrics)
      if (measured) html += cell(escaped(value_with_unit(row_of(metric), of(whole->values, metric))));
    html += "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

std::string events_html(const Lesson& lesson, const LessonScores& scores) {
  struct Row {
    double at;
    std::string text;
  };
  std::vector<Row> rows;
  for (const NamedIntervention& i : scores.interventions)
    rows.push_back(
        {i.from_s,
         i.seat + " takes the tool from " + i.from_seat + format(" for %.1f s; cause: ", i.to_s - i.from_s) + i.cause +
             (std::isfinite(i.opposition) ? format("; force and motion of the other hand: cosine %.2f", i.opposition)
                                          : "")});
  for (const LessonEvent& event : lesson.events)
    rows.push_back(
        {event.tick / lesson.scene.tick_hz, event.what + ": " + (event.text.empty() ? event.seat : event.text)});
  for (const LessonMark& mark : lesson.marks) rows.push_back({mark.t_s, "mark by " + mark.by + ": " + mark.text});
  std::ranges::stable_sort(rows, {}, &Row::at);
  if (rows.empty()) return "<p>No events, marks or interventions are recorded.</p>\n";
  std::string html = "<table class=\"events\"><tbody>\n";
  for (std::size_t i = 0; i < std::min(rows.size(), kEventsMax); ++i)
    html += format("<tr><td>%.2f s</td>", rows[i].at) + cell(escaped(rows[i].text), "words") + "</tr>\n";
  html += "</tbody></table>\n";
  if (rows.size() > kEventsMax)
    html += format("<p class=\"soft\">%zu more are left out.</p>\n", rows.size() - kEventsMax);
  return html;
}

std::string evaluators_html(const ScoreResult& result, const LessonScores& lesson) {
  std::string html;
  for (const LessonMark& mark : lesson.marks)
    html += format("<li>%.1f s, ", mark.t_s) + escaped(mark.by) + ": " + escaped(mark.text) + "</li>\n";
  if (!html.empty()) html = "<h3>Notes</h3>\n<ul>\n" + html + "</ul>\n";
  std::string rows;
  for (const SheetTotal& sheet : result.sheets)
    if (sheet.lesson == lesson.file)
      rows += "<tr><td>" + escaped(sheet.scale) + "</td>" + cell(escaped(sheet.of), "words") +
              cell(escaped(sheet.by), "words") + cell(format("%g of %g", sheet.total, sheet.most)) +
              cell(sheet.complete() ? "all items" : format("%zu of %zu items", sheet.rated, sheet.items)) + "</tr>\n";
  if (!rows.empty())
    html +=
        "<h3>Sheets</h3>\n<table class=\"sheets\"><thead><tr><th>Scale</th><th>Seat</th><th>Evaluator</th><th>Total"
        "</th><th>Rated</th></tr></thead><tbody>\n" +
        rows + "</tbody></table>\n";
  for (const ScaleAgreement& agreement : result.agreements)
    html += "<p>Agreement of the evaluators over all recordings: " + escaped(agreement_text(agreement)) + ".</p>\n";
  return html.empty() ? "<p>No notes or sheets are recorded.</p>\n" : html;
}

std::string progress_html(const ScoreResult& result) {
  if (result.curves.empty()) return {};
  std::string html =
      format(
          "<p>%zu expert recordings; %zu session%s of the learner. A session passes a score at the pass mark: the "
          "experts' median, moved to the worse side by 1.48 median absolute deviations. The cumulative sum rises for "
          "a failed session and falls for a passed one: the learner counts as competent below %.2f, where fewer than "
          "%g %% of the sessions fail.</p>\n",
          result.experts, result.lessons.size(), result.lessons.size() == 1 ? "" : "s", -result.curves.front().sum.low,
          100 * result.cusum.acceptable) +
      "<div class=\"scroll\"><table class=\"progress\"><thead><tr><th>Score</th><th>Passed</th><th>Change per session"
      "</th><th>Cumulative sum</th><th>Verdict</th></tr></thead><tbody>\n";
  for (const LearningCurve& curve : result.curves) {
    if (curve.part != "whole" || std::ranges::find(main_metrics(), curve.metric) == main_metrics().end()) continue;
    const MetricRow& row = row_of(curve.metric);
    std::size_t passed = 0;
    for (const CurvePoint& point : curve.points) passed += point.passed ? 1 : 0;
    html += "<tr><td>" + std::string(row.title) + "</td>" + cell(format("%zu of %zu", passed, curve.sum.sums.size())) +
            cell(escaped(value_with_unit(row, curve.slope))) +
            cell(curve.sum.sums.empty() ? "–" : format("%.2f", curve.sum.sums.back())) +
            cell(std::string(to_text(curve.sum.verdict))) + "</tr>\n";
  }
  return html + "</tbody></table></div>\n";
}

}  // namespace tandem::netsim::score
