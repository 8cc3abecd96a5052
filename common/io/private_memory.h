#pragma once

namespace tandem::io {

/// First act of a program that will hold keys: no core dump of it is ever written, and no other process of the same user may look into
/// its memory (Linux: RLIMIT_CORE 0 and PR_SET_DUMPABLE 0). Builds with TANDEM_DEBUG keep both, since sanitizers and debuggers look into it.
/// What may lie in swap is `lock_memory`'s business (realtime.h).
/// @return whether it is so from now on
bool keep_memory_private() noexcept;

/// What the function above does, in every build. For tests.
bool forbid_dumps() noexcept;

}  // namespace tandem::io
