#pragma once

#include <algorithm>
#include <atomic>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <memory>
#include <span>

namespace tandem {

/// Bounded stream of bytes from one writing thread to one reading thread, without lock and without heap use after
/// construction. The writer decides what to do if the ring is full; the reader sees bytes only after `publish`. Each
/// reserved piece lies in one piece in memory; zeros may lie between two pieces, so no piece may begin with a zero.
class ByteRing {
 public:
  /// @param capacity  least number of bytes that the ring holds; rounded up to a power of two, at least 64
  explicit ByteRing(std::size_t capacity)
      : bytes_(std::make_unique<std::byte[]>(std::bit_ceil(std::max<std::size_t>(64, capacity)))),
        mask_(std::bit_ceil(std::max<std::size_t>(64, capacity)) - 1) {}

  [[nodiscard]] std::size_t capacity() const noexcept { return mask_ + 1; }

  // ---- The writing thread ----
  /// Memory for the next `size` bytes, in one piece; null if the ring is full, or smaller. Where the piece does not fit
  /// before the end of the ring's memory, zeros fill the rest of it, and become part of the stream.
  [[nodiscard]] std::byte* reserve(std::size_t size) noexcept {
    const std::size_t at = end_ & mask_;
    if (at + size > mask_ + 1) [[unlikely]]
      return reserve_at_begin(size);
    return fits(size) ? &bytes_[at] : nullptr;
  }
  /// Appends the bytes that were written to reserved memory. @pre reserve(size) was called
  void commit(std::size_t size) noexcept { end_ += size; }
  /// Shows all bytes so far to the reader.
  void publish() noexcept { published_.store(end_, std::memory_order_release); }

  // ---- The reading thread ----
  /// Moves the oldest published bytes to the begin of `out`. @return their number; 0: there is none
  [[nodiscard]] std::size_t take(std::span<std::byte> out) noexcept {
    const std::uint64_t begin = begin_.load(std::memory_order_relaxed);
    const std::uint64_t there = published_.load(std::memory_order_acquire) - begin;
    const auto size = static_cast<std::size_t>(std::min<std::uint64_t>(there, out.size()));
    const std::size_t at = begin & mask_;
    const std::size_t first = std::min(size, mask_ + 1 - at);
    if (first > 0) std::memcpy(out.data(), &bytes_[at], first);
    if (first < size) std::memcpy(out.data() + first, &bytes_[0], size - first);
    begin_.store(begin + size, std::memory_order_release);
    return size;
  }
  /// Number of bytes that the reader has taken so far.
  [[nodiscard]] std::uint64_t taken() const noexcept { return begin_.load(std::memory_order_relaxed); }

 private:
  [[nodiscard]] bool fits(std::size_t size) noexcept {
    if (end_ + size - known_begin_ <= mask_ + 1) [[likely]]
      return true;
    known_begin_ = begin_.load(std::memory_order_acquire);
    return end_ + size - known_begin_ <= mask_ + 1;
  }
  [[nodiscard]] std::byte* reserve_at_begin(std::size_t size) noexcept {
    const std::size_t at = end_ & mask_, rest = mask_ + 1 - at;
    if (!fits(rest + size)) return nullptr;
    std::memset(&bytes_[at], 0, rest);
    end_ += rest;
    return &bytes_[0];
  }

  std::unique_ptr<std::byte[]> bytes_;
  std::size_t mask_;
  std::uint64_t end_ = 0, known_begin_ = 0;  ///< of the writer: bytes so far; bytes that the reader had taken
  alignas(64) std::atomic<std::uint64_t> published_{0};
  alignas(64) std::atomic<std::uint64_t> begin_{0};
};

}  // namespace tandem
