#pragma once

#include "hal/device.h"
#include "proto/woodenhaptics_spec.h"

namespace tandem::hal::woodenhaptics {

/// The watchdog of the published mbed firmware (V1 and V2): amplifiers off after so long without a report of the host. Far too long
/// to rely on. No firmware for RAW64 boards is published: whether they have a watchdog is not known.
inline constexpr std::chrono::milliseconds kBoardWatchdog{500};

/// What such a mechanism can do, at its workspace's origin: force per axis until the weakest motor is at its current
/// limit, or the maker's limit; resolution of one count of every encoder. Unknown stays unknown.
[[nodiscard]] DeviceCaps caps_of(const WoodenHapticsSpec& spec);

}  // namespace tandem::hal::woodenhaptics
