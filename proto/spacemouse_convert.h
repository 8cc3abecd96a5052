#pragma once

#include "proto/spacemouse_spec.h"

namespace tandem {

namespace pb {
class SpaceMouseFile;
}

/// Private to proto/*.cpp. Numbers are within their limits already.
[[nodiscard]] SpaceMouseSpec spacemouse_from(const pb::SpaceMouseFile& in);

}  // namespace tandem
