#include "proto/recording/lesson_columns.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace tandem::rec {
namespace {

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

/// Calls `visit(column)` for every column of a seat, a tool or the lesson itself.
template <class Seat, class Visit>
void each_seat_column(Seat& s, Visit visit) {
  visit(s.fresh);
  visit(s.sample_tick);
  visit(s.q);
  visit(s.x);
  visit(s.v);
  visit(s.f);
  visit(s.f_cmd);
  visit(s.alpha);
  visit(s.engaged);
  visit(s.gate);
  visit(s.leader);
  visit(s.ghost);
  visit(s.e_in);
  visit(s.e_out);
  visit(s.dissipated_j);
  visit(s.refused_j);
  visit(s.margin_min_j);
  visit(s.delivered_j);
}

template <class Tool, class Visit>
void each_tool_column(Tool& t, Visit visit) {
  visit(t.q);
  visit(t.x);
  visit(t.x_tool);
  visit(t.f_cmd);
  visit(t.f_env);
  visit(t.penetration);
  visit(t.held);
  visit(t.alpha);
  visit(t.mfs_j);
  visit(t.e_p_j);
  visit(t.e_p_axis_j);
  visit(t.sample_tick);
}

template <class Visit>
void each_column(Lesson& lesson, const LessonSeatSet& without, Visit visit) {
  visit(lesson.running);
  visit(lesson.stopped_ticks);
  visit(lesson.dropped_ticks);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i)
    if (!without[i]) each_seat_column(lesson.seats[i], visit);
  for (LessonTool& tool : lesson.tools) each_tool_column(tool, visit);
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
  each_column(lesson, without, [rows](auto& column) { column.reserve(rows); });
}

void append_row(Lesson& lesson, std::uint32_t tick, std::int64_t time_ns, const LessonSeatSet& without) {
  lesson.tick.push_back(tick);
  lesson.time_ns.push_back(time_ns);
  each_column(lesson, without, [](auto& column) {
    using Value = typename std::remove_reference_t<decltype(column)>::value_type;
    const Value value = column.empty() ? unknown<Value>() : column.back();
    column.push_back(value);
  });
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
