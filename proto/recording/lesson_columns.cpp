#include "proto/recording/lesson_columns.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace tandem::rec {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Call `visit(columns...)` for every column of one or more seats, tools or lessons of one scene.
template <class Visit, class... Seat>
void each_seat_column(Visit visit, Seat&... s) {
  visit(s.fresh...);
  visit(s.sample_tick...);
  visit(s.q...);
  visit(s.x...);
  visit(s.v...);
  visit(s.f...);
  visit(s.f_cmd...);
  visit(s.alpha...);
  visit(s.engaged...);
  visit(s.gate...);
  visit(s.leader...);
  visit(s.ghost...);
  visit(s.e_in...);
  visit(s.e_out...);
  visit(s.dissipated_j...);
  visit(s.refused_j...);
  visit(s.margin_min_j...);
  visit(s.delivered_j...);
}

template <class Visit, class... Tool>
void each_tool_column(Visit visit, Tool&... t) {
  visit(t.q...);
  visit(t.x...);
  visit(t.x_tool...);
  visit(t.f_cmd...);
  visit(t.f_env...);
  visit(t.penetration...);
  visit(t.held...);
  visit(t.alpha...);
  visit(t.mfs_j...);
  visit(t.e_p_j...);
  visit(t.e_p_axis_j...);
  visit(t.sample_tick...);
}

/// The columns but those of ticks and times, and of the seats `without`.
template <class Visit, class... AnyLesson>
void each_column(const LessonSeatSet& without, Visit visit, Lesson& first, AnyLesson&... more) {
  visit(first.running, more.running...);
  visit(first.stopped_ticks, more.stopped_ticks...);
  visit(first.dropped_ticks, more.dropped_ticks...);
  for (std::size_t i = 0; i < first.seats.size(); ++i)
    if (!without[i]) each_seat_column(visit, first.seats[i], more.seats[i]...);
  for (std::size_t j = 0; j < first.tools.size(); ++j) each_tool_column(visit, first.tools[j], more.tools[j]...);
}

template <class Value>
Value unknown() {
  if constexpr (std::is_same_v<Value, double>) {
    return kUnknown;
  } else {
    Value value{};
    if constexpr (!std::is_arithmetic_v<Value>)
      if constexpr (std::is_same_v<typename Value::value_type, double>) value.fill(kUnknown);
    return value;
  }
}

}  // namespace

void reserve_rows(Lesson& lesson, std::size_t rows, const LessonSeatSet& without) {
  lesson.tick.reserve(rows);
  lesson.time_ns.reserve(rows);
  each_column(without, [rows](auto& column) { column.reserve(rows); }, lesson);
}

void copy_rows(const Lesson& from, std::size_t first, std::size_t count, Lesson& to) {
  const auto copy = [first, count](auto& target, const auto& source) {
    if (source.size() < first + count) return;  // a seat without columns
    const auto begin = source.begin() + static_cast<std::ptrdiff_t>(first);
    target.insert(target.end(), begin, begin + static_cast<std::ptrdiff_t>(count));
  };
  copy(to.tick, from.tick);
  copy(to.time_ns, from.time_ns);
  each_column({}, copy, to, from);
}

void erase_rows(Lesson& lesson, std::size_t count) {
  const auto erase = [count](auto& column) {
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(std::min(count, column.size())));
  };
  erase(lesson.tick);
  erase(lesson.time_ns);
  each_column({}, erase, lesson);
}

void append_row(Lesson& lesson, std::uint32_t tick, std::int64_t time_ns, const LessonSeatSet& without) {
  lesson.tick.push_back(tick);
  lesson.time_ns.push_back(time_ns);
  each_column(
      without,
      [](auto& column) {
        using Value = typename std::remove_reference_t<decltype(column)>::value_type;
        const Value value = column.empty() ? unknown<Value>() : column.back();
        column.push_back(value);
      },
      lesson);
  for (LessonSeat& seat : lesson.seats)
    if (!seat.fresh.empty()) seat.fresh.back() = 0;
}

void set_seat(Lesson& lesson, std::size_t i, const SeatSample& sample) {
  LessonSeat& seat = lesson.seats[i];
  if (seat.sample_tick.empty()) return;
  const std::size_t row = seat.sample_tick.size() - 1;
  const std::uint32_t before = row == 0 ? 0 : seat.sample_tick[row - 1];
  seat.fresh.back() = sample.sample_tick != before ? 1 : 0;
  seat.sample_tick.back() = sample.sample_tick;
  seat.q.back() = sample.measured_jp;
  seat.x.back() = sample.measured_cp;
  seat.v.back() = sample.measured_cv;
  seat.f.back() = sample.measured_cf;
  seat.f_cmd.back() = sample.servo_cf;
  seat.alpha.back() = sample.alpha;
  seat.engaged.back() = sample.engaged ? 1 : 0;
  seat.gate.back() = sample.gate;
  seat.leader.back() = sample.leader;
  seat.ghost.back() = sample.ghost;
  seat.e_in.back() = sample.energy.e_in;
  seat.e_out.back() = sample.energy.e_out;
  seat.dissipated_j.back() = sample.energy.dissipated_j;
  seat.refused_j.back() = sample.energy.refused_j;
  seat.margin_min_j.back() = sample.energy.margin_min_j;
  seat.delivered_j.back() = sample.energy.delivered_j;
}

void set_tool(Lesson& lesson, std::size_t j, const ToolSample& sample) {
  LessonTool& tool = lesson.tools[j];
  tool.q.back() = sample.measured_jp;
  tool.x.back() = sample.measured_cp;
  tool.x_tool.back() = sample.setpoint_cp;
  tool.f_cmd.back() = sample.servo_cf;
  tool.f_env.back() = sample.measured_cf;
  tool.penetration.back() = sample.penetration;
  tool.held.back() = sample.braked ? 1 : 0;
  tool.sample_tick.back() = sample.sample_tick;
  tool.mfs_j.back() = sample.energy.mfs_j;
  tool.e_p_j.back() = sample.energy.e_p_j;
  tool.e_p_axis_j.back() = sample.energy.e_p_axis_j;
}

void set_authority(Lesson& lesson, const AuthoritySample& sample) {
  for (std::size_t j = 0; j < std::min(sample.tools, lesson.tools.size()); ++j)
    lesson.tools[j].alpha.back() = sample.alpha[j];
}

void set_session(Lesson& lesson, const SessionSample& sample) {
  lesson.running.back() = sample.running ? 1 : 0;
  lesson.stopped_ticks.back() = sample.stopped_ticks;
  lesson.dropped_ticks.back() = sample.dropped_ticks;
}

}  // namespace tandem::rec
