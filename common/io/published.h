#pragma once

#include <mutex>

namespace tandem::io {

/// Value that one thread publishes and other threads copy. The publishing thread never waits: while a reader copies, it
/// skips an update, and readers keep the value before it.
template <class T>
class Published {
 public:
  /// Lets `write` change the value in place, unless a reader copies it now. @return whether `write` was called
  template <class Write>
  bool update(Write&& write) noexcept {
    const std::unique_lock lock{lock_, std::try_to_lock};
    if (lock) write(value_);
    return lock.owns_lock();
  }
  /// Publishes a copy of `value`. @return false: a reader copies, so this value is skipped
  bool publish(const T& value) noexcept {
    return update([&](T& published) { published = value; });
  }
  /// Copies the value published last; at first a default value.
  [[nodiscard]] T read() const {
    const std::lock_guard lock{lock_};
    return value_;
  }

 private:
  mutable std::mutex lock_;  ///< the publishing thread only tries it
  T value_ = T();
};

}  // namespace tandem::io
