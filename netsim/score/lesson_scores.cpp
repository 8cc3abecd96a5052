#include "netsim/score/lesson_scores.h"

#include <algorithm>
#include <map>

#include "common/base/format.h"
#include "netsim/score/part_scores.h"

namespace tandem::netsim::score {
namespace {

PartScore score_part(const PartInput& in) {
  PartScore out{in.part.kind, in.part.key, in.part.title, {}, {}};
  out.values.fill(kUnknown);
  score_motion(in, out.values);
  score_force(in, out.values);
  score_contact(in, out.values);
  score_tracking(in, out.values);
  score_sharing(in, out.values);
  score_passivity(in, out.values);
  score_link(in, out.values);
  out.quality = quality_of(in, of(out.values, Metric::kGateTrips));
  return out;
}

/// All tools with their parts, tracks and interventions.
struct ToolData {
  ToolTrack track;
  std::vector<Part> parts;
  std::vector<Intervention> interventions;
};

std::vector<std::string> notes_of(const Lesson& lesson) {
  std::vector<std::string> notes;
  const auto lacks = [&](auto has) {
    return std::ranges::none_of(lesson.seats, [&](const LessonSeat& s) { return has(s); });
  };
  if (lacks([](const LessonSeat& s) { return !s.fresh.empty(); }))
    notes.emplace_back("The file does not state which samples are new: only missing rows count as gaps.");
  if (lacks([](const LessonSeat& s) { return !s.gate.empty(); }) && lesson.links.empty())
    notes.emplace_back("The file does not state whether the force gates tripped.");
  if (lacks([](const LessonSeat& s) { return !s.margin_min_j.empty(); }))
    notes.emplace_back("The file has no energy accounts: passivity is not judged.");
  if (lesson.links.empty()) notes.emplace_back("The file has no measures of the links.");
  if (!lesson.complete)
    notes.emplace_back("The file was cut, damaged or repaired, so that a part of the session may be missing.");
  return notes;
}

bool are_one_person(const Lesson& lesson, std::size_t a, std::size_t b,
                    const std::vector<std::pair<std::string, std::string>>& one_person) {
  const std::string &first = lesson.scene.seats[a].name, &second = lesson.scene.seats[b].name;
  const bool named = std::ranges::any_of(one_person, [&](const auto& pair) {
    return (pair.first == first && pair.second == second) || (pair.first == second && pair.second == first);
  });
  const LessonSeat &left = lesson.seats[a], &right = lesson.seats[b];
  // Two clients of one computer, or of all computers of a trial on loopback, have the name of one workstation.
  const bool persons = !left.person.empty() && !left.workstation && !right.workstation;
  return named || (persons && left.person == right.person);
}

}  // namespace

const PartScore* SeatScore::part(std::string_view key) const noexcept {
  const auto found = std::ranges::find(parts, key, &PartScore::key);
  return found == parts.end() ? nullptr : &*found;
}

const SeatScore* LessonScores::seat(std::string_view name) const noexcept {
  const auto found = std::ranges::find(seats, name, &SeatScore::name);
  return found == seats.end() ? nullptr : &*found;
}

std::expected<LessonScores, std::string> score_lesson(
    const Lesson& lesson, const ScoreOptions& options,
    const std::vector<std::pair<std::string, std::string>>& one_person) {
  if (std::string problem = lesson_problem(lesson); !problem.empty()) return std::unexpected(std::move(problem));
  const LessonGrid grid(lesson, options.gap_flagged_s);
  if (grid.size() == 0)
    return std::unexpected("the session clock never ran in this lesson, so there is nothing to score");

  const std::size_t masters = lesson.scene.masters();
  std::vector<SeatTrack> seats;
  for (std::size_t i = 0; i < masters; ++i) seats.push_back(seat_track(lesson, grid, i, options));
  std::map<std::size_t, ToolData> tools;
  for (const SeatTrack& seat : seats) {
    if (tools.contains(seat.tool)) continue;
    tools.emplace(seat.tool,
                  ToolData{tool_track(lesson, grid, seat.tool, options), parts_of(lesson, grid, seat.tool, options),
                           interventions_at(lesson, grid, seats, seat.tool, options)});
  }

  LessonScores out;
  out.session = lesson.session.empty() ? lesson.scene.name : lesson.session;
  out.begin_s = grid.time(0);
  out.end_s = grid.time(grid.size() - 1) + grid.dt();
  out.rate_hz = grid.rate();
  out.start_unix_ns = lesson.start_unix_ns;
  out.complete = lesson.complete;
  out.options = options;
  out.sheets = lesson.sheets;
  out.marks = lesson.marks;
  out.notes = notes_of(lesson);
  for (const SeatTrack& track : seats) {
    const SeatSpec& spec = lesson.scene.seats[track.seat];
    if (std::ranges::none_of(track.x, known)) {
      out.notes.push_back("Seat " + spec.name + " has no samples.");
      continue;
    }
    const ToolData& tool = tools.at(track.tool);
    const bool has_tool = !lesson.tools[track.tool].x.empty() || !lesson.tools[track.tool].x_tool.empty();
    SeatScore seat{track.seat,
                   spec.name,
                   lesson.seats[track.seat].person,
                   spec.role,
                   has_tool ? lesson.scene.tools[track.tool].name : std::string(),
                   {}};
    for (const Part& part : tool.parts)
      seat.parts.push_back(score_part({lesson, grid, track, tool.track, part, options, tool.interventions}));
    out.seats.push_back(std::move(seat));
  }
  for (const auto& [index, tool] : tools)
    for (const Intervention& i : tool.interventions)
      out.interventions.push_back({lesson.scene.seats[i.seat].name, lesson.scene.seats[i.from_seat].name,
                                   lesson.scene.tools[index].name, i.from_s, i.to_s, i.cause, i.opposition});
  for (std::size_t a = 0; a < masters; ++a)
    for (std::size_t b = a + 1; b < masters; ++b) {
      const bool one = are_one_person(lesson, a, b, one_person);
      if (one || seats[a].tool == seats[b].tool)
        out.pairs.push_back({lesson.scene.seats[a].name, lesson.scene.seats[b].name,
                             pair_score(grid, seats[a], seats[b], one, options)});
    }
  return out;
}

std::vector<std::string> conditions_of(const ScoreOptions& o) {
  return {
      format(
          "Positions and forces: low-pass of effective order 4 without phase (Butterworth of order 2, run forward and "
          "backward), cut-off (-3 dB after both runs) %g Hz for positions and %g Hz for forces. Tracking, force "
          "reflection and jumps: as recorded.",
          o.position_cutoff_hz, o.force_cutoff_hz),
      format(
          "Velocity: central difference of the filtered position. Jerk: third central difference. Spectra: averaged to "
          "at most %g Hz. Smoothness: mean of the pieces of at least %g s, weighted with their duration.",
          o.spectrum_rate_hz, o.segment_min_s),
      format("Idle below %g mm/s. Contact above %g N. Excess force above %g N. A seat holds a tool from authority %g.",
             1e3 * o.speed_min, o.force_contact, o.force_limit, o.authority),
      format("Gaps up to %g ms are interpolated. Flagged: more than %g %% of the samples missing, a gap above %g ms, a "
             "gate "
             "trip, force above the limit of the seat, an overdrawn energy account. Withheld: more than %g %% missing "
             "or a "
             "gap above %g ms.",
             1e3 * o.gap_flagged_s, 100 * o.missing_flagged, 1e3 * o.gap_flagged_s, 100 * o.missing_withheld,
             1e3 * o.gap_withheld_s)};
}

}  // namespace tandem::netsim::score
