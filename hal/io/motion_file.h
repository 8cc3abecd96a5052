#pragma once

#include <expected>
#include <memory>
#include <string>

#include "hal/sim/recorded_motion.h"

namespace tandem::hal {

/// Reads and parses `options.file`. Error: one line with the file and, if the content is invalid, line, column and
/// value.
[[nodiscard]] std::expected<std::shared_ptr<const sim::RecordedMotion>, std::string> load_motion(
    const sim::MotionOptions& options);

}  // namespace tandem::hal
