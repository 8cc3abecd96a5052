#include "server/console/recording_states.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <optional>
#include <utility>

#include "server/console/state_json.h"

namespace tandem::console {
namespace {

constexpr double kHeardSeconds = 0.1;  // a sample that is older counts as silence

wire::WatchedSeatState seat_of(const Lesson& lesson, std::size_t i, std::size_t row) {
  const LessonSeat& seat = lesson.seats[i];
  wire::WatchedSeatState out;
  out.taken = true;
  const std::uint32_t tick = lesson.tick[row], sample = seat.sample_tick[row];
  out.heard = tick <= sample || tick - sample <= kHeardSeconds * lesson.scene.tick_hz;
  out.engaged = seat.engaged[row] != 0;
  out.gate = static_cast<wire::GateState>(seat.gate[row]);
  out.x = seat.x[row];
  out.f = seat.f[row];
  return out;
}

wire::WatchedToolState tool_of(const LessonTool& tool, std::size_t row) {
  wire::WatchedToolState out;
  out.x = tool.x[row];
  out.f = tool.f_env[row];
  out.depth = tool.penetration[row];
  out.touching = tool.penetration[row] > 0;
  out.braked = tool.held[row] != 0;
  return out;
}

wire::WatchedLink link_of(const LessonLink& link) {
  wire::WatchedLink out;
  out.seat = link.seat;
  out.rtt_p50_ms = link.rtt_p50_ms;
  out.loss_up_percent = link.loss_up_percent;
  out.loss_down_percent = link.loss_down_percent;
  out.gap_up_ms = link.gap_up_ms;
  out.gap_down_ms = link.gap_down_ms;
  out.age_p99_ms = link.age_p99_ms;
  out.gate_trips = link.gate_trips;
  out.late_ticks = link.late_ticks;
  return out;
}

}  // namespace

RecordingPeriods::RecordingPeriods(double tick_hz, std::uint32_t first, std::uint32_t last) noexcept
    : tick_hz_(tick_hz), rate_(std::min(kRateMax, tick_hz)), first_(first) {
  per_piece_ = std::max<std::uint32_t>(1, static_cast<std::uint32_t>(kPieceSeconds * rate_));
  const double periods = std::floor((last - first) * rate_ / tick_hz_) + 1;
  pieces_ = static_cast<std::uint32_t>(std::ceil(periods / per_piece_));
}

std::uint64_t RecordingPeriods::tick(std::uint64_t period) const noexcept {
  return first_ + static_cast<std::uint64_t>(std::ceil(static_cast<double>(period) * tick_hz_ / rate_ - 1e-9));
}

LivePicture recording_base(const Lesson& head, const rpc::Id& id) {
  LivePicture base;
  base.number = 1;
  base.connected = true;
  base.status.session_id = id;
  base.status.name = head.session.empty() ? head.scene.name : head.session;
  base.scene = std::make_shared<const SceneSpec>(head.scene);
  for (std::size_t i = 0; i < head.scene.seats.size(); ++i) {
    const SeatSpec& seat = head.scene.seats[i];
    base.status.seats.push_back(
        {seat.name, access_role(seat.role), true, true, seat.kind == SeatKind::kMaster, head.seats[i].person});
  }
  return base;
}

LivePicture picture_of(const Lesson& lesson, std::size_t row, const LivePicture& base, const SeatPresence& presence,
                       std::size_t& link) {
  auto live = base.live ? std::make_shared<LiveValues>(*base.live) : std::make_shared<LiveValues>();
  live->telemetry.session_tick = lesson.tick[row];
  live->telemetry.state = wire::SessionState::kRunning;  // a recording has rows only while the session clock runs
  for (; link < lesson.links.size() && lesson.links[link].tick <= lesson.tick[row]; ++link)
    live->links[lesson.links[link].seat] = link_of(lesson.links[link]);
  for (std::size_t i = 0; i < lesson.seats.size(); ++i) {
    if (presence.taken(i)) {
      live->telemetry.seats[i] = seat_of(lesson, i, row);
      live->links[i].margin_min_j = lesson.seats[i].margin_min_j[row];
    } else {
      live->telemetry.seats[i] = {};
      live->links[i] = {.seat = static_cast<std::uint32_t>(i)};
    }
  }
  for (std::size_t j = 0; j < lesson.tools.size(); ++j) {
    live->telemetry.tools[j] = tool_of(lesson.tools[j], row);
    live->authorities[j].applied = live->authorities[j].wanted = lesson.tools[j].alpha[row];
  }
  LivePicture out = base;
  out.live = std::move(live);
  return out;
}

std::string piece_json(const RecordingPeriods& periods, std::uint32_t piece, const Lesson& lesson,
                       const LivePicture& base) {
  std::string out = "{\"piece\":" + std::to_string(piece) + ",\"states\":[";
  const std::optional<rpc::StatusStop> no_stop;
  LivePicture picture = base;
  SeatPresence presence(lesson.scene);
  std::size_t row = 0, next = 0, link = 0;
  bool first = true;
  for (std::uint32_t k = 0; k < periods.per_piece(); ++k) {
    const std::uint64_t period = std::uint64_t{piece} * periods.per_piece() + k;
    const std::uint64_t begin = periods.tick(period), end = periods.tick(period + 1);
    while (row < lesson.rows() && lesson.tick[row] < begin) ++row;
    if (row == lesson.rows()) break;
    if (lesson.tick[row] >= end) continue;
    while (next <= row) presence.add(lesson, next++);
    picture = picture_of(lesson, row, picture, presence, link);
    const StateHead head{.n = period + 1, .dropped = 0, .wall_us = 0, .age_ms = {}, .stop = &no_stop};
    if (!std::exchange(first, false)) out += ',';
    out += state_json(head, state_members(picture));
  }
  return out + "]}";
}

}  // namespace tandem::console
