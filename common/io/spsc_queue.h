#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <type_traits>

namespace tandem::io {

/// A bounded queue of plain data from one thread to another, without lock, and without heap after construction. Full:
/// what comes is dropped and counted; a reader that is late never delays the writer.
template <class T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit SpscQueue(std::size_t capacity) : capacity_(capacity), slots_(std::make_unique<T[]>(capacity)) {}

  /// Of the writing thread. @return false if it was dropped
  bool push(const T& value) noexcept {
    const std::uint64_t end = end_.load(std::memory_order_relaxed);
    if (end - begin_.load(std::memory_order_acquire) >= capacity_) {
      dropped_.fetch_add(1, std::memory_order_relaxed);
      return false;
    }
    slots_[end % capacity_] = value;
    end_.store(end + 1, std::memory_order_release);
    return true;
  }
  /// Of the reading thread: the oldest element in its place, null if there is none. It stays until `pop`.
  [[nodiscard]] const T* front() const noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    return begin == end_.load(std::memory_order_acquire) ? nullptr : &slots_[begin % capacity_];
  }
  void pop() noexcept { begin_.store(begin_.load(std::memory_order_relaxed) + 1, std::memory_order_release); }

  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_.load(std::memory_order_relaxed); }

 private:
  std::size_t capacity_;
  std::unique_ptr<T[]> slots_;
  alignas(64) std::atomic<std::uint64_t> begin_{0};
  alignas(64) std::atomic<std::uint64_t> end_{0};
  std::atomic<std::uint64_t> dropped_{0};
};

}  // namespace tandem::io
