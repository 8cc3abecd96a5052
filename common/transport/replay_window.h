#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace tandem::transport {

/// Window of the last 1024 counters [in the style of RFC 6479] that detects repeated counters. Late counters serve
/// statistics; control uses only strictly newer datagrams.
class ReplayWindow {
 public:
  enum class Verdict : std::uint8_t { kNewer, kLate, kDuplicate, kTooOld };
  static constexpr std::uint64_t kSize = 1024;

  /// Returns the verdict of `record` without recording.
  [[nodiscard]] Verdict check(std::uint64_t counter) const noexcept {
    if (!any_ || counter > newest_) return Verdict::kNewer;
    if (newest_ - counter >= kSize) return Verdict::kTooOld;
    return bit(counter) ? Verdict::kDuplicate : Verdict::kLate;
  }
  Verdict record(std::uint64_t counter) noexcept { return record(counter, check(counter)); }
  /// @param v  what `check` returned, since when nothing was recorded
  Verdict record(std::uint64_t counter, Verdict v) noexcept {
    if (v == Verdict::kNewer) {
      const std::uint64_t first = any_ ? newest_ + 1 : counter;
      if (counter - first >= kSize) {
        bits_.fill(0);
      } else {
        for (std::uint64_t n = 0; n <= counter - first; ++n)
          clear(first + n);  // a loop on `c <= counter` would never end at 2^64 - 1
      }
      newest_ = counter;
      any_ = true;
    }
    if (v == Verdict::kNewer || v == Verdict::kLate) set(counter);
    return v;
  }
  [[nodiscard]] std::uint64_t newest() const noexcept { return newest_; }
  [[nodiscard]] bool any() const noexcept { return any_; }

 private:
  static constexpr std::size_t word(std::uint64_t c) noexcept { return (c % kSize) / 64; }
  static constexpr std::uint64_t mask(std::uint64_t c) noexcept { return std::uint64_t{1} << (c % 64); }
  [[nodiscard]] bool bit(std::uint64_t c) const noexcept { return (bits_[word(c)] & mask(c)) != 0; }
  void set(std::uint64_t c) noexcept { bits_[word(c)] |= mask(c); }
  void clear(std::uint64_t c) noexcept { bits_[word(c)] &= ~mask(c); }

  std::array<std::uint64_t, kSize / 64> bits_{};
  std::uint64_t newest_ = 0;
  bool any_ = false;
};

}  // namespace tandem::transport
