#pragma once

#include <string_view>

#include "common/io/fd.h"

namespace tandem::io {

/// Returns a signalfd for SIGINT, SIGTERM and SIGHUP. Call before threads start: they inherit the blocked signals, so
/// that only the reader of this descriptor receives them.
[[nodiscard]] Fd make_signalfd();

/// Returns the text of a pending signal for users: "Ctrl-C", "SIGTERM", "SIGHUP (its terminal is gone)"; empty: none.
/// The signal stays pending.
[[nodiscard]] std::string_view pending_signal() noexcept;

}  // namespace tandem::io
