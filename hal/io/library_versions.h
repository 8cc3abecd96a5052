#pragma once

#include <string>

#include "hal/io/enumeration.h"

namespace tandem::hal {

/// Returns the library used for this bus, with the version it reports at run time: "libusb 1.0.26.11724".
[[nodiscard]] std::string library_of(Bus bus);

}  // namespace tandem::hal
