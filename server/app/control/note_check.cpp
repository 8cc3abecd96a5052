#include "server/app/control/note_check.h"

#include <nlohmann/json.hpp>

#include "common/base/format.h"

namespace tandem::server {

std::string note_problem(std::string_view json) {
  using Json = nlohmann::json;
  bool deep = false;
  const Json::parser_callback_t check = [&](int depth, Json::parse_event_t event, Json&) {
    const bool opens = event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
    deep = deep || (opens && depth >= kNoteDepthMax);
    return !deep;
  };
  const Json parsed = Json::parse(json, check, false);
  if (deep) return format("the note is nested more than %d levels deep", kNoteDepthMax);
  if (!parsed.is_object()) return "the note must be a JSON object, such as {\"text\": \"good grip\"}";
  return {};
}

}  // namespace tandem::server
