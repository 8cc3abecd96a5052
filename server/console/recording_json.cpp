#include "server/console/recording_json.h"

#include <array>
#include <cmath>
#include <nlohmann/json.hpp>
#include <utility>

#include "common/base/hex.h"
#include "server/console/json_text.h"
#include "server/console/recording_states.h"
#include "server/console/state_json.h"

namespace tandem::console {
namespace {

using nlohmann::json;

/// A value with at most this many decimals, so that a curve is short.
json rounded(double value, double scale) {
  return std::isfinite(value) ? json(std::round(value * scale) / scale) : json();
}

constexpr double kThousandths = 1e3, kTenMicrometres = 1e5;

json curves_of(const RecordingOutline& outline) {
  const RecordingCurves& curves = outline.curves();
  const SceneSpec& scene = outline.head().scene;
  const auto column = [&](auto value, double scale) {
    json out = json::array();
    for (std::size_t point = 0; point < curves.size(); ++point) out.push_back(rounded(value(point), scale));
    return out;
  };
  json seats = json::array(), tools = json::array();
  for (std::size_t i = 0; i < scene.seats.size(); ++i)
    seats.push_back({{"force", column([&](std::size_t p) { return curves.seat_force(p, i); }, kThousandths)}});
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    json x = json::array(), alpha = json::array();
    for (std::size_t a = 0; a < 3; ++a)
      x.push_back(column([&](std::size_t p) { return curves.tool_x(p, j, a); }, kTenMicrometres));
    for (std::size_t k = 0; k < scene.masters(); ++k)
      alpha.push_back(column([&](std::size_t p) { return curves.alpha(p, j, k); }, kThousandths));
    tools.push_back({{"force", column([&](std::size_t p) { return curves.tool_force(p, j); }, kThousandths)},
                     {"x", std::move(x)},
                     {"alpha", std::move(alpha)}});
  }
  return {{"step_s", outline.time(curves.step_ticks())}, {"seats", std::move(seats)}, {"tools", std::move(tools)}};
}

/// Name of the person at a seat; empty: none is known.
std::string person_at(const Lesson& head, const std::string& seat) {
  for (std::size_t i = 0; i < head.scene.seats.size() && i < head.seats.size(); ++i)
    if (head.scene.seats[i].name == seat) return head.seats[i].person;
  return {};
}

}  // namespace

std::string list_json(const RecordingList& list) {
  json rows = json::array();
  for (const ListedRecording& r : list.recordings) {
    json row{{"id", r.id}, {"file", r.file}, {"bytes", r.bytes}, {"problem", nullptr}};
    row["files"] = r.files;
    row["parts_problem"] = r.parts_problem.empty() ? json() : json(r.parts_problem);
    if (!r.problem.empty()) {
      row["problem"] = r.problem;
    } else {
      row.update({{"session", r.session},
                  {"scene", r.scene},
                  {"start_s", r.start_s > 0 ? json(r.start_s) : json()},
                  {"duration_s", rounded(r.duration_s, kThousandths)},
                  {"missing_ticks", r.missing_ticks},
                  {"complete", r.complete},
                  {"persons", r.persons}});
    }
    rows.push_back(std::move(row));
  }
  return json_text({{"recordings", std::move(rows)},
                    {"left_out", list.left_out},
                    {"read", list.read},
                    {"to_read", list.to_read},
                    {"unfinished", list.unfinished},
                    {"problem", list.problem.empty() ? json() : json(list.problem)}});
}

std::string progress_json(double share) { return json_text({{"progress", rounded(share, kThousandths)}}); }

std::string problem_json(std::string_view text) { return json_text({{"problem", text}}); }

std::string outline_json(const RecordingOutline& outline, const rpc::Id& id, const RecordingFiles& files) {
  const Lesson& head = outline.head();
  const RecordingPeriods periods(head.scene.tick_hz, outline.first(), outline.last());
  json gaps = json::array(), events = json::array(), marks = json::array();
  for (const RecordingGap& gap : outline.gaps())
    gaps.push_back(json::array({outline.time(gap.from), outline.time(gap.to)}));
  for (const LessonEvent& event : outline.events())
    events.push_back({{"t", outline.time(event.tick)},
                      {"what", event.what},
                      {"seat", event.seat},
                      {"person", event.person.empty() ? person_at(head, event.seat) : event.person},
                      {"text", event.text}});
  for (const LessonMark& mark : outline.marks())
    marks.push_back({{"t", rounded(mark.t_s, kThousandths)}, {"person", mark.by}, {"text", mark.text}});
  return json_text({{"id", to_hex(id)},
                    {"file", files.file},
                    {"files", files.count},
                    {"parts_problem", files.parts_problem.empty() ? json() : json(files.parts_problem)},
                    {"scene", json::parse(scene_json(recording_base(head, id)))},
                    {"start_s", head.start_unix_ns > 0 ? json(1e-9 * static_cast<double>(head.start_unix_ns)) : json()},
                    {"from_s", outline.time(outline.first())},
                    {"to_s", outline.time(outline.last() + std::uint32_t{1})},
                    {"rate_hz", periods.rate()},
                    {"per_piece", periods.per_piece()},
                    {"pieces", periods.pieces()},
                    {"complete", outline.complete()},
                    {"rows", outline.rows()},
                    {"missing_ticks", outline.missing_ticks()},
                    {"gap_count", outline.gap_count()},
                    {"gaps", std::move(gaps)},
                    {"events", std::move(events)},
                    {"marks", std::move(marks)},
                    {"notes_left_out", outline.notes_left_out()},
                    {"curves", curves_of(outline)}});
}

}  // namespace tandem::console
