#pragma once

#include <expected>

#include "hal/core/device.h"

namespace tandem::hal {

/// Motion of a mouse since the previous read.
struct MouseMove {
  int right = 0, forward = 0;  ///< [counts]
  int wheel = 0;               ///< [detents], positive: rolled away from the user
  unsigned buttons = 0;        ///< pressed buttons: 1 left, 2 right, 4 middle
};

/// Source of mouse events for the driver. No function waits, throws or allocates.
struct MousePipe {
  virtual ~MousePipe() = default;
  /// Returns the motion since the previous call. Error: kUnplugged.
  virtual std::expected<MouseMove, Errc> read() noexcept = 0;
};

}  // namespace tandem::hal
