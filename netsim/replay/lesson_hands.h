#pragma once

#include <expected>
#include <memory>
#include <string>

#include "hal/sim/recorded_motion.h"
#include "proto/spec/lesson.h"

namespace tandem::netsim {

/// Recorded motion of a seat's hand, as the intention of a simulated hand (HandModel::kRecorded): tip of the device
/// [m], in session time, by the ticks of the samples. While the session clock stands still the hand does too.
/// @param name    of the MASTER seat
/// @param center  center of the simulated hand's trajectory, to which the motion is relative [m]
/// @return an error: no such seat, or a motion of fewer than two samples or with numbers that are not finite
[[nodiscard]] std::expected<std::shared_ptr<const hal::sim::RecordedMotion>, std::string> motion_of_seat(
    const Lesson& lesson, const std::string& name, const Point& center);

}  // namespace tandem::netsim
