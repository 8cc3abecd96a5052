#include "server/app/recording/replayed_lesson.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>

#include "common/base/format.h"
#include "hal/sim/hand.h"

namespace tandem::server {
namespace {

bool finite(const LessonTriple& x) {
  return std::ranges::all_of(x, [](double v) { return std::isfinite(v); });
}

/// Samples of a seat at the session time at which its client took them; only those behind the one before. The hand that
/// plays them is a spring: its rest position is the recorded tip moved against the force on the hand by F / k, so that
/// it holds the tip where it was recorded.
std::string motion_csv(const Lesson& lesson, std::size_t seat) {
  const LessonSeat& in = lesson.seats[seat];
  const double scale = lesson.scene.seats[seat].motion_scale;
  const double compliance = scale / hal::sim::impedance_of(HandModel::kRecorded).k;
  std::string csv = "t_s[s],px[m],py[m],pz[m]\n";
  std::optional<std::uint32_t> last;
  std::size_t points = 0;
  for (std::size_t k = 0; k < lesson.rows(); ++k) {
    if (!finite(in.x[k]) || !finite(in.f[k]) || (last && in.sample_tick[k] <= *last)) continue;
    last = in.sample_tick[k];
    csv += format("%.6f", in.sample_tick[k] / lesson.scene.tick_hz);
    for (std::size_t a = 0; a < 3; ++a) csv += format(",%.9g", in.x[k][a] / scale - in.f[k][a] * compliance);
    csv += '\n';
    ++points;
  }
  return points < 2 ? std::string() : csv;
}

bool played(const Lesson& lesson, std::size_t seat, const std::vector<std::string>& wanted) {
  if (!wanted.empty()) return std::ranges::find(wanted, lesson.scene.seats[seat].name) != wanted.end();
  return std::ranges::find(lesson.seats[seat].engaged, 1) != lesson.seats[seat].engaged.end();
}

std::string names_of(const SceneSpec& scene) {
  std::string names;
  for (std::size_t i = 0; i < scene.masters(); ++i) names += (names.empty() ? "" : ", ") + scene.seats[i].name;
  return names;
}

}  // namespace

std::expected<ReplayedLesson, std::string> replayed_lesson(const Lesson& lesson, const std::vector<std::string>& seats,
                                                           bool await) {
  ReplayedLesson out{.scene = lesson.scene, .hands = {}, .awaited = {}};
  const std::size_t masters = out.scene.masters();
  if (lesson.rows() == 0) return std::unexpected("has no tick in which the session ran");
  for (const ToolSpec& tool : out.scene.tools)
    if (tool.remote)
      return std::unexpected("tool " + tool.name + " is served by the SLAVE seat " + out.scene.seats[tool.seat].name +
                             ", which a recording cannot play");
  for (const std::string& name : seats)
    if (std::find_if(out.scene.seats.begin(), out.scene.seats.begin() + static_cast<std::ptrdiff_t>(masters),
                     [&](const SeatSpec& seat) { return seat.name == name; }) ==
        out.scene.seats.begin() + static_cast<std::ptrdiff_t>(masters))
      return std::unexpected("has no master seat \"" + name + "\"; master seats: " + names_of(out.scene));
  for (std::size_t i = 0; i < masters; ++i) {
    SeatSpec& seat = out.scene.seats[i];
    if (!played(lesson, i, seats)) {
      seat.required = seat.required && await && !seats.empty();
      if (seat.required) out.awaited.push_back(seat.name);
      continue;
    }
    seat.required = true;
    std::string csv = motion_csv(lesson, i);
    if (csv.empty()) return std::unexpected("seat " + seat.name + " has no motion in this recording");
    out.hands.push_back({seat.name, std::move(csv)});
  }
  if (out.hands.empty()) return std::unexpected("no hand was engaged in this recording; name a seat with --seat");
  out.scene.duration = lesson.tick.back() / out.scene.tick_hz;
  return out;
}

std::string late_begin_text(const Lesson& lesson) {
  constexpr double kNoted = 1;  // [s]
  const double begin_s = lesson.tick.empty() ? 0 : lesson.tick.front() / lesson.scene.tick_hz;
  if (begin_s < kNoted) return {};
  return format(
      "the recording begins at %.1f s of its session, and has nothing before: the recorded hands stand still "
      "for so long, then they move until %.1f s",
      begin_s, lesson.tick.back() / lesson.scene.tick_hz);
}

}  // namespace tandem::server
