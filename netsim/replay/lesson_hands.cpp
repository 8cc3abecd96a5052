#include "netsim/replay/lesson_hands.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace tandem::netsim {

std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, std::string> motion_of_seat(const Lesson& lesson,
                                                                                           const std::string& name,
                                                                                           const Point& center,
                                                                                           double k) {
  const auto found = std::ranges::find_if(
      lesson.scene.seats, [&](const SeatSpec& s) { return s.name == name && s.kind == SeatKind::kMaster; });
  if (found == lesson.scene.seats.end()) {
    std::string text = "the recording has no hand " + name + "; it has:";
    for (const SeatSpec& seat : lesson.scene.seats)
      if (seat.kind == SeatKind::kMaster) text += " " + seat.name;
    return std::unexpected(std::move(text));
  }
  const LessonSeat& seat = lesson.seats[static_cast<std::size_t>(found - lesson.scene.seats.begin())];
  const hal::Vec3 middle = hal::sim::to_vec3(center);
  std::vector<double> times;
  std::vector<hal::Vec3> points;
  for (std::size_t row = 0; row < lesson.rows(); ++row) {
    const double time = seat.sample_tick[row] / lesson.scene.tick_hz;
    if (seat.fresh[row] == 0 || (!times.empty() && time <= times.back())) continue;
    // Recordings have tip and force as the tool sees them.
    const hal::Vec3 x = hal::Vec3(seat.x[row].data()) / found->motion_scale - middle -
                        hal::Vec3(seat.f[row].data()) * (found->motion_scale / k);
    if (times.empty() && time > 0) {  // a motion begins at time 0
      times.push_back(0);
      points.push_back(x);
    }
    times.push_back(time);
    points.push_back(x);
  }
  auto motion = hal::sim::RecordedMotion::from_points(std::move(times), std::move(points));
  if (!motion) return std::unexpected("seat " + name + ": " + motion.error());
  return std::make_shared<const hal::sim::RecordedMotion>(std::move(*motion));
}

}  // namespace tandem::netsim
