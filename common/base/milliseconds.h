#pragma once

#include <cmath>

#include "common/base/time.h"

namespace tandem {

/// Returns a duration given in milliseconds, the unit of files and options, rounded to 1 ns.
[[nodiscard]] inline Duration from_milliseconds(double ms) { return Duration{std::llround(ms * 1e6)}; }

}  // namespace tandem
