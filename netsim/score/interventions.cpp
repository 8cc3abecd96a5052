#include "netsim/score/interventions.h"

#include <algorithm>
#include <cmath>
#include <optional>

#include "netsim/score/parts.h"

namespace tandem::netsim::score {
namespace {

constexpr double kCauseBefore = 1.5, kCauseAfter = 0.1;  // [s] an event in this range is the cause
constexpr double kRampedAuthority = 1.5;                 // [s] from an entry of the timeline to the threshold

std::string cause_of(const Lesson& lesson, double at) {
  const LessonEvent* nearest = nullptr;
  for (const LessonEvent& event : lesson.events) {
    const double t = event.tick / lesson.scene.tick_hz;
    if (event.what == "authority" && t >= at - kCauseBefore && t <= at + kCauseAfter) nearest = &event;
  }
  if (nearest != nullptr) return nearest->text.empty() ? nearest->what : nearest->text;
  for (const TimedAuthority& change : lesson.scene.timeline)
    if (change.at <= at && change.at >= at - kRampedAuthority) return "timeline of the scene";
  return "not recorded";
}

double opposition_of(const SeatTrack& other, std::size_t begin, std::size_t end, const ScoreOptions& options) {
  double sum = 0, count = 0;
  for (std::size_t k = begin; k < end; ++k) {
    if (!(other.force[k] > options.force_contact) || !(other.speed[k] > options.speed_min)) continue;
    sum += dot(other.f[k], other.v[k]) / (other.force[k] * other.speed[k]);
    count += 1;
  }
  return count > 0 ? sum / count : kUnknown;
}

}  // namespace

std::vector<Intervention> interventions_at(const Lesson& lesson, const LessonGrid& grid,
                                           const std::vector<SeatTrack>& seats, std::size_t tool,
                                           const ScoreOptions& options) {
  std::vector<Intervention> out;
  std::optional<std::size_t> holder;  // the last seat that held the tool
  bool open = false;                  // out.back() goes on
  const auto close = [&](std::size_t k) {
    out.back().end = k;
    out.back().to_s = grid.time(k - 1) + grid.dt();
    out.back().opposition = opposition_of(seats[out.back().from_seat], out.back().begin, k, options);
    open = false;
  };
  for (const Stretch& stretch : grid.stretches()) {
    for (std::size_t k = stretch.begin; k < stretch.end; ++k) {
      std::optional<std::size_t> now;
      double most = options.authority - 1e-9;
      for (std::size_t i = 0; i < lesson.scene.masters(); ++i) {
        const double alpha = authority_of(lesson, i, tool, grid.row(k));
        if (!(alpha >= most) || (alpha == most && now)) continue;
        now = i;
        most = alpha;
      }
      if (open && now != out.back().seat) close(k);
      if (!now) continue;
      const bool taken = holder && *holder != *now && lesson.scene.seats[*now].role == Role::kInstructor &&
                         lesson.scene.seats[*holder].role != Role::kInstructor;
      if (taken) {
        out.push_back({*now, *holder, k, k, grid.time(k), grid.time(k), cause_of(lesson, grid.time(k)), kUnknown});
        open = true;
      }
      holder = now;
    }
    if (open) close(stretch.end);
  }
  return out;
}

PairScore pair_score(const LessonGrid& grid, const SeatTrack& first, const SeatTrack& second, bool one_person,
                     const ScoreOptions& options) {
  PairScore out{first.seat, second.seat, kUnknown, 0, one_person, kUnknown, kUnknown};
  double opposed = 0, feel = 0, both = 0, any = 0, n = 0, s1 = 0, s2 = 0, s11 = 0, s22 = 0, s12 = 0;
  for (std::size_t k = 0; k < grid.size(); ++k) {
    if (first.force[k] > options.force_contact && second.force[k] > options.force_contact) {
      feel += 1;
      opposed += std::max(0.0, -dot(first.f[k], second.f[k]) / (first.force[k] * second.force[k]));
    }
    const double a = first.speed[k], b = second.speed[k];
    if (!std::isfinite(a) || !std::isfinite(b)) continue;
    const bool moves = a >= options.speed_min, other = b >= options.speed_min;
    both += moves && other ? 1 : 0;
    any += moves || other ? 1 : 0;
    n += 1;
    s1 += a, s2 += b, s11 += a * a, s22 += b * b, s12 += a * b;
  }
  out.both_feel_s = feel / grid.rate();
  if (feel > 0) out.conflict = opposed / feel;
  if (!one_person) return out;
  if (any > 0) out.both_move_share = both / any;
  const double v1 = s11 - s1 * s1 / n, v2 = s22 - s2 * s2 / n;
  if (v1 > 0 && v2 > 0) out.speed_correlation = (s12 - s1 * s2 / n) / std::sqrt(v1 * v2);
  return out;
}

}  // namespace tandem::netsim::score
