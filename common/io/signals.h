#pragma once

#include "common/io/fd.h"

namespace tandem::io {

/// SIGINT, SIGTERM and SIGHUP as something to wait for. Call before threads start: they inherit the block, and all of
/// them leave the signals to the one who reads here.
[[nodiscard]] Fd signals_as_file();

}  // namespace tandem::io
