#pragma once

#include <bit>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/base/raw_bytes.h"
#include "common/mcap/mcap_records.h"

/// Fields of MCAP records: little-endian integers and texts with a length of 32 bits.
namespace tandem::mcap {

static_assert(std::endian::native == std::endian::little, "the fields of a record are copied as they are in memory");

/// Appends the fields of a record to a text.
template <std::unsigned_integral Value>
void put(std::string& out, Value value) {
  char bytes[sizeof value];
  std::memcpy(bytes, &value, sizeof value);
  out.append(bytes, sizeof value);
}
/// @pre text.size() < 2^32
inline void put_text(std::string& out, std::string_view text) {
  put(out, static_cast<std::uint32_t>(text.size()));
  out.append(text);
}
/// Begins a record of unknown length. @return where it begins; pass it to `end_record`
[[nodiscard]] inline std::size_t begin_record(std::string& out, Opcode opcode) {
  const std::size_t at = out.size();
  out += static_cast<char>(opcode);
  put(out, std::uint64_t{0});
  return at;
}
/// Sets the length of the record that begins at `at` and ends at the end of `out`.
inline void end_record(std::string& out, std::size_t at) {
  const std::uint64_t length = out.size() - at - kRecordHead;
  std::memcpy(out.data() + at + 1, &length, sizeof length);
}
/// Appends a map whose entries `entry` appends.
template <class Map, class Entry>
void put_map(std::string& out, const Map& map, Entry entry) {
  const std::size_t at = out.size();
  put(out, std::uint32_t{0});
  for (const auto& [key, value] : map) entry(key, value);
  const auto length = static_cast<std::uint32_t>(out.size() - at - sizeof(std::uint32_t));
  std::memcpy(out.data() + at, &length, sizeof length);
}

/// Reads fields from the front of a buffer. After the first field that does not fit, `ok` is false and every value is
/// 0 or empty.
class FieldReader {
 public:
  explicit FieldReader(std::span<const std::byte> bytes) noexcept : rest_(bytes) {}
  template <std::unsigned_integral Value>
  [[nodiscard]] Value number() noexcept {
    Value value = 0;
    const auto bytes = take(sizeof value);
    if (ok_) std::memcpy(&value, bytes.data(), sizeof value);
    return value;
  }
  /// Returns the next `size` bytes, inside the buffer.
  [[nodiscard]] std::span<const std::byte> take(std::uint64_t size) noexcept {
    if (!ok_ || size > rest_.size()) {
      ok_ = false;
      return {};
    }
    const auto taken = rest_.first(static_cast<std::size_t>(size));
    rest_ = rest_.subspan(taken.size());
    return taken;
  }
  [[nodiscard]] std::string_view text() noexcept { return text_of(take(number<std::uint32_t>())); }
  [[nodiscard]] std::span<const std::byte> rest() const noexcept { return rest_; }
  [[nodiscard]] bool empty() const noexcept { return rest_.empty(); }
  [[nodiscard]] bool ok() const noexcept { return ok_; }

 private:
  std::span<const std::byte> rest_;
  bool ok_ = true;
};

}  // namespace tandem::mcap
