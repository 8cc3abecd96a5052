#include "server/console/live_lesson.h"

#include <algorithm>
#include <cmath>

#include "proto/wire/wire_messages.h"

namespace tandem::console {
namespace {

constexpr std::size_t kSeatBytes = 70, kToolBytes = 60 + 8 * kMastersMax, kTickBytes = 12;  // of a row

bool runs(wire::SessionState state) {
  return state == wire::SessionState::kRunning || state == wire::SessionState::kHeld;
}

/// Calls `visit` for each column that is used.
template <class Visit>
void each_live_column(Lesson& lesson, Visit visit) {
  visit(lesson.tick);
  visit(lesson.stopped_ticks);
  for (LessonSeat& seat : lesson.seats) {
    visit(seat.x);
    visit(seat.f);
    visit(seat.engaged);
    visit(seat.gate);
    visit(seat.margin_min_j);
  }
  for (LessonTool& tool : lesson.tools) {
    visit(tool.x);
    visit(tool.f_env);
    visit(tool.penetration);
    visit(tool.alpha);
  }
}

}  // namespace

LiveLesson::LiveLesson(const SceneSpec& scene)
    : period_(std::max<std::uint32_t>(1, static_cast<std::uint32_t>(std::ceil(scene.tick_hz / wire::kTelemetryHz)))) {
  lesson_.scene = scene;
  lesson_.scene.tick_hz = scene.tick_hz / period_;
  lesson_.seats.resize(scene.seats.size());
  lesson_.tools.resize(scene.tools.size());
  const std::size_t row = kTickBytes + kSeatBytes * scene.seats.size() + kToolBytes * scene.tools.size();
  rows_max_ = std::min(kRowsMax, kBytesMax / row);
}

void LiveLesson::add(const LivePicture& picture) {
  const LiveValues& live = *picture.live;
  const wire::SessionTelemetry& t = live.telemetry;
  if (!runs(t.state)) {
    ++stops_;
    return;
  }
  const std::uint32_t tick = t.session_tick / period_;
  if (!lesson_.tick.empty() && tick < lesson_.tick.back()) clear();
  if (!lesson_.tick.empty() && tick == lesson_.tick.back()) return;
  if (lesson_.rows() >= rows_max_) drop_oldest(rows_max_ / 10);
  lesson_.session = picture.status.name;
  lesson_.tick.push_back(tick);
  lesson_.stopped_ticks.push_back(stops_);
  for (std::size_t i = 0; i < lesson_.seats.size(); ++i) {
    LessonSeat& seat = lesson_.seats[i];
    const wire::WatchedSeatState& from = t.seats[i];
    constexpr LessonTriple kSilent{wire::kUnknown, wire::kUnknown, wire::kUnknown};
    if (i < picture.status.seats.size()) seat.person = picture.status.seats[i].person;
    seat.x.push_back(from.heard ? from.x : kSilent);
    seat.f.push_back(from.heard ? from.f : kSilent);
    seat.engaged.push_back(from.engaged ? 1 : 0);
    seat.gate.push_back(static_cast<std::uint8_t>(from.gate));
    seat.margin_min_j.push_back(live.links[i].margin_min_j);
  }
  for (std::size_t j = 0; j < lesson_.tools.size(); ++j) {
    LessonTool& tool = lesson_.tools[j];
    tool.x.push_back(t.tools[j].x);
    tool.f_env.push_back(t.tools[j].f);
    tool.penetration.push_back(t.tools[j].depth);
    tool.alpha.push_back(live.authorities[j].applied);
  }
}

void LiveLesson::clear() {
  each_live_column(lesson_, [](auto& column) { column.clear(); });
}

void LiveLesson::drop_oldest(std::size_t rows) {
  each_live_column(lesson_, [rows](auto& column) {
    column.erase(column.begin(), column.begin() + static_cast<std::ptrdiff_t>(std::min(rows, column.size())));
  });
}

}  // namespace tandem::console
