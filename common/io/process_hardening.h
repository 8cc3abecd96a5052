#pragma once

namespace tandem::io {

/// Hardens a program that will hold keys; call first. It disables core dumps, and other processes of the same user
/// cannot read its memory (Linux: RLIMIT_CORE 0 and PR_SET_DUMPABLE 0). Builds with TANDEM_DEBUG do nothing, because
/// sanitizers and debuggers read the memory. `lock_memory` (realtime.h) keeps memory out of swap.
/// @return whether both are in force
bool harden_process() noexcept;

/// Does the same in every build. For tests.
bool disable_core_dumps() noexcept;

}  // namespace tandem::io
