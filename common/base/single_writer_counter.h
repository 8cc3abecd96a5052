#pragma once

#include <atomic>

namespace tandem {

/// Number that one thread changes and any thread reads. A single writer needs no locked instruction.
template <class T>
class SingleWriterCounter {
 public:
  void add(T by) noexcept { value_.store(get() + by, std::memory_order_relaxed); }
  void reset() noexcept { value_.store(0, std::memory_order_relaxed); }
  [[nodiscard]] T get() const noexcept { return value_.load(std::memory_order_relaxed); }

 private:
  std::atomic<T> value_{0};
};

}  // namespace tandem
