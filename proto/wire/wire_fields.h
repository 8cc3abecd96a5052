#pragma once

#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "common/base/axes.h"

/// Private to proto/wire/wire_codec.cpp: writes and reads protobuf fields at fixed offsets. All fields of a body have
/// fixed widths, so each tag, length and value has a fixed offset. This takes a tenth of the instructions of a general
/// parser and serializer. The bytes remain Protocol Buffers; the tests WireTwin compare them with the library. One list
/// of fields per message serves both directions. Axis counts are numbers or constants (`std::integral_constant`), for
/// which loops unroll.
namespace tandem::wire {

static_assert(std::endian::native == std::endian::little, "values are copied as they lie in memory");

/// Wire type of a field, the low three bits of its tag. A nested message and bytes are encoded like a packed
/// array.
enum class Encoding : std::uint32_t { kFixed64 = 1, kPacked = 2, kFixed32 = 5 };
constexpr std::uint32_t tag(std::uint32_t number, Encoding encoding) noexcept {
  return number << 3 | static_cast<std::uint32_t>(encoding);
}

/// The varint of a tag or length, at most 2^14 - 1, in memory order.
constexpr bool one_byte(std::uint32_t value) noexcept { return value < 0x80; }
constexpr std::uint16_t two_bytes(std::uint32_t value) noexcept {
  return static_cast<std::uint16_t>((value & 0x7f) | 0x80 | (value >> 7) << 8);
}
/// Two varints of one byte each, in memory order.
constexpr std::uint16_t two_single_bytes(std::uint32_t first, std::uint32_t second) noexcept {
  return static_cast<std::uint16_t>(first | second << 8);
}

/// Writes a whole body without range checks; the receiver checks ranges. @pre the span has room for the body
class FieldWriter {
 public:
  explicit FieldWriter(std::span<std::byte> body) noexcept : at_(body.data()) {}

  template <std::size_t N, class Count>
  [[gnu::always_inline]] void doubles(std::uint32_t number, const std::array<double, N>& in, Count count,
                                      double) noexcept {
    array(number, 8 * count);
    copy(in.data(), count);
  }
  template <std::size_t N, class Count>
  [[gnu::always_inline]] void floats(std::uint32_t number, const std::array<double, N>& in, Count count,
                                     double) noexcept {
    array(number, 4 * count);
    for (std::size_t i = 0; i < count; ++i) put(static_cast<float>(in[i]));
  }
  template <class Count>
  [[gnu::always_inline]] void energies(std::uint32_t number, const EnergyArray& in, Count count,
                                       std::uint64_t) noexcept {
    array(number, 8 * count);
    copy(in.data(), count);
  }
  [[gnu::always_inline]] void number64(std::uint32_t number, double value, double, double) noexcept {
    structure(tag(number, Encoding::kFixed64));
    put(value);
  }
  [[gnu::always_inline]] void number32(std::uint32_t number, double value, double, double) noexcept {
    structure(tag(number, Encoding::kFixed32));
    put(static_cast<float>(value));
  }
  [[gnu::always_inline]] void word(std::uint32_t number, std::uint32_t value, std::uint32_t = 0) noexcept {
    structure(tag(number, Encoding::kFixed32));
    put(value);
  }
  template <std::size_t N>
  void words(std::uint32_t number, const std::array<std::uint32_t, N>& in, std::size_t count, std::uint32_t) noexcept {
    array(number, 4 * count);
    copy(in.data(), count);
  }
  void long_word(std::uint32_t number, std::uint64_t value) noexcept {
    structure(tag(number, Encoding::kFixed64));
    put(value);
  }

  void message(std::uint32_t number, std::size_t bytes) noexcept { array(number, bytes); }
  /// Writes a field of `count` zeros.
  void zeros(std::uint32_t number, std::size_t count) noexcept {
    array(number, count);
    std::memset(at_, 0, count);
    at_ += count;
  }
  void singles(std::uint32_t number, const std::array<float, 3>& in, float) noexcept {
    array(number, sizeof in);
    copy(in.data(), in.size());
  }
  void single(std::uint32_t number, float value, float) noexcept {
    structure(tag(number, Encoding::kFixed32));
    put(value);
  }

 private:
  [[gnu::always_inline]] void structure(std::uint32_t value) noexcept {
    if (one_byte(value)) {
      put(static_cast<std::uint8_t>(value));
    } else {
      put(two_bytes(value));
    }
  }
  [[gnu::always_inline]] void array(std::uint32_t number, std::size_t bytes) noexcept {
    const std::uint32_t key = tag(number, Encoding::kPacked), length = static_cast<std::uint32_t>(bytes);
    if (one_byte(key) && one_byte(length)) {
      put(two_single_bytes(key, length));
    } else {
      structure(key);
      structure(length);
    }
  }
  template <class T>
  [[gnu::always_inline]] void put(T value) noexcept {
    std::memcpy(at_, &value, sizeof value);
    at_ += sizeof value;
  }
  template <class T, class Count>
  [[gnu::always_inline]] void copy(const T* from, Count count) noexcept {
    std::memcpy(at_, from, sizeof(T) * count);
    at_ += sizeof(T) * count;
  }

