#pragma once

#include "hal/core/device.h"
#include "proto/spec/woodenhaptics_spec.h"

namespace tandem::hal::woodenhaptics {

/// Watchdog time-out of the published mbed firmware (V1 and V2): without a host report for this long it switches the
/// amplifiers off.
/// It is too long to rely on. No firmware for RAW64 boards is published, so their watchdog is unknown.
inline constexpr std::chrono::milliseconds kBoardWatchdog{500};

/// Returns the capabilities of the mechanism, computed at its workspace's origin.
/// Force per axis: until the weakest motor reaches its current limit, or the maker's limit. Resolution: one count of
/// every encoder. Unknown values stay empty.
[[nodiscard]] DeviceCaps caps_of(const WoodenHapticsSpec& spec);

}  // namespace tandem::hal::woodenhaptics
