#include "netsim/score/rating_sheets.h"

#include <algorithm>
#include <map>
#include <set>

#include "server/console/evaluation_sheets.h"

namespace tandem::netsim::score {
namespace {

constexpr std::string_view kChecklist = "CHECKLIST";

/// The sheets that count, of one lesson: the last one of each evaluator, seat and scale.
std::vector<const LessonSheet*> counting_sheets(const LessonScores& lesson) {
  std::vector<const LessonSheet*> out;
  for (const LessonSheet& sheet : lesson.sheets) {
    const auto same = std::ranges::find_if(out, [&](const LessonSheet* other) {
      return other->sheet == sheet.sheet && other->of == sheet.of && other->by == sheet.by;
    });
    if (same != out.end()) {
      *same = &sheet;
    } else {
      out.push_back(&sheet);
    }
  }
  return out;
}

SheetTotal total_of(const LessonScores& lesson, const LessonSheet& sheet, const console::SheetForm& form) {
  SheetTotal out;
  out.lesson = lesson.file;
  out.scale = sheet.sheet;
  out.of = sheet.of;
  out.by = sheet.by;
  out.closed = sheet.closed;
  out.items = form.items.size();
  out.least = static_cast<double>(form.least) * static_cast<double>(out.items);
  out.most = static_cast<double>(form.most) * static_cast<double>(out.items);
  for (const char* item : form.items) {
    const auto found = sheet.scores.find(item);
    // Points outside the scale are not points.
    if (found == sheet.scores.end() || found->second < form.least || found->second > form.most) continue;
    out.total += found->second;
    ++out.rated;
  }
  return out;
}

/// Sheets of one scale by target and evaluator.
struct Ratings {
  std::map<std::pair<std::size_t, std::string>, std::map<std::string, const LessonSheet*>> by_target;
  std::set<std::string> evaluators;
};

ScaleAgreement agreement_of(const std::string& scale, const Ratings& ratings) {
  const console::SheetForm& form = *console::sheet_form(scale);
  ScaleAgreement out{scale, {ratings.evaluators.begin(), ratings.evaluators.end()}, 0, {}, {}, {}};
  const bool checklist = scale == kChecklist;
  std::vector<std::vector<double>> totals, counts, table(2, std::vector<double>(2));
  for (const auto& [target, sheets] : ratings.by_target) {
    if (sheets.size() != out.evaluators.size()) continue;
    std::vector<double> row;
    for (const auto& [by, sheet] : sheets) row.push_back(total_of({}, *sheet, form).total);
    totals.push_back(std::move(row));
    for (const char* item : form.items) {
      if (!checklist) break;
      std::vector<double> count(2);
      std::vector<std::size_t> chosen;
      for (const auto& [by, sheet] : sheets) {
        chosen.push_back(sheet->scores.at(item) != 0 ? 1 : 0);
        count[chosen.back()] += 1;
      }
      counts.push_back(std::move(count));
      table[chosen[0]][chosen[1]] += 1;
    }
  }
  out.targets = checklist ? counts.size() : totals.size();
  const auto keep = [&](auto result, auto& place) {
    if (result) {
      place = *result;
    } else {
      out.missing = result.error();
    }
  };
  if (!checklist) {
    keep(intraclass_correlation(totals), out.totals);
  } else if (out.evaluators.size() == 2) {
    keep(cohen_kappa(table), out.kappa);
  } else {
    keep(fleiss_kappa(counts), out.kappa);
  }
  return out;
}

}  // namespace

std::vector<SheetTotal> sheet_totals(std::span<const LessonScores> lessons, std::vector<std::string>& notes) {
  std::vector<SheetTotal> out;
  for (const LessonScores& lesson : lessons)
    for (const LessonSheet* sheet : counting_sheets(lesson)) {
      if (const console::SheetForm* form = console::sheet_form(sheet->sheet)) {
        out.push_back(total_of(lesson, *sheet, *form));
      } else {
        notes.push_back(lesson.file + ": a sheet of unknown scale \"" + sheet->sheet + "\" is left out");
      }
    }
  return out;
}

std::vector<ScaleAgreement> scale_agreements(std::span<const LessonScores> lessons) {
  std::map<std::string, Ratings> scales;
  for (std::size_t i = 0; i < lessons.size(); ++i)
    for (const LessonSheet* sheet : counting_sheets(lessons[i])) {
      const console::SheetForm* const form = console::sheet_form(sheet->sheet);
      if (form == nullptr || !total_of(lessons[i], *sheet, *form).complete()) continue;
      Ratings& ratings = scales[sheet->sheet];
      ratings.evaluators.insert(sheet->by);
      ratings.by_target[{i, sheet->of}][sheet->by] = sheet;
    }
  std::vector<ScaleAgreement> out;
  for (const auto& [scale, ratings] : scales)
    if (ratings.evaluators.size() >= 2) out.push_back(agreement_of(scale, ratings));
  return out;
}

}  // namespace tandem::netsim::score
