#pragma once

#include <string_view>

namespace tandem::io {

/// Tells whoever supervises this program (systemd's `Type=notify`, sd_notify(3)) how it is: `READY=1`, `STOPPING=1`, `WATCHDOG=1`.
/// Nobody supervises ($NOTIFY_SOCKET is not set): nothing happens.
void notify_service(std::string_view state) noexcept;

}  // namespace tandem::io
