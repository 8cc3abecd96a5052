#include "server/recording/lesson_record.h"

namespace tandem::server {
namespace {

void fill_seat(const LessonSeat& in, std::size_t row, SeatRecord& out) noexcept {
  out.alpha = in.alpha[row];
  out.q = in.q[row];
  out.x = in.x[row];
  out.v = in.v[row];
  out.f_cmd = in.f_cmd[row];
  out.f_out = in.f[row];
  out.e_in = in.e_in[row];
  out.e_out = in.e_out[row];
  out.dissipated_j = in.dissipated_j[row];
  out.refused_j = in.refused_j[row];
  out.margin_min_j = in.margin_min_j[row];
  out.delivered_j = in.delivered_j[row];
  out.leader = in.leader[row];
  out.ghost = in.ghost[row];
  out.gate = static_cast<wire::GateState>(in.gate[row]);
  out.engaged = in.engaged[row] != 0;
  out.sample_tick = in.sample_tick[row];
}

void fill_tool(const LessonTool& in, std::size_t row, ToolRecord& out) noexcept {
  out.q = in.q[row];
  out.x = in.x[row];
  out.x_tool = in.x_tool[row];
  out.f_cmd = in.f_cmd[row];
  out.f_env = in.f_env[row];
  out.penetration = in.penetration[row];
  out.held = in.held[row] != 0;
  out.mfs_j = in.mfs_j[row];
  out.e_p_j = in.e_p_j[row];
  out.e_p_axis_j = in.e_p_axis_j[row];
  out.sample_tick = in.sample_tick[row];
  out.alpha = in.alpha[row];
}

}  // namespace

void fill_record(const Lesson& lesson, std::size_t row, TickRecord& record) noexcept {
  record.tick = lesson.tick[row];
  record.time_ns = lesson.time_ns[row];
  record.running = lesson.running[row] != 0;
  record.stopped_ticks = lesson.stopped_ticks[row];
  record.dropped_ticks = lesson.dropped_ticks[row];
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) fill_seat(lesson.seats[i], row, record.seats[i]);
  for (std::size_t j = 0; j < lesson.tools.size(); ++j) fill_tool(lesson.tools[j], row, record.tools[j]);
}

SeatRecord seat_record(const Lesson& lesson, std::size_t seat, std::size_t row) noexcept {
  SeatRecord record;
  fill_seat(lesson.seats[seat], row, record);
  return record;
}

}  // namespace tandem::server
