#pragma once

#include <cstddef>

namespace tandem::test {

/// Counts what this thread takes from the heap through operator new while the guard lives. Guards may nest. Linking
/// alloc_guard.cpp replaces the global operator new of the test program.
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
