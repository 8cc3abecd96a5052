#pragma once

#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <limits>
#include <span>
#include <string>
#include <string_view>

#include "common/base/axes.h"

/// Fields of protobuf messages, written and read without the library: a recording has millions of messages of few
/// numbers. tests/proto/recording compares both ways with the library.
namespace tandem::rec {

static_assert(std::endian::native == std::endian::little, "fixed-width fields are copied as they are in memory");

enum class FieldType : std::uint8_t { kVarint = 0, kFixed64 = 1, kBytes = 2, kFixed32 = 5 };

/// Nearest number in single precision; infinity beyond its range.
[[nodiscard]] inline float to_single(double value) noexcept {
  constexpr double kMax = std::numeric_limits<float>::max();
  if (std::abs(value) > kMax)
    return std::copysign(std::numeric_limits<float>::infinity(), static_cast<float>(value > 0 ? 1 : -1));
  return static_cast<float>(value);
}
/// The number in single precision has all bits of this one.
[[nodiscard]] inline bool is_single(double value) noexcept {
  return std::bit_cast<std::uint64_t>(static_cast<double>(to_single(value))) == std::bit_cast<std::uint64_t>(value);
}

/// Nearest number in single precision whose last 8 bits are 0: 16 significant bits. Infinity and NaN stay.
[[nodiscard]] inline float to_short(double value) noexcept {
  const float single = to_single(value);
  if (!std::isfinite(single)) return single;
  const auto bits = std::bit_cast<std::uint32_t>(single);
  return std::bit_cast<float>((bits + 0x7f + (bits >> 8 & 1)) & 0xffffff00);
}

/// Appends the fields of a message. Numbers of fields are below 16, so a tag has one byte.
class FieldWriter {
 public:
  explicit FieldWriter(std::string& out) noexcept : out_(&out) {}
  void number(unsigned field, double value) {
    tag(field, FieldType::kFixed64);
    raw(value);
  }
  void fixed32(unsigned field, std::uint32_t value) {
    tag(field, FieldType::kFixed32);
    raw(value);
  }
  /// Omits a value of 0, which is the default.
  void varint(unsigned field, std::uint64_t value) {
    if (value == 0) return;
    tag(field, FieldType::kVarint);
    put_varint(value);
  }
  /// Appends a message tandem.recording.Vector3 or Joints. @pre at most 10 values
  void numbers(unsigned field, std::span<const double> values) {
    bool exact = true;
    for (const double value : values) exact &= is_single(value);
    const std::size_t size = 2 + 4 * values.size() + (exact ? 0 : 2 + 8 * values.size());
    tag(field, FieldType::kBytes);
    put_varint(size);
    singles(1, values);
    if (!exact) packed(2, values);
  }
  /// Appends packed values in single precision.
  void singles(unsigned field, std::span<const double> values) {
    tag(field, FieldType::kBytes);
    put_varint(4 * values.size());
    for (const double value : values) raw(to_single(value));
  }
  /// Appends packed values of eight bytes each.
  template <class Value>
  void packed(unsigned field, std::span<const Value> values) {
    static_assert(sizeof(Value) == 8);
    if (values.empty()) return;
    tag(field, FieldType::kBytes);
    put_varint(values.size_bytes());
    for (const Value value : values) raw(value);
  }
  void bytes(unsigned field, std::string_view value) {
    tag(field, FieldType::kBytes);
    put_varint(value.size());
    out_->append(value);
  }
  /// Appends the message that `fields` writes. @pre its size is below 16 384 bytes
  template <class Fields>
  void message(unsigned field, Fields fields) {
    tag(field, FieldType::kBytes);
    const std::size_t at = out_->size();
    out_->append(2, '\0');  // a varint of two bytes, also for small sizes
    fields(*this);
    const std::size_t size = out_->size() - at - 2;
    (*out_)[at] = static_cast<char>((size & 0x7f) | 0x80);
    (*out_)[at + 1] = static_cast<char>(size >> 7);
  }

 private:
  void tag(unsigned field, FieldType type) { *out_ += static_cast<char>(field << 3 | static_cast<unsigned>(type)); }
  void put_varint(std::uint64_t value) {
    while (value >= 0x80) {
      *out_ += static_cast<char>(value | 0x80);
      value >>= 7;
    }
    *out_ += static_cast<char>(value);
  }
  template <class Value>
  void raw(Value value) {
    char bytes[sizeof value];
    std::memcpy(bytes, &value, sizeof value);
    out_->append(bytes, sizeof value);
  }
  std::string* out_;
};

/// One field of a message. Which members are set depends on its type.
struct Field {
  std::uint32_t number = 0;
  FieldType type = FieldType::kVarint;
  std::uint64_t value = 0;           ///< kVarint, kFixed32, kFixed64
  std::span<const std::byte> bytes;  ///< kBytes

  /// Value of a double; 0 for a field of another type.
  [[nodiscard]] double number_value() const noexcept {
    return type == FieldType::kFixed64 ? std::bit_cast<double>(value) : 0;
  }
  /// Value of a float; 0 for a field of another type.
  [[nodiscard]] double single_value() const noexcept {
    return type == FieldType::kFixed32 ? std::bit_cast<float>(static_cast<std::uint32_t>(value)) : 0;
  }
};

/// Reads the fields of a message from untrusted bytes.
class FieldScanner {
 public:
  explicit FieldScanner(std::span<const std::byte> bytes) noexcept : at_(bytes.data()), end_(at_ + bytes.size()) {}
  /// Reads the next field into `field`. @return false at the end, and from the first field on that is damaged
  [[nodiscard]] bool next(Field& field) noexcept {
    if (at_ == end_) return false;
    std::uint64_t tag = 0;
    if (!varint(tag) || tag >> 3 == 0 || tag >> 3 > 0x1fffffff) return fail();
    field.number = static_cast<std::uint32_t>(tag >> 3);
    field.value = 0;
    field.bytes = {};
    field.type = static_cast<FieldType>(tag & 7);
    switch (field.type) {
      case FieldType::kVarint:
        return varint(field.value) || fail();
      case FieldType::kFixed64:
        return fixed<std::uint64_t>(field.value) || fail();
      case FieldType::kFixed32:
        return fixed<std::uint32_t>(field.value) || fail();
      case FieldType::kBytes: {
        std::uint64_t size = 0;
        if (!varint(size) || size > static_cast<std::size_t>(end_ - at_)) return fail();
        field.bytes = {at_, static_cast<std::size_t>(size)};
        at_ += size;
        return true;
      }
    }
    return fail();  // groups, which proto3 has not
  }
  /// All fields so far were whole.
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  [[nodiscard]] bool fail() noexcept {
    ok_ = false;
    at_ = end_;
    return false;
  }
  [[nodiscard]] bool varint(std::uint64_t& value) noexcept {
    value = 0;
    for (unsigned shift = 0; shift < 64 && at_ != end_; shift += 7) {
      const auto byte = std::to_integer<std::uint64_t>(*at_++);
      value |= (byte & 0x7f) << shift;
      if (byte < 0x80) return true;
    }
    return false;
  }
  template <class Value>
  [[nodiscard]] bool fixed(std::uint64_t& out) noexcept {
    Value value = 0;
    if (static_cast<std::size_t>(end_ - at_) < sizeof value) return false;
    std::memcpy(&value, at_, sizeof value);
    at_ += sizeof value;
    out = value;
    return true;
  }
  const std::byte *at_, *end_;
  bool ok_ = true;
};

}  // namespace tandem::rec
