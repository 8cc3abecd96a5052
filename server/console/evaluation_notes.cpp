#include "server/console/evaluation_notes.h"

#include <algorithm>
#include <utility>

#include "server/console/json_text.h"

namespace tandem::console {

const EvaluationNotes::Sheet* EvaluationNotes::find(std::uint64_t person, const EvaluationSheet& like) const {
  const auto found = std::ranges::find_if(sheets_, [&](const Sheet& row) {
    return row.by.id == person && row.sheet.form == like.form && row.sheet.of == like.of;
  });
  return found == sheets_.end() ? nullptr : &*found;
}

std::expected<void, std::string> EvaluationNotes::may_write(const Author& by, const EvaluationSheet& sheet) const {
  const Sheet* const own = find(by.id, sheet);
  if (own != nullptr && own->sheet.closed)
    return std::unexpected("your sheet " + sheet.form + " about " + sheet.of + " is closed, which is final");
  if (own == nullptr && sheets_.size() >= kSheetsMax)
    return std::unexpected("this session has " + std::to_string(kSheetsMax) + " sheets already");
  return {};
}

void EvaluationNotes::add(Mark mark) {
  if (marks_.size() >= kMarksMax) marks_.erase(marks_.begin());
  marks_.push_back(std::move(mark));
  ++version_;
}

void EvaluationNotes::put(const Author& by, EvaluationSheet sheet) {
  if (const Sheet* const own = find(by.id, sheet); own != nullptr) {
    sheets_[static_cast<std::size_t>(own - sheets_.data())].sheet = std::move(sheet);
  } else {
    sheets_.push_back({by, std::move(sheet)});
  }
  ++version_;
}

std::string EvaluationNotes::json_for(std::uint64_t person) const {
  using nlohmann::json;
  json marks = json::array(), sheets = json::array();
  for (const Mark& mark : marks_)
    marks.push_back({{"t", mark.t_s ? json(*mark.t_s) : json()}, {"text", mark.text}, {"person", mark.by.name}});
  for (const Sheet& row : sheets_) {
    const Sheet* const own = find(person, row.sheet);
    const bool visible = row.by.id == person || (row.sheet.closed && own != nullptr && own->sheet.closed);
    if (!visible) continue;
    sheets.push_back({{"sheet", row.sheet.form},
                      {"of", row.sheet.of},
                      {"person", row.by.name},
                      {"scores", row.sheet.scores},
                      {"closed", row.sheet.closed}});
  }
  return json_text({{"type", "notes"}, {"marks", std::move(marks)}, {"sheets", std::move(sheets)}});
}

std::string mark_json(const EvaluationNotes::Mark& mark) {
  using nlohmann::json;
  return json_text({{"t", mark.t_s ? json(*mark.t_s) : json()}, {"text", mark.text}, {"person", mark.by.name}});
}

std::string sheet_json(const EvaluationNotes::Author& by, const EvaluationSheet& sheet) {
  return json_text({{"sheet", sheet.form},
                    {"of", sheet.of},
                    {"person", by.name},
                    {"scores", sheet.scores},
                    {"closed", sheet.closed}});
}

}  // namespace tandem::console
