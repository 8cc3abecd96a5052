#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>
#include <type_traits>

/// Private to proto/wire_messages.cpp.
namespace tandem::wire {

enum class Bits : std::uint8_t { kZeros, kOnes };

/// A value of type T all bits of which are 0, or 1 (a quiet NaN for floating point, which moves keep as it is).
template <class T>
T of(Bits bits) noexcept {
  std::array<unsigned char, sizeof(T)> raw;
  raw.fill(bits == Bits::kZeros ? 0x00 : 0xff);
  return std::bit_cast<T>(raw);
}
template <class Repeated>
void fill(Repeated& array, std::size_t count, Bits bits) noexcept {
  using Element = std::remove_reference_t<decltype(*array.mutable_data())>;
  array.Resize(static_cast<int>(count), Element{});
  for (std::size_t i = 0; i < count; ++i) array.mutable_data()[i] = of<Element>(bits);
}

/// The bytes of a message that are not values: tags and lengths. Where every field has a fixed width, they stand at
/// fixed places with fixed values, so bytes that differ there are no such message. Comparing costs some ten nanoseconds
/// and leaves nothing else to reject: no unknown, missing, repeated or reordered fields, no lengths that lie.
template <std::size_t N>
class Skeleton {
 public:
  Skeleton() = default;
  /// From two encodings that differ in every bit of every value. @pre equal sizes, at most N
  Skeleton(std::span<const std::uint8_t> zeros, std::span<const std::uint8_t> ones) noexcept : size_(zeros.size()) {
    for (std::size_t i = 0; i < size_; ++i) {
      bytes_[i] = zeros[i];
      mask_[i] = zeros[i] == ones[i] ? 0xff : 0x00;
      bytes_[i] &= mask_[i];
    }
  }

  [[nodiscard]] std::size_t size() const noexcept { return size_; }
  /// The message with all values zero.
  [[nodiscard]] std::span<const std::uint8_t> bytes() const noexcept { return std::span{bytes_}.first(size_); }
  /// @pre bytes.size() == size()
  [[nodiscard]] bool matches(std::span<const std::byte> bytes) const noexcept {
    // Eight bytes at a time: this is half of what decoding costs otherwise.
    std::uint64_t difference = size_ == 0 ? 1 : 0;
    std::size_t i = 0;
    for (; i + 8 <= size_; i += 8) {
      std::uint64_t seen, mask, expected;
      std::memcpy(&seen, bytes.data() + i, 8);
      std::memcpy(&mask, mask_.data() + i, 8);
      std::memcpy(&expected, bytes_.data() + i, 8);
      difference |= (seen & mask) ^ expected;
    }
    for (; i < size_; ++i)
      difference |= static_cast<std::uint64_t>((static_cast<std::uint8_t>(bytes[i]) & mask_[i]) ^ bytes_[i]);
    return difference == 0;
  }

 private:
  std::size_t size_ = 0;
  std::array<std::uint8_t, N> bytes_{};
  std::array<std::uint8_t, N> mask_{};
};

}  // namespace tandem::wire
