#include <algorithm>
#include <cmath>

#include "common/base/format.h"
#include "netsim/score/score_output.h"
#include "proto/spec/access_role.h"

namespace tandem::netsim::score {
namespace {

constexpr int kTitleWidth = 38, kCellWidth = 14;

/// Number of characters of UTF-8 text.
int characters(std::string_view text) {
  return static_cast<int>(
      std::ranges::count_if(text, [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::string padded(std::string_view text, int width, bool right) {
  const std::string space(static_cast<std::size_t>(std::max(0, width - characters(text))), ' ');
  return right ? space + std::string(text) : std::string(text) + space;
}

std::string cell_text(const PartScore& part, const MetricRow& row) {
  const double value = of(part.values, row.metric);
  switch (trust_in(part.quality, row.metric, value).trust) {
    case Trust::kGood:
      return value_text(row, value);
    case Trust::kFlagged:
      return value_text(row, value) + "!";
    case Trust::kWithheld:
      return "withheld";
    case Trust::kAbsent:
      break;
  }
  return "–";
}

/// Width of a column with this head, two spaces included.
int width_of(std::string_view head) { return std::max(kCellWidth, characters(head) + 2); }

std::string seat_table(const SeatScore& seat) {
  std::string out = padded("", kTitleWidth, false);
  for (const PartScore& part : seat.parts) out += padded(part.key, width_of(part.key), true);
  out += "\n";
  auto group = MetricGroup::kLink;
  bool first = true;
  for (const MetricRow& row : metric_rows()) {
    const bool exists = std::ranges::any_of(
        seat.parts, [&](const PartScore& part) { return std::isfinite(of(part.values, row.metric)); });
    if (!exists) continue;
    if (first || group != row.group) out += std::string(title_of(row.group)) + "\n";
    first = false;
    group = row.group;
    out += padded("  " + std::string(row.title) + (row.unit.empty() ? "" : " [" + std::string(row.unit) + "]"),
                  kTitleWidth, false);
    for (const PartScore& part : seat.parts) out += padded(" " + cell_text(part, row), width_of(part.key), true);
    out += "\n";
  }
  for (const PartScore& part : seat.parts)
    for (const Doubt& doubt : part.quality.doubts)
      out += "  " + std::string(doubt.trust == Trust::kWithheld ? "withheld" : "!") + " " + part.key + ": " +
             doubt.reason + "\n";
  return out;
}

/// Parts of the main scores: the whole lesson, and the time in which the seat holds the tool.
std::vector<const PartScore*> main_parts(const SeatScore& seat) {
  std::vector<const PartScore*> parts;
  for (const PartScore& part : seat.parts)
    if (part.kind == Part::Kind::kWhole || part.key == "held:" + seat.name) parts.push_back(&part);
  return parts;
}

std::string lesson_text(const LessonScores& lesson, const std::string& only) {
  std::string out = format("%s: session %s, %.1f to %.1f s at %g Hz\n", lesson.file.c_str(), lesson.session.c_str(),
                           lesson.begin_s, lesson.end_s, lesson.rate_hz);
  for (const SeatScore& seat : lesson.seats) {
    if (!only.empty() && seat.name != only) continue;
    out += "\n" + seat.name + (seat.person.empty() ? "" : " (" + seat.person + ")") + ", " +
           std::string(to_text(access_role(seat.role))) + (seat.tool.empty() ? ", no tool" : ", tool " + seat.tool) +
           "\n" + seat_table(seat);
  }
  out += "\n";
  for (const NamedIntervention& i : lesson.interventions)
    out += format("%.2f to %.2f s: %s takes tool %s from %s (%s)%s\n", i.from_s, i.to_s, i.seat.c_str(), i.tool.c_str(),
                  i.from_seat.c_str(), i.cause.c_str(),
                  std::isfinite(i.opposition)
                      ? format(", mean cosine of force and motion of that hand %.2f", i.opposition).c_str()
                      : "");
  for (const NamedPair& pair : lesson.pairs) {
    if (std::isfinite(pair.score.conflict))
      out += format("%s and %s: forces oppose each other by %.3f (0: never, 1: always) in %.1f s of common force\n",
                    pair.first.c_str(), pair.second.c_str(), pair.score.conflict, pair.score.both_feel_s);
    if (std::isfinite(pair.score.both_move_share))
      out += format("%s and %s, two hands of one person: both move in %.0f %% of the time in which one moves%s\n",
                    pair.first.c_str(), pair.second.c_str(), 100 * pair.score.both_move_share,
                    std::isfinite(pair.score.speed_correlation)
                        ? format(", correlation of the speeds %.2f", pair.score.speed_correlation).c_str()
                        : "");
  }
  for (const std::string& note : lesson.notes) out += "note: " + note + "\n";
  return out;
}

std::string curves_text(const ScoreResult& result) {
  std::string out = format("\n%s against %zu expert recordings, and over %zu session%s\n", result.seat.c_str(),
                           result.experts, result.lessons.size(), result.lessons.size() == 1 ? "" : "s");
  const int part_width = width_of("held:" + result.seat);
  out += padded("", kTitleWidth, false) + padded("part", part_width, true) + padded("experts", kCellWidth, true) +
         padded("pass mark", kCellWidth, true) + padded("last session", kCellWidth, true) + padded("passed", 9, true) +
         "  CUSUM\n";
  for (const LearningCurve& curve : result.curves) {
    if (curve.part != "whole" && curve.part != "held:" + result.seat) continue;
    const MetricRow& row = row_of(curve.metric);
    std::size_t passed = 0, counted = 0;
    for (const CurvePoint& point : curve.points) {
      passed += point.passed ? 1 : 0;
      counted += point.counts ? 1 : 0;
    }
    const bool shown = !curve.points.empty() && curve.points.back().counts;
    out += padded("  " + std::string(row.title) + (row.unit.empty() ? "" : " [" + std::string(row.unit) + "]"),
                  kTitleWidth, false) +
           padded(curve.part, part_width, true) + padded(value_text(row, curve.threshold.median), kCellWidth, true) +
           padded(value_text(row, curve.threshold.pass_mark), kCellWidth, true) +
           padded(shown ? value_text(row, curve.points.back().value) : "–", kCellWidth, true) +
           padded(format("%zu of %zu", passed, counted), 9, true) + "  " +
           (curve.sum.sums.empty() ? std::string("–")
                                   : format("%.2f ", curve.sum.sums.back()) + std::string(to_text(curve.sum.verdict))) +
           "\n";
  }
  return out + "  (the other parts: --json)\n";
}

}  // namespace

std::string main_scores_text(const LessonScores& lesson) {
  struct Column {
    std::string head;
    const PartScore* part;
  };
  std::vector<Column> columns;
  for (const SeatScore& seat : lesson.seats)
    for (const PartScore* part : main_parts(seat))
      columns.push_back({part->kind == Part::Kind::kWhole ? seat.name : part->key, part});
  std::string out = padded("  scores", kTitleWidth, false);
  for (const Column& column : columns) out += padded(column.head, width_of(column.head), true);
  out += "\n";
  for (const Metric metric : main_metrics()) {
    const MetricRow& row = row_of(metric);
    if (std::ranges::none_of(columns, [&](const Column& c) { return std::isfinite(of(c.part->values, metric)); }))
      continue;
    out += padded("  " + std::string(row.title) + (row.unit.empty() ? "" : " [" + std::string(row.unit) + "]"),
                  kTitleWidth, false);
    for (const Column& column : columns) out += padded(cell_text(*column.part, row), width_of(column.head), true);
    out += "\n";
  }
  for (const Column& column : columns)
    for (const Doubt& doubt : column.part->quality.doubts)
      out += "  " + std::string(doubt.trust == Trust::kWithheld ? "withheld" : "!") + " " + column.head + ": " +
             doubt.reason + "\n";
  return out;
}

std::string_view to_text(Cusum::Verdict verdict) noexcept {
  constexpr std::string_view kNames[] = {"undecided", "competent", "deficient"};
  return kNames[static_cast<std::size_t>(verdict)];
}

std::string agreement_text(const ScaleAgreement& a) {
  std::string out = a.scale + format(", %zu evaluators, %zu %s: ", a.evaluators.size(), a.targets,
                                     a.scale == "CHECKLIST" ? "items" : "rated seats");
  const auto interval = [](const Correlation& c) {
    return format("%.2f (95 %%: %.2f to %.2f)", c.value, c.low, c.high);
  };
  if (a.totals)
    out += "ICC(2,1) of one evaluator " + interval(a.totals->single) + ", ICC(2,k) of their mean " +
           interval(a.totals->mean);
  if (a.kappa)
    out += format("%s kappa %.2f, equal judgements %.0f %%", a.evaluators.size() == 2 ? "Cohen's" : "Fleiss'",
                  a.kappa->kappa, 100 * a.kappa->agreement);
  return out + a.missing;
}

std::string scores_text(const ScoreResult& result, const std::string& seat) {
  std::string out;
  for (const LessonScores& lesson : result.lessons) out += (out.empty() ? "" : "\n") + lesson_text(lesson, seat);
  if (!result.curves.empty()) out += curves_text(result);
  if (!result.sheets.empty()) out += "\nSheets of evaluators\n";
  for (const SheetTotal& sheet : result.sheets)
    out += format("  %s: %s of %s by %s: %g of %g to %g%s\n", sheet.lesson.c_str(), sheet.scale.c_str(),
                  sheet.of.c_str(), sheet.by.c_str(), sheet.total, sheet.least, sheet.most,
                  sheet.complete() ? "" : format(" (%zu of %zu items rated)", sheet.rated, sheet.items).c_str());
  for (const ScaleAgreement& agreement : result.agreements) out += "  " + agreement_text(agreement) + "\n";
  if (!result.lessons.empty()) {
    out += "\n! flagged. Conditions:\n";
    for (const std::string& line : conditions_of(result.lessons.front().options)) out += "  " + line + "\n";
  }
  for (const std::string& note : result.notes) out += "note: " + note + "\n";
  return out;
}

}  // namespace tandem::netsim::score
