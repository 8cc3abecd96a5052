#pragma once

namespace tandem::io {

/// Makes the default logger write to standard error, each line beginning with the program's name: standard output
/// belongs to results. For ordinary threads only; spdlog takes a lock.
void log_to_stderr(const char* program);

}  // namespace tandem::io
