#pragma once

#include <expected>
#include <memory>
#include <string>

#include "hal/io/open_sim_device.h"

namespace tandem::hal {

/// Reads the motion of a hand from a recording (MCAP), for `motion=FILE.mcap` and hands of simulations.
/// @param name  MASTER seat of the recording
/// @param hand  simulated hand that follows it; the motion is relative to the center of its trajectory
/// Error: one line with the file; a seat that the recording does not have, with those that it has.
[[nodiscard]] std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string> load_recording_motion(
    const std::string& file, const std::string& name, const HandSpec& hand);

/// Returns the reader for open_sim_device.
/// @param own_seat  seat whose hand is read where `seat=NAME` is not given
[[nodiscard]] RecordingMotionReader recording_motion_reader(std::string own_seat);

}  // namespace tandem::hal
