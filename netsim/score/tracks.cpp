#include "netsim/score/tracks.h"

#include <algorithm>
#include <cmath>

#include "netsim/score/filters.h"

namespace tandem::netsim::score {
namespace {

constexpr double kContactBridge = 0.020;  // [s] shorter interruptions of a contact do not count
constexpr double kChangeBridge = 0.100;   // [s] changes of authority with less time between them are one
constexpr double kAlphaStep = 1e-9;       // smaller differences of authority are rounding

void filter_known(std::vector<LessonTriple>& values, const LessonGrid& grid, double cutoff_hz) {
  for (const Stretch& s : grid.runs([&](std::size_t k) { return known(values[k]); }))
    low_pass(std::span(values).subspan(s.begin, s.size()), cutoff_hz, grid.rate());
}

std::vector<double> lengths(const std::vector<LessonTriple>& values) {
  std::vector<double> out(values.size());
  std::ranges::transform(values, out.begin(), [](const LessonTriple& v) { return length(v); });
  return out;
}

/// Returns where the authority of a seat over this tool changes; changes with little time between them are one.
std::vector<Stretch> authority_changes(const Lesson& lesson, const LessonGrid& grid, std::size_t tool) {
  std::vector<std::uint8_t> changes(grid.size());
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    const std::vector<double>& alpha = lesson.seats[i].alpha;
    if (lesson.scene.seats[i].kind != SeatKind::kMaster || first_tool_of(lesson.scene, i) != tool || alpha.empty())
      continue;
    for (const Stretch& s : grid.stretches())
      for (std::size_t k = s.begin + 1; k < s.end; ++k)
        if (std::abs(alpha[grid.row(k)] - alpha[grid.row(k - 1)]) > kAlphaStep) changes[k] = 1;
  }
  std::vector<Stretch> out;
  const auto bridge = static_cast<std::size_t>(kChangeBridge * grid.rate());
  for (const Stretch& s : grid.runs([&](std::size_t k) { return changes[k] != 0; })) {
    if (!out.empty() && s.begin - out.back().end <= bridge) {
      out.back().end = s.end;
    } else {
      out.push_back(s);
    }
  }
  return out;
}

using Quaternion = std::array<double, 4>;

/// Angles between successive orientations, which are filtered before. The chord gives small angles exactly:
/// |a - b| = 2 sin(angle / 4) for unit quaternions of equal sign.
std::vector<double> turns_of(std::vector<Quaternion> q, const LessonGrid& grid, double cutoff_hz) {
  std::vector<double> turns(q.size(), kUnknown);
  const auto is_known = [&](std::size_t k) {
    return std::ranges::all_of(q[k], [](double c) { return std::isfinite(c); });
  };
  for (const Stretch& s : grid.runs(is_known)) {
    for (std::size_t k = s.begin + 1; k < s.end; ++k) {  // q and -q are the same orientation
      double cosine = 0;
      for (std::size_t c = 0; c < 4; ++c) cosine += q[k][c] * q[k - 1][c];
      if (cosine < 0)
        for (double& c : q[k]) c = -c;
    }
    std::vector<double> component(s.size());
    for (std::size_t c = 0; c < 4; ++c) {
      for (std::size_t k = 0; k < s.size(); ++k) component[k] = q[s.begin + k][c];
      low_pass(component, cutoff_hz, grid.rate());
      for (std::size_t k = 0; k < s.size(); ++k) q[s.begin + k][c] = component[k];
    }
    for (std::size_t k = s.begin; k < s.end; ++k) {
      double norm = 0, chord = 0;
      for (const double c : q[k]) norm += c * c;
      for (double& c : q[k]) c /= std::sqrt(norm);
      if (k == s.begin) continue;
      for (std::size_t c = 0; c < 4; ++c) chord += (q[k][c] - q[k - 1][c]) * (q[k][c] - q[k - 1][c]);
      turns[k] = 4 * std::asin(std::min(1.0, std::sqrt(chord) / 2));
    }
  }
  return turns;
}

void find_surface(const EnvironmentSpec& environment, ToolTrack& track) {
  if (environment.wall) {
    track.surface = {environment.wall->axis, environment.wall->at, environment.wall->from_below};
  } else if (environment.tissue) {
    track.surface = {environment.tissue->axis, environment.tissue->at, environment.tissue->from_below};
  }
  track.has_surface = environment.wall.has_value() || environment.tissue.has_value();
}

}  // namespace

