#pragma once

#include "common/base/time.h"

namespace tandem {

/// How long a session survives silence, equal at both ends. The server ends a session after this time without datagrams
/// from any client. A client without datagrams for this time stops resuming its seat (`--reconnect-timeout`). The force
/// gate releases hands much earlier (20 ms).
inline constexpr Duration kSessionTimeout = std::chrono::seconds(60);

}  // namespace tandem
