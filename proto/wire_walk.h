#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "common/base/axes.h"

/// Private to proto/wire_codec.cpp. A body whose fields all have fixed widths has each value at a fixed place (Skeleton holds the bytes
/// between them), so values are copied in and out where they stand: a fifth of the instructions that a general parser and serializer
/// take, and the wire stays Protocol Buffers (WireTwin proves it against the library). One list of fields per message serves both ways.
namespace tandem::wire {

/// Where the values of a body stand, one after the other.
template <class Byte>
class Places {
 public:
  explicit Places(std::span<Byte> body) noexcept : at_(body.data()) {}

 protected:
  static constexpr std::size_t tag(unsigned number) noexcept { return number < 16 ? 1 : 2; }
  Byte* scalar(unsigned number, std::size_t width) noexcept { return pass(tag(number), width); }
  /// Elements of a packed array, behind tag and length.
  Byte* array(unsigned number, std::size_t bytes) noexcept { return pass(tag(number) + (bytes < 128 ? 1 : 2), bytes); }

 private:
  Byte* pass(std::size_t before, std::size_t width) noexcept {
    Byte* const here = at_ + before;
    at_ = here + width;
    return here;
  }
  Byte* at_;
};

/// Puts values into a body that has the skeleton already. Limits are the receiver's business.
class ValueWriter : public Places<std::byte> {
 public:
  using Places::Places;

  template <std::size_t N>
  void doubles(unsigned number, const std::array<double, N>& in, std::size_t count, double) noexcept {
    std::memcpy(array(number, 8 * count), in.data(), 8 * count);
  }
  template <std::size_t N>
  void floats(unsigned number, const std::array<double, N>& in, std::size_t count, double) noexcept {
    std::byte* to = array(number, 4 * count);
    for (std::size_t i = 0; i < count; ++i, to += 4) put(to, static_cast<float>(in[i]));
  }
  void energies(unsigned number, const EnergyArray& in, std::size_t count, std::uint64_t) noexcept {
    std::memcpy(array(number, 8 * count), in.data(), 8 * count);
  }
  void number64(unsigned number, double value, double, double) noexcept { put(scalar(number, 8), value); }
  void number32(unsigned number, double value, double, double) noexcept { put(scalar(number, 4), static_cast<float>(value)); }
  void word(unsigned number, std::uint32_t value, std::uint32_t = 0) noexcept { put(scalar(number, 4), value); }
  void long_word(unsigned number, std::uint64_t value) noexcept { put(scalar(number, 8), value); }

 private:
  template <class T>
  static void put(std::byte* to, T value) noexcept {
    std::memcpy(to, &value, sizeof value);
  }
};

/// Takes values out of a body that has the skeleton, and remembers the worst thing seen.
class ValueReader : public Places<const std::byte> {
 public:
  using Places::Places;

  template <std::size_t N>
  void doubles(unsigned number, std::array<double, N>& out, std::size_t count, double limit) noexcept {
    std::memcpy(out.data(), array(number, 8 * count), 8 * count);
    judge(out, count, limit);
  }
  template <std::size_t N>
  void floats(unsigned number, std::array<double, N>& out, std::size_t count, double limit) noexcept {
    const std::byte* from = array(number, 4 * count);
    for (std::size_t i = 0; i < count; ++i, from += 4) out[i] = static_cast<double>(get<float>(from));
    judge(out, count, limit);
  }
  void energies(unsigned number, EnergyArray& out, std::size_t count, std::uint64_t limit) noexcept {
    std::memcpy(out.data(), array(number, 8 * count), 8 * count);
    for (std::size_t i = 0; i < count; ++i) in_range_ &= out[i] <= limit;
  }
  void number64(unsigned number, double& out, double low, double high) noexcept {
    out = get<double>(scalar(number, 8));
    judge(out, low, high);
  }
  void number32(unsigned number, double& out, double low, double high) noexcept {
    out = static_cast<double>(get<float>(scalar(number, 4)));
    judge(out, low, high);
  }
  void word(unsigned number, std::uint32_t& out, std::uint32_t limit = ~std::uint32_t{0}) noexcept {
    out = get<std::uint32_t>(scalar(number, 4));
    in_range_ &= out <= limit;
  }
  void long_word(unsigned number, std::uint64_t& out) noexcept { out = get<std::uint64_t>(scalar(number, 8)); }

  void require(bool condition) noexcept { in_range_ &= condition; }
  [[nodiscard]] bool in_range() const noexcept { return in_range_; }
  [[nodiscard]] bool finite() const noexcept { return finite_; }

 private:
  template <class T>
  static T get(const std::byte* from) noexcept {
    T value;
    std::memcpy(&value, from, sizeof value);
    return value;
  }
  template <std::size_t N>
  void judge(const std::array<double, N>& values, std::size_t count, double limit) noexcept {
    bool good = true;  // judged together: a branch for each costs more than the numbers
    for (std::size_t i = 0; i < count; ++i) good &= std::abs(values[i]) <= limit;  // false for NaN
    if (good) [[likely]]
      return;
    in_range_ = false;
    for (std::size_t i = 0; i < count; ++i) finite_ = finite_ && std::isfinite(values[i]);
  }
  void judge(double value, double low, double high) noexcept {
    if (!(value >= low && value <= high)) [[unlikely]] {  // also true for NaN
      in_range_ = false;
      finite_ = finite_ && std::isfinite(value);
    }
  }

  bool in_range_ = true, finite_ = true;
};

}  // namespace tandem::wire