std::size_t first_tool_of(const SceneSpec& scene, std::size_t seat) noexcept {
  for (std::size_t t = 0; t < scene.tools.size(); ++t)
    if (scene.follow[seat][t] > 0) return t;
  return 0;
}

SeatTrack seat_track(const Lesson& lesson, const LessonGrid& grid, std::size_t seat, const ScoreOptions& options) {
  static const LessonSeat kFree;
  const LessonSeat& recorded = has_samples(lesson.seats[seat]) ? lesson.seats[seat] : kFree;
  SeatTrack track;
  track.seat = seat;
  track.tool = first_tool_of(lesson.scene, seat);
  track.x_raw = grid.values(recorded.x);
  track.x = track.x_raw;
  filter_known(track.x, grid, options.position_cutoff_hz);
  track.v.assign(grid.size(), kUnknownTriple);
  for (const Stretch& s : grid.runs([&](std::size_t k) { return known(track.x[k]); })) {
    const auto v = derivative(std::span<const LessonTriple>(track.x).subspan(s.begin, s.size()), grid.rate());
    std::ranges::copy(v, track.v.begin() + static_cast<std::ptrdiff_t>(s.begin));
  }
  track.speed = lengths(track.v);
  track.f_raw = grid.values(recorded.f);
  track.f = track.f_raw;
  filter_known(track.f, grid, options.force_cutoff_hz);
  track.force = lengths(track.f);
  track.alpha = grid.values(recorded.alpha);
  if (!recorded.q.empty()) track.q = grid.held(recorded.q, AxisArray{});
  if (!recorded.orientation.empty())
    track.turn = turns_of(grid.held(recorded.orientation, Quaternion{}), grid, options.position_cutoff_hz);
  return track;
}

ToolTrack tool_track(const Lesson& lesson, const LessonGrid& grid, std::size_t tool, const ScoreOptions& options) {
  const LessonTool& recorded = lesson.tools[tool];
  const ToolSpec& spec = lesson.scene.tools[tool];
  ToolTrack track;
  track.x = grid.values(recorded.x);
  track.f_env = grid.values(recorded.f_env);
  track.force = lengths(track.f_env);
  track.penetration = grid.values(recorded.penetration);
  track.contact.assign(grid.size(), 0);
  for (std::size_t k = 0; k < grid.size(); ++k) track.contact[k] = track.force[k] > options.force_contact ? 1 : 0;
  const auto bridge = static_cast<std::size_t>(kContactBridge * grid.rate());
  for (const Stretch& s : grid.stretches()) {
    std::size_t last = s.end;
    for (std::size_t k = s.begin; k < s.end; ++k) {
      if (track.contact[k] == 0) continue;
      if (last != s.end && k - last <= bridge)
        std::fill(track.contact.begin() + static_cast<std::ptrdiff_t>(last),
                  track.contact.begin() + static_cast<std::ptrdiff_t>(k), std::uint8_t{1});
      last = k;
    }
  }
  if (!spec.is_virtual && !recorded.q.empty()) track.q = grid.held(recorded.q, AxisArray{});
  track.changes = authority_changes(lesson, grid, tool);
  find_surface(spec.remote && spec.seat < lesson.scene.seats.size() ? lesson.scene.seats[spec.seat].environment
                                                                    : spec.environment,
               track);
  return track;
}

}  // namespace tandem::netsim::score
