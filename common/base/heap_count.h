#pragma once

#include <cstdint>

namespace tandem {

/// Returns how many times this thread has allocated through operator new. A program that links this replaces the global
/// operator new by a counting one. Used by tests and by invariant checkers of "no heap within a tick"
/// (SimulationConfig::heap_count).
[[nodiscard]] std::uint64_t heap_allocations() noexcept;

}  // namespace tandem
