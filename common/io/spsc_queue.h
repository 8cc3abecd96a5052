#pragma once

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <type_traits>

namespace tandem::io {

/// A bounded single-producer, single-consumer queue of plain data, without lock and without heap use after
/// construction. If it is full, new elements are dropped and counted; a late reader never delays the writer.
template <class T>
class SpscQueue {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  explicit SpscQueue(std::size_t capacity) : capacity_(capacity), slots_(std::make_unique<T[]>(capacity)) {}

  /// For the writing thread. @return false if the element was dropped
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
  /// For the reading thread: returns the oldest element in place, null if there is none. It stays valid until `pop`.
  [[nodiscard]] const T* front() const noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    return begin == end_.load(std::memory_order_acquire) ? nullptr : &slots_[begin % capacity_];
  }
  /// For the reading thread: removes the oldest element. @return its value; nullopt if there is none
  [[nodiscard]] std::optional<T> take() noexcept {
    const T* const oldest = front();
    if (oldest == nullptr) return std::nullopt;
    const T value = *oldest;
    pop();
    return value;
  }
  /// Removes the oldest element. @pre front() is not null
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
