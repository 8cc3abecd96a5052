#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string_view>

#include "common/base/secret.h"
#include "proto/control_messages.h"

/// Control frames between structs and bytes. Total: any bytes give a message within its bounds, or an error; nothing is thrown but
/// bad_alloc, and nothing is logged.
namespace tandem::control {

inline constexpr std::size_t kLengthSize = 4;

enum class FrameError : std::uint8_t {
  kLength,      ///< longer than allowed, or empty
  kVersion,     ///< not a frame of version 1
  kMalformed,   ///< not the one encoding of a message of this schema
  kOutOfRange,  ///< a value that its bound in control_messages.h forbids
};
[[nodiscard]] std::string_view to_text(FrameError error) noexcept;

/// Length of the frame that follows these bytes [bytes], 1 ... `limit`.
[[nodiscard]] std::expected<std::size_t, FrameError> frame_length(std::span<const std::byte, kLengthSize> head, std::size_t limit = kFrameMax) noexcept;

/// Length and frame, ready to be sent. Wiped when it goes, since some frames carry secrets.
/// @return nothing if a value is out of its bounds: what would be refused is not sent
[[nodiscard]] std::expected<SecretBuffer, FrameError> encode(const Frame& frame);

/// What stands before a frame's payload.
struct Head {
  Kind kind = Kind::kDone;
  std::uint32_t request = 0;
  friend bool operator==(const Head&, const Head&) = default;
};
/// What a frame carries, without reading its payload.
[[nodiscard]] std::expected<Head, FrameError> peek(std::span<const std::byte> frame) noexcept;

/// @param frame  without its length
[[nodiscard]] std::expected<Frame, FrameError> decode(std::span<const std::byte> frame);

}  // namespace tandem::control