  std::byte* at_;
};

/// Reads the values of a body and records format, finiteness and range errors. @pre the span has the size of this
/// message
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> body) noexcept : at_(body.data()) {}

  template <std::size_t N, class Count>
  [[gnu::always_inline]] void doubles(std::uint32_t number, std::array<double, N>& out, Count count,
                                      double limit) noexcept {
    array(number, 8 * count);
    copy(out.data(), count);
    judge(out, count, limit);
  }
  template <std::size_t N, class Count>
  [[gnu::always_inline]] void floats(std::uint32_t number, std::array<double, N>& out, Count count,
                                     double limit) noexcept {
    array(number, 4 * count);
    for (std::size_t i = 0; i < count; ++i) out[i] = static_cast<double>(get<float>());
    judge(out, count, limit);
  }
  template <class Count>
  [[gnu::always_inline]] void energies(std::uint32_t number, EnergyArray& out, Count count,
                                       std::uint64_t limit) noexcept {
    array(number, 8 * count);
    copy(out.data(), count);
    for (std::size_t i = 0; i < count; ++i) in_range_ &= out[i] <= limit;
  }
  [[gnu::always_inline]] void number64(std::uint32_t number, double& out, double low, double high) noexcept {
    structure(tag(number, Encoding::kFixed64));
    out = get<double>();
    judge(out, low, high);
  }
  [[gnu::always_inline]] void number32(std::uint32_t number, double& out, double low, double high) noexcept {
    structure(tag(number, Encoding::kFixed32));
    out = static_cast<double>(get<float>());
    judge(out, low, high);
  }
  [[gnu::always_inline]] void word(std::uint32_t number, std::uint32_t& out,
                                   std::uint32_t limit = ~std::uint32_t{0}) noexcept {
    structure(tag(number, Encoding::kFixed32));
    out = get<std::uint32_t>();
    in_range_ &= out <= limit;
  }
  /// @param limit  largest value
  template <std::size_t N>
  void words(std::uint32_t number, std::array<std::uint32_t, N>& out, std::size_t count, std::uint32_t limit) noexcept {
    array(number, 4 * count);
    copy(out.data(), count);
    for (std::size_t i = 0; i < count; ++i) in_range_ &= out[i] <= limit;
  }
  void long_word(std::uint32_t number, std::uint64_t& out) noexcept {
    structure(tag(number, Encoding::kFixed64));
    out = get<std::uint64_t>();
  }

  void message(std::uint32_t number, std::size_t bytes) noexcept { array(number, bytes); }
  void zeros(std::uint32_t number, std::size_t count) noexcept {
    array(number, count);
    for (std::size_t i = 0; i < count; ++i) differs_ |= get<std::uint8_t>();
  }
  /// @param limit  largest magnitude
  void singles(std::uint32_t number, std::array<float, 3>& out, float limit) noexcept {
    array(number, sizeof out);
    copy(out.data(), out.size());
    for (const float value : out) judge(static_cast<double>(value), -limit, limit);
  }
  /// Reads a value in [0, limit].
  void single(std::uint32_t number, float& out, float limit) noexcept {
    structure(tag(number, Encoding::kFixed32));
    out = get<float>();
    judge(static_cast<double>(out), 0, limit);
  }

  void require(bool condition) noexcept { in_range_ &= condition; }
  /// Whether all tags and lengths are those of this message: no unknown, missing, repeated or reordered fields, no
  /// wrong lengths.
  [[nodiscard]] bool well_formed() const noexcept { return differs_ == 0; }
  [[nodiscard]] bool in_range() const noexcept { return in_range_; }
  [[nodiscard]] bool finite() const noexcept { return finite_; }

 private:
  /// Accumulates differences without a branch: one branch per field costs more than all comparisons.
  [[gnu::always_inline]] void structure(std::uint32_t value) noexcept {
    if (one_byte(value)) {
      differs_ |= get<std::uint8_t>() ^ value;
    } else {
      differs_ |= static_cast<std::uint32_t>(get<std::uint16_t>() ^ two_bytes(value));
    }
  }
  [[gnu::always_inline]] void array(std::uint32_t number, std::size_t bytes) noexcept {
    const std::uint32_t key = tag(number, Encoding::kPacked), length = static_cast<std::uint32_t>(bytes);
    if (one_byte(key) && one_byte(length)) {
      differs_ |= static_cast<std::uint32_t>(get<std::uint16_t>() ^ two_single_bytes(key, length));
    } else {
      structure(key);
      structure(length);
    }
  }
  template <class T>
  [[gnu::always_inline]] T get() noexcept {
    T value;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    return value;
  }
  template <class T, class Count>
  [[gnu::always_inline]] void copy(T* to, Count count) noexcept {
    std::memcpy(to, at_, sizeof(T) * count);
    at_ += sizeof(T) * count;
  }
  template <std::size_t N, class Count>
  [[gnu::always_inline]] void judge(const std::array<double, N>& values, Count count, double limit) noexcept {
    bool good = true;
    for (std::size_t i = 0; i < count; ++i) good &= std::abs(values[i]) <= limit;  // false for NaN
    if (good) [[likely]]
      return;
    in_range_ = false;
    for (std::size_t i = 0; i < count; ++i) finite_ = finite_ && std::isfinite(values[i]);
  }
  [[gnu::always_inline]] void judge(double value, double low, double high) noexcept {
    if (!(value >= low && value <= high)) [[unlikely]] {  // also true for NaN
      in_range_ = false;
      finite_ = finite_ && std::isfinite(value);
    }
  }

  const std::byte* at_;
  std::uint32_t differs_ = 0;
  bool in_range_ = true, finite_ = true;
};

}  // namespace tandem::wire
