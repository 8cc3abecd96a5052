#pragma once

#include <array>
#include <atomic>
#include <cstdint>
#include <type_traits>

namespace tandem::hal::openhaptics {

/// Latest-value mailbox between two threads: neither waits, and new values overwrite older ones. One writer, one
/// reader.
template <class T>
class Latest {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  void write(const T& value) noexcept {
    values_[mine_] = value;
    mine_ = between_.exchange(mine_ | kNew, std::memory_order_acq_rel) & ~kNew;
  }
  /// Returns the newest value, or the previous one if there is no new one. The reference is valid until the next call.
  [[nodiscard]] const T& read() noexcept {
    if ((between_.load(std::memory_order_relaxed) & kNew) != 0)
      readers_ = between_.exchange(readers_, std::memory_order_acq_rel) & ~kNew;
    return values_[readers_];
  }

 private:
  static constexpr unsigned kNew = 4;
  std::array<T, 3> values_{};
  unsigned mine_ = 0, readers_ = 1;
  std::atomic<unsigned> between_{2};
};

}  // namespace tandem::hal::openhaptics
