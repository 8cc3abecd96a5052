#pragma once

namespace tandem::io {

/// Number of processors that the kernel lets this process use (its affinity); at least 1.
[[nodiscard]] unsigned available_processors() noexcept;

}  // namespace tandem::io
