#include "server/console/evaluation_notes.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/sanitize.h"
#include "server/console/json_text.h"

namespace tandem::console {
namespace {

using nlohmann::json;

constexpr std::size_t kShownMax = 1000;  // of a mark's text [bytes]

std::string text_in(const json& note, const char* key) {
  const auto found = note.find(key);
  return found != note.end() && found->is_string() ? sanitize(found->get_ref<const std::string&>(), kShownMax) : "";
}

std::optional<double> time_in(const json& note) {
  const auto found = note.find("t");
  return found != note.end() && found->is_number() ? std::optional(found->get<double>()) : std::nullopt;
}

/// A sheet of this program; nullopt: other JSON.
std::optional<EvaluationSheet> sheet_in(const json& note) {
  EvaluationSheet sheet{.form = text_in(note, "sheet"), .of = text_in(note, "of")};
  const auto scores = note.find("scores"), closed = note.find("closed");
  if (scores == note.end() || !scores->is_object() || closed == note.end() || !closed->is_boolean())
    return std::nullopt;
  sheet.closed = closed->get<bool>();
  for (const auto& [item, points] : scores->items()) {
    if (!points.is_number_integer()) return std::nullopt;
    sheet.scores[item] = points.get<std::int64_t>();
  }
  return check(sheet) ? std::optional(std::move(sheet)) : std::nullopt;
}

/// Adds a row in the order of the numbers; false: it is there already.
template <class Row>
bool insert(std::vector<Row>& rows, Row row, std::size_t most) {
  const auto place = std::ranges::lower_bound(rows, row.number, {}, &Row::number);
  if (place != rows.end() && place->number == row.number) return false;
  rows.insert(place, std::move(row));
  if (rows.size() > most) rows.erase(rows.begin());
  return true;
}

}  // namespace

bool EvaluationNotes::put(const rpc::StoredNote& note) {
  const json parsed = json::parse(note.json, nullptr, false);
  if (!parsed.is_object()) return false;
  Author by{note.person, !note.person.empty()};
  if (!by.proved) by.name = text_in(parsed, "person");
  if (by.name.empty()) by.name = note.workstation;
  if (note.kind == rpc::NoteKind::kMark) {
    // A mark of this program may have no words. One of another program has no text and is shown whole.
    const auto own = parsed.find("text");
    std::string text =
        own != parsed.end() && own->is_string() ? text_in(parsed, "text") : sanitize(note.json, kShownMax);
    insert(marks_, {note.number, std::move(by), time_in(parsed), std::move(text)}, kMarksMax);
    return false;
  }
  auto sheet = sheet_in(parsed);
  if (!sheet) return false;
  const bool closes = note.yours && sheet->closed;
  Sheet row{note.number, std::move(by), note.yours, std::move(*sheet)};
  if (note.yours)
    std::erase_if(sheets_, [&row](const Sheet& old) {
      return old.yours && old.number < row.number && old.sheet.form == row.sheet.form && old.sheet.of == row.sheet.of;
    });
  return insert(sheets_, std::move(row), kSheetsMax) && closes;
}

std::string EvaluationNotes::message() const {
  using Json = nlohmann::json;
  Json marks = Json::array(), sheets = Json::array();
  for (const Mark& mark : marks_)
    marks.push_back({{"t", mark.t_s ? Json(*mark.t_s) : Json()},
                     {"text", mark.text},
                     {"person", mark.by.name},
                     {"proved", mark.by.proved}});
  for (const Sheet& row : sheets_)
    sheets.push_back({{"sheet", row.sheet.form},
                      {"of", row.sheet.of},
                      {"person", row.by.name},
                      {"proved", row.by.proved},
                      {"yours", row.yours},
                      {"scores", row.sheet.scores},
                      {"closed", row.sheet.closed}});
  return json_text({{"type", "notes"}, {"marks", std::move(marks)}, {"sheets", std::move(sheets)}});
}

std::string mark_json(const std::string& person, std::optional<double> t_s, const std::string& text) {
  return json_text({{"t", t_s ? json(*t_s) : json()}, {"text", text}, {"person", person}});
}

std::string sheet_json(const std::string& person, const EvaluationSheet& sheet) {
  return json_text({{"sheet", sheet.form},
                    {"of", sheet.of},
                    {"person", person},
                    {"scores", sheet.scores},
                    {"closed", sheet.closed}});
}

}  // namespace tandem::console
