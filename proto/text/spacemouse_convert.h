#pragma once

#include "proto/spec/spacemouse_spec.h"

namespace tandem {

namespace pb {
class SpaceMouseFile;
}

/// Private to proto/text: converts SpaceMouse parameters. @pre numbers are within their limits
[[nodiscard]] SpaceMouseSpec spacemouse_from(const pb::SpaceMouseFile& in);

}  // namespace tandem
