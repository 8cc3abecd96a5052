#include "netsim/score/lesson_grid.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim::score {
namespace {

bool is_known(double value) { return std::isfinite(value); }
bool is_known(const LessonTriple& value) { return known(value); }
/// From this size on, no gap is filled: a file with many gaps takes bounded memory.
constexpr std::size_t kElementsMax = std::size_t{1} << 26;

/// Fills runs of unknown values that are not longer than `longest` and have known neighbours in their stretch.
template <class Value>
void fill_unknown(std::vector<Value>& values, std::span<const Stretch> stretches, std::size_t longest) {
  for (const Stretch& s : stretches) {
    std::size_t last = s.end;  // last known element; s.end: none yet
    for (std::size_t k = s.begin; k < s.end; ++k) {
      if (!is_known(values[k])) continue;
      if (last != s.end && k - last > 1 && k - last <= longest)
        for (std::size_t g = last + 1; g < k; ++g)
          values[g] =
              interpolated(values[last], values[k], static_cast<double>(g - last) / static_cast<double>(k - last));
      last = k;
    }
  }
}

}  // namespace

std::string lesson_problem(const Lesson& lesson) {
  const std::size_t n = lesson.rows();
  if (n == 0) return "the lesson has no rows";
  if (lesson.seats.size() != lesson.scene.seats.size() || lesson.tools.size() != lesson.scene.tools.size())
    return "the lesson's seats or tools are not those of its scene";
  if (lesson.scene.masters() == 0) return "the lesson has no MASTER seat";
  if (!(lesson.scene.tick_hz > 0) || !std::isfinite(lesson.scene.tick_hz)) return "the scene has no tick rate";
  for (std::size_t k = 1; k < n; ++k)
    if (lesson.tick[k] <= lesson.tick[k - 1])
      return "tick " + std::to_string(lesson.tick[k]) + " of row " + std::to_string(k + 1) +
             " is not above the one before";
  bool fits = true;
  const auto check = [&](const auto&... columns) { ((fits = fits && (columns.empty() || columns.size() == n)), ...); };
  check(lesson.time_ns, lesson.running, lesson.stopped_ticks, lesson.dropped_ticks);
  for (const LessonSeat& s : lesson.seats)
    check(s.fresh, s.sample_tick, s.q, s.x, s.v, s.orientation, s.f, s.f_cmd, s.alpha, s.engaged, s.gate, s.leader,
          s.ghost, s.e_in, s.e_out, s.dissipated_j, s.refused_j, s.margin_min_j, s.delivered_j);
  for (const LessonTool& t : lesson.tools)
    check(t.q, t.x, t.x_tool, t.f_cmd, t.f_env, t.penetration, t.held, t.alpha, t.mfs_j, t.e_p_j, t.e_p_axis_j,
          t.sample_tick);
  return fits ? "" : "a column of the lesson has another number of rows";
}

namespace {

/// Whether the hands moved between two rows while session time stood still: a stop, or ticks that the server dropped.
bool time_stood_still(const Lesson& lesson, std::size_t before, std::size_t after) {
  const auto changed = [&](const std::vector<std::uint64_t>& counts) {
    return !counts.empty() && counts[before] != counts[after];
  };
  return changed(lesson.stopped_ticks) || changed(lesson.dropped_ticks);
}

}  // namespace

LessonGrid::LessonGrid(const Lesson& lesson, double bridge_s)
    : rate_(lesson.scene.tick_hz),
      bridge_(std::max<std::size_t>(1, static_cast<std::size_t>(std::floor(bridge_s * rate_ + 1e-9)))) {
  const std::size_t n = lesson.rows();
  tick_.reserve(n);
  row_.reserve(n);
  weight_.reserve(n);
  bool begins = true;  // a new stretch
  for (std::size_t r = 0; r < n; ++r) {
    if (!lesson.running.empty() && lesson.running[r] == 0) {
      begins = true;
      continue;
    }
    const std::uint32_t t = lesson.tick[r];
    if (!begins && t - tick_.back() > (tick_.size() < kElementsMax ? bridge_ : 1)) begins = true;
    if (!begins && time_stood_still(lesson, r - 1, r)) begins = true;
    if (begins) {
      stretches_.push_back({tick_.size(), tick_.size()});
    } else {
      const std::uint32_t from = tick_.back(), span = t - from;
      for (std::uint32_t g = 1; g < span; ++g) {
        tick_.push_back(from + g);
        row_.push_back(r - 1);
        weight_.push_back(static_cast<float>(g) / static_cast<float>(span));
      }
    }
    begins = false;
    tick_.push_back(t);
    row_.push_back(r);
    weight_.push_back(0);
    stretches_.back().end = tick_.size();
  }
}

std::vector<LessonTriple> LessonGrid::values(const std::vector<LessonTriple>& column) const {
  std::vector<LessonTriple> out(size(), kUnknownTriple);
  if (column.empty()) return out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = weight_[k] == 0 ? column[row_[k]]
                             : interpolated(column[row_[k]], column[row_[k] + 1], static_cast<double>(weight_[k]));
  fill_unknown(out, stretches_, bridge_);
  return out;
}

std::vector<double> LessonGrid::values(const std::vector<double>& column) const {
  std::vector<double> out(size(), kUnknown);
  if (column.empty()) return out;
  for (std::size_t k = 0; k < out.size(); ++k)
    out[k] = weight_[k] == 0 ? column[row_[k]]
                             : interpolated(column[row_[k]], column[row_[k] + 1], static_cast<double>(weight_[k]));
  fill_unknown(out, stretches_, bridge_);
  return out;
}

std::vector<Stretch> LessonGrid::runs(const std::function<bool(std::size_t)>& use) const {
  std::vector<Stretch> out;
  for (const Stretch& s : stretches_) {
    bool open = false;
    for (std::size_t k = s.begin; k < s.end; ++k) {
      const bool used = use(k);
      if (used && !open) out.push_back({k, k});
      if (used) out.back().end = k + 1;
      open = used;
    }
  }
  return out;
}

}  // namespace tandem::netsim::score
