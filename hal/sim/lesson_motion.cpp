#include "hal/sim/lesson_motion.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tandem::hal::sim {
namespace {

/// Names of the seats whose hands the lesson has, for messages.
std::string recorded_hands(const Lesson& lesson) {
  std::string text;
  for (const SeatSpec& seat : lesson.scene.seats)
    if (seat.kind == SeatKind::kMaster && !seat_was_free(lesson, seat.name)) text += " " + seat.name;
  return text.empty() ? " none" : text;
}

}  // namespace

bool seat_was_free(const Lesson& lesson, const std::string& name) {
  const auto found = std::ranges::find(lesson.scene.seats, name, &SeatSpec::name);
  if (found == lesson.scene.seats.end()) return true;
  const LessonSeat& seat = lesson.seats[static_cast<std::size_t>(found - lesson.scene.seats.begin())];
  return std::ranges::none_of(seat.fresh, [](std::uint8_t fresh) { return fresh != 0; });
}

std::expected<std::shared_ptr<const RecordedMotion>, std::string> motion_of_seat(const Lesson& lesson,
                                                                                 const std::string& name,
                                                                                 const Point& center, double k) {
  const auto found = std::ranges::find_if(
      lesson.scene.seats, [&](const SeatSpec& s) { return s.name == name && s.kind == SeatKind::kMaster; });
  if (found == lesson.scene.seats.end())
    return std::unexpected("the recording has no hand " + name + "; it has:" + recorded_hands(lesson));
  if (seat_was_free(lesson, name))
    return std::unexpected("no participant took seat " + name +
                           "; the recording has the hands:" + recorded_hands(lesson));
  const LessonSeat& seat = lesson.seats[static_cast<std::size_t>(found - lesson.scene.seats.begin())];
  const Vec3 middle = to_vec3(center);
  std::vector<double> times;
  std::vector<Vec3> points;
  for (std::size_t row = 0; row < lesson.rows(); ++row) {
    const double time = seat.sample_tick[row] / lesson.scene.tick_hz;
    if (seat.fresh[row] == 0 || (!times.empty() && time <= times.back())) continue;
    // Recordings have tip and force as the tool sees them.
    const Vec3 x =
        Vec3(seat.x[row].data()) / found->motion_scale - middle - Vec3(seat.f[row].data()) * (found->motion_scale / k);
    if (times.empty() && time > 0) {  // a motion begins at time 0
      times.push_back(0);
      points.push_back(x);
    }
    times.push_back(time);
    points.push_back(x);
  }
  auto motion = RecordedMotion::from_points(std::move(times), std::move(points));
  if (!motion) return std::unexpected("seat " + name + ": " + motion.error());
  return std::make_shared<const RecordedMotion>(std::move(*motion));
}

}  // namespace tandem::hal::sim
