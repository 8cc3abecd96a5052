#include "server/export/lerobot_layout.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "common/base/format.h"

namespace tandem::server {

namespace {

constexpr double kMajority = 0.5;

void name_triple(std::vector<std::string>& to, const std::string& stem, const char* unit) {
  for (const char* axis : {"x", "y", "z"}) to.push_back(stem + "." + axis + "[" + unit + "]");
}

double* put_triple(double* to, const LessonTriple& from) { return std::ranges::copy(from, to).out; }

/// The numbers of `observation.state` at one row.
double* put_state(const Lesson& lesson, std::size_t masters, std::size_t row, double* to) {
  for (const LessonTool& tool : lesson.tools) to = put_triple(to, tool.x[row]);
  for (std::size_t i = 0; i < masters; ++i) {
    to = put_triple(to, lesson.seats[i].x[row]);
    to = put_triple(to, lesson.seats[i].v[row]);
  }
  return to;
}

double* put_force(const Lesson& lesson, std::size_t masters, std::size_t row, double* to) {
  for (std::size_t i = 0; i < masters; ++i) to = put_triple(to, lesson.seats[i].f[row]);
  for (const LessonTool& tool : lesson.tools) to = put_triple(to, tool.f_env[row]);
  return to;
}

double* put_action(const Lesson& lesson, std::size_t row, double* to) {
  for (const LessonTool& tool : lesson.tools) {
    to = put_triple(to, tool.x_tool[row]);
    to = put_triple(to, tool.f_cmd[row]);
  }
  return to;
}

}  // namespace

const char* to_text(LerobotType type) noexcept {
  return type == LerobotType::kFloat32 ? "float32" : type == LerobotType::kInt64 ? "int64" : "bool";
}

std::expected<LerobotLayout, std::string> LerobotLayout::make(const SceneSpec& scene, unsigned fps) {
  const double window = fps == 0 ? 0 : scene.tick_hz / fps;
  if (!(window >= 1) || window != std::floor(window))
    return std::unexpected(
        format("%u frames per second do not divide the rate of the scene, %g ticks per second", fps, scene.tick_hz));
  LerobotLayout layout;
  layout.fps_ = fps;
  layout.window_ = static_cast<std::size_t>(window);
  layout.masters_ = scene.masters();
  std::vector<std::string> state, force, alpha, action;
  for (const ToolSpec& tool : scene.tools) name_triple(state, tool.name + ".measured_cp", "m");
  for (std::size_t i = 0; i < layout.masters_; ++i) {
    const SeatSpec& seat = scene.seats[i];
    name_triple(state, seat.name + ".measured_cp", "m");
    name_triple(state, seat.name + ".measured_cv", "m/s");
    name_triple(force, seat.name + ".measured_cf", "N");
    alpha.push_back(seat.name + ".alpha[1]");
    layout.instructors_.push_back(seat.role == Role::kInstructor);
  }
  for (const ToolSpec& tool : scene.tools) {
    name_triple(force, tool.name + ".environment_cf", "N");
    name_triple(action, tool.name + ".setpoint_cp", "m");
    name_triple(action, tool.name + ".servo_cf", "N");
  }
  std::vector<std::string> both = state;
  both.insert(both.end(), force.begin(), force.end());
  const std::size_t w = layout.window_, all = both.size(), actions = action.size();
  layout.add("observation.state", LerobotType::kFloat32, {state.size()}, state);
  layout.add("observation.force", LerobotType::kFloat32, {force.size()}, force);
  layout.add("observation.alpha", LerobotType::kFloat32, {alpha.size()}, alpha);
  layout.add("observation.intervention", LerobotType::kBool, {1});
  layout.add("observation.gap", LerobotType::kBool, {1});
  layout.add("observation.missing_ticks", LerobotType::kInt64, {1});
  layout.add("observation.window", LerobotType::kFloat32, {w, all}, both);
  layout.add("action", LerobotType::kFloat32, {actions}, action);
  layout.add("action.window", LerobotType::kFloat32, {w, actions}, action);
  layout.add("timestamp", LerobotType::kFloat32, {1});
  for (const char* name : {"frame_index", "episode_index", "index", "task_index"})
    layout.add(name, LerobotType::kInt64, {1});
  return layout;
}

void LerobotLayout::add(const char* name, LerobotType type, std::vector<std::size_t> shape,
                        std::vector<std::string> columns) {
  features_.push_back({name, type, std::move(shape), std::move(columns)});
}

std::size_t LerobotLayout::frames(const LessonExtent& lesson) const noexcept {
  const std::uint64_t ticks = std::uint64_t{lesson.last_tick} - lesson.first_tick + 1;
  return static_cast<std::size_t>(ticks / window_);
}

LerobotLayout::Rows LerobotLayout::rows_of(const Lesson& lesson, const LerobotPlace& place) const {
  const auto offset = static_cast<std::uint32_t>(static_cast<std::size_t>(place.frame) * window_);
  const std::uint32_t first = place.first_tick + offset;
  const auto begin = std::ranges::lower_bound(lesson.tick, first);
  const auto end = std::lower_bound(begin, lesson.tick.end(), std::uint64_t{first} + window_);
  Rows rows;
  rows.begin = static_cast<std::size_t>(begin - lesson.tick.begin());
  rows.end = static_cast<std::size_t>(end - lesson.tick.begin());
  rows.last = rows.end - 1;  // the first frame has a row: its first tick is that of row 0
  rows.first_tick = first;
  return rows;
}

void LerobotLayout::fill_window(const Lesson& lesson, const Rows& rows, bool action, std::span<double> out) const {
  std::ranges::fill(out, std::numeric_limits<double>::quiet_NaN());
  const std::size_t width = out.size() / window_;
  for (std::size_t row = rows.begin; row < rows.end; ++row) {
    double* const to = out.data() + (lesson.tick[row] - rows.first_tick) * width;
    if (action) {
      put_action(lesson, row, to);
    } else {
      put_force(lesson, masters_, row, put_state(lesson, masters_, row, to));
    }
  }
}

void LerobotLayout::fill(const Lesson& lesson, const LerobotPlace& place, std::size_t feature,
                         std::span<double> out) const {
  const Rows rows = rows_of(lesson, place);
  const std::size_t missing = window_ - (rows.end - rows.begin);
  switch (static_cast<Feature>(feature)) {
    case kState:
      put_state(lesson, masters_, rows.last, out.data());
      break;
    case kForce:
      put_force(lesson, masters_, rows.last, out.data());
      break;
    case kAlpha:
      for (std::size_t i = 0; i < masters_; ++i) out[i] = lesson.seats[i].alpha[rows.last];
      break;
    case kIntervention: {
      bool any = false;
      for (std::size_t row = std::min(rows.begin, rows.last); row <= rows.last; ++row) {
        for (const LessonTool& tool : lesson.tools) {
          double share = 0;
          for (std::size_t i = 0; i < masters_; ++i)
            if (instructors_[i]) share += tool.alpha[row][i];
          any = any || share > kMajority;
        }
      }
      out[0] = any ? 1 : 0;
      break;
    }
    case kGap:
      out[0] = missing > 0 ? 1 : 0;
      break;
    case kMissing:
      out[0] = static_cast<double>(missing);
      break;
    case kWindow:
    case kActionWindow:
      fill_window(lesson, rows, feature == kActionWindow, out);
      break;
    case kAction:
      put_action(lesson, rows.last, out.data());
      break;
    case kTimestamp:
      out[0] = static_cast<double>(place.frame) / fps_;
      break;
    case kFrameIndex:
      out[0] = static_cast<double>(place.frame);
      break;
    case kEpisodeIndex:
      out[0] = static_cast<double>(place.episode);
      break;
    case kIndex:
      out[0] = static_cast<double>(place.index);
      break;
    case kTaskIndex:
      out[0] = 0;
      break;
  }
}

}  // namespace tandem::server
