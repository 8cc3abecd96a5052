#pragma once

#include <string_view>

#include "common/io/fd.h"

namespace tandem::io {

/// SIGINT, SIGTERM and SIGHUP as something to wait for. Call before threads start: they inherit the block, and all of
/// them leave the signals to the one who reads here.
[[nodiscard]] Fd signals_as_file();

/// What came and was not read yet, in a person's words: "Ctrl-C", "SIGTERM", "SIGHUP (its terminal is gone)"; empty: nothing.
[[nodiscard]] std::string_view signal_that_came() noexcept;

}  // namespace tandem::io
