#pragma once

#include <cstdint>

namespace tandem {

/// What this thread has taken from the heap through operator new so far. A program that links this has the global operator
/// new replaced by one that counts: for tests, and for oracles that judge "no heap below a tick" (WorldSetup::heap_count).
[[nodiscard]] std::uint64_t heap_allocations() noexcept;

}  // namespace tandem
