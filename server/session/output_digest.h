#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <span>

#include "common/base/rng.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

/// Running hash of everything that was sent to a seat: types and plaintexts, in order. Two streams that differ in one
/// word have different hashes from then on; others by chance in 2^32. It is no defence against forgery.
class OutputDigest {
 public:
  void add(wire::Type type, std::span<const std::byte> plaintext) noexcept {
    std::uint64_t h = value_ ^ (static_cast<std::uint64_t>(type) << 32 | plaintext.size());
    const std::byte* at = plaintext.data();
    std::size_t left = plaintext.size();
    std::uint64_t word = 0;
    for (; left >= sizeof word; left -= sizeof word, at += sizeof word) {
      std::memcpy(&word, at, sizeof word);
      h = std::rotl(h ^ word, 29) * kFactor;
    }
    if (left > 0) {
      word = 0;
      std::memcpy(&word, at, left);
      h = std::rotl(h ^ word, 29) * kFactor;
    }
    value_ = h;
    sent_ = true;
  }
  /// Hash of all messages so far.
  [[nodiscard]] std::uint32_t value() const noexcept { return static_cast<std::uint32_t>(mix64(value_) >> 32); }
  /// A message was added since `clear_sent`.
  [[nodiscard]] bool sent() const noexcept { return sent_; }
  void clear_sent() noexcept { sent_ = false; }

 private:
  static constexpr std::uint64_t kFactor = 0x9e3779b97f4a7c15ULL;  ///< odd: no information is lost

  std::uint64_t value_ = 0;
  bool sent_ = false;
};

}  // namespace tandem::server
