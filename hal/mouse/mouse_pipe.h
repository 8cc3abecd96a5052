#pragma once

#include <expected>

#include "hal/device.h"

namespace tandem::hal {

/// What a mouse did since it was asked last.
struct MouseMove {
  int right = 0, forward = 0;  ///< [counts]
  int wheel = 0;               ///< [detents], positive: rolled away from the user
  unsigned buttons = 0;        ///< pressed now: 1 left, 2 right, 4 middle
};

/// Where a driver gets it from. Nothing here waits, throws or takes memory.
struct MousePipe {
  virtual ~MousePipe() = default;
  /// Error: kUnplugged.
  virtual std::expected<MouseMove, Errc> read() noexcept = 0;
};

}  // namespace tandem::hal
