#pragma once

#include <string_view>

namespace tandem::io {

/// Sends the state of this program to its supervisor (systemd's `Type=notify`, sd_notify(3)): `READY=1`, `STOPPING=1`,
/// `WATCHDOG=1`. Without a supervisor ($NOTIFY_SOCKET is not set) it does nothing.
void systemd_notify(std::string_view state) noexcept;

}  // namespace tandem::io
