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
/// construction. The writer decides what to do if the ring is full; the reader sees bytes only after `publish`.
class ByteRing {
 public:
  /// @param capacity  least number of bytes that the ring holds; rounded up to a power of two, at least 64
  explicit ByteRing(std::size_t capacity)
      : bytes_(std::make_unique<std::byte[]>(std::bit_ceil(std::max<std::size_t>(64, capacity)))),
        mask_(std::bit_ceil(std::max<std::size_t>(64, capacity)) - 1) {}

  [[nodiscard]] std::size_t capacity() const noexcept { return mask_ + 1; }

  // ---- The writing thread ----
  /// Whether `put` of this many bytes is possible now.
  [[nodiscard]] bool fits(std::size_t size) noexcept {
    if (end_ + size - known_begin_ <= mask_ + 1) return true;
    known_begin_ = begin_.load(std::memory_order_acquire);
    return end_ + size - known_begin_ <= mask_ + 1;
  }
  /// Appends bytes. @pre fits(bytes.size())
  void put(std::span<const std::byte> bytes) noexcept {
    const std::size_t at = end_ & mask_;
    const std::size_t first = std::min(bytes.size(), mask_ + 1 - at);
    std::memcpy(&bytes_[at], bytes.data(), first);
    if (first < bytes.size()) [[unlikely]]
      std::memcpy(&bytes_[0], bytes.data() + first, bytes.size() - first);
    end_ += bytes.size();
  }
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
  std::unique_ptr<std::byte[]> bytes_;
  std::size_t mask_;
  std::uint64_t end_ = 0, known_begin_ = 0;  ///< of the writer: bytes so far; bytes that the reader had taken
  alignas(64) std::atomic<std::uint64_t> published_{0};
  alignas(64) std::atomic<std::uint64_t> begin_{0};
};

}  // namespace tandem
