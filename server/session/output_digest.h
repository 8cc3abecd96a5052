#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Running hash of everything that was sent to a seat: types and plaintexts, in order. Two streams that differ in one
/// word have different hashes from then on; others by chance in 2^32. It is no defence against forgery.
class OutputDigest {
 public:
  void add(wire::Type type, std::span<const std::byte> plaintext) noexcept {
    const std::byte* at = plaintext.data();
    std::size_t left = plaintext.size();
    std::uint64_t h = static_cast<std::uint64_t>(type) << 32 | left;
    for (; left >= 4 * sizeof(std::uint64_t); left -= 4 * sizeof(std::uint64_t), at += 4 * sizeof(std::uint64_t))
      h = step(step(step(step(h, word(at)), word(at + 8)), word(at + 16)), word(at + 24));
    for (; left >= sizeof(std::uint64_t); left -= sizeof(std::uint64_t), at += sizeof(std::uint64_t))
      h = step(h, word(at));
    if (left > 0) h = step(h, last_word(plaintext));
    value_ = std::rotl(value_ ^ h, 29) * kFactor;
    sent_ = true;
  }
  /// Hash of all messages so far.
  [[nodiscard]] std::uint32_t value() const noexcept { return static_cast<std::uint32_t>(value_ >> 32); }
  /// A message was added since `clear_sent`.
  [[nodiscard]] bool sent() const noexcept { return sent_; }
  void clear_sent() noexcept { sent_ = false; }

 private:
  /// Every word of a message has another rotation, so that equal changes of two words do not cancel.
  static std::uint64_t step(std::uint64_t h, std::uint64_t word) noexcept { return std::rotl(h, 13) ^ word; }
  static std::uint64_t word(const std::byte* at) noexcept {
    std::uint64_t value;
    std::memcpy(&value, at, sizeof value);
    return value;
  }
  /// The last eight bytes, or all of a shorter text.
  static std::uint64_t last_word(std::span<const std::byte> text) noexcept {
    if (text.size() >= sizeof(std::uint64_t)) return word(text.data() + text.size() - sizeof(std::uint64_t));
    std::uint64_t value = 0;
    std::memcpy(&value, text.data(), text.size());
    return value;
  }

  static constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15ULL;  ///< odd: no information is lost

  std::uint64_t value_ = 0;
  bool sent_ = false;
};

}  // namespace tandem::server
