#pragma once

#include <expected>
#include <memory>
#include <string>

#include "hal/sim/recorded_motion.h"
#include "proto/spec/lesson.h"

namespace tandem::hal::sim {

/// Returns whether no sample of this seat exists: no participant took it.
/// @param name  of a seat of the lesson
[[nodiscard]] bool seat_was_free(const Lesson& lesson, const std::string& name);

/// Motion of a seat's hand as the intention of a simulated hand (HandModel::kRecorded), in session time by the ticks of
/// the samples. The intended position is that of the recorded tip, moved against the force on the hand by F / k: the
/// hand's spring of stiffness k then holds the tip where it was recorded, while the hand is at rest. While the session
/// clock stands still the hand does too.
/// @param name    of the MASTER seat
/// @param center  center of the simulated hand's trajectory, to which the motion is relative [m]
/// @param k       stiffness of the hand [N/m], positive
/// @return an error: no such seat (with the seats that have a hand), a seat that no participant took, or a motion of
/// fewer than two samples or with numbers that are not finite
[[nodiscard]] std::expected<std::shared_ptr<const RecordedMotion>, std::string> motion_of_seat(const Lesson& lesson,
                                                                                               const std::string& name,
                                                                                               const Point& center,
                                                                                               double k);

}  // namespace tandem::hal::sim
