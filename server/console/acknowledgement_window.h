#pragma once

#include <cstdint>

namespace tandem::console {

/// Limits the states on their way to one browser: at most kOpenMax are sent and not acknowledged. Further states are
/// dropped and counted, so that a slow browser needs no memory.
class AcknowledgementWindow {
 public:
  static constexpr std::uint64_t kOpenMax = 3;

  /// Returns the number of the state to send now; 0: the state is dropped.
  [[nodiscard]] std::uint64_t next() noexcept {
    if (sent_ - acknowledged_ < kOpenMax) return ++sent_;
    ++dropped_;
    return 0;
  }
  /// Counts a state that the caller could not send for another reason.
  void drop() noexcept { ++dropped_; }
  /// Acknowledges all states up to `n`. Returns false, without effect, for a state that was never sent.
  bool acknowledge(std::uint64_t n) noexcept {
    if (n > sent_) return false;
    if (n > acknowledged_) acknowledged_ = n;
    return true;
  }
  [[nodiscard]] std::uint64_t dropped() const noexcept { return dropped_; }

 private:
  std::uint64_t sent_ = 0, acknowledged_ = 0, dropped_ = 0;
};

}  // namespace tandem::console
