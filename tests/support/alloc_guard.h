#pragma once

#include <cstddef>

namespace tandem::test {

/// Counts the allocations of this thread through operator new during the lifetime of the guard. Guards may nest.
/// Linking alloc_guard.cpp replaces the global operator new of the test program.
class AllocGuard {
 public:
  AllocGuard() noexcept;
  AllocGuard(const AllocGuard&) = delete;
  AllocGuard& operator=(const AllocGuard&) = delete;
  [[nodiscard]] std::size_t count() const noexcept;

 private:
  std::size_t before_;
};

}  // namespace tandem::test
