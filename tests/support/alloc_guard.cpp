#include "tests/support/alloc_guard.h"

#include "common/base/heap_count.h"

namespace tandem::test {

AllocGuard::AllocGuard() noexcept : before_(heap_allocations()) {}
std::size_t AllocGuard::count() const noexcept { return heap_allocations() - before_; }

}  // namespace tandem::test
