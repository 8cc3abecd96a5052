#pragma once

#include <string>

#include "hal/io/attached.h"

namespace tandem::hal {

/// What speaks on this bus, with the version the loaded library says it has: "libusb 1.0.26.11724".
[[nodiscard]] std::string library_of(Bus bus);

}  // namespace tandem::hal
