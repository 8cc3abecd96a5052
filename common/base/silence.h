#pragma once

#include "common/base/time.h"

namespace tandem {

/// How long a session survives silence, the same at both ends: a server ends a session in which nobody was heard for so long, and a client that heard
/// nothing for so long stops asking for its seat (`--rejoin`). Hands are free long before (gate: 20 ms).
inline constexpr Duration kSessionSilence = std::chrono::seconds(60);

}  // namespace tandem
