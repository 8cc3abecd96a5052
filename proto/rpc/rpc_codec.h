#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string_view>

#include "common/base/secret.h"
#include "proto/rpc/rpc_messages.h"

/// Codec between control frames and structs. Total: any input gives a message within its bounds, or an error. It throws
/// only bad_alloc and logs nothing.
namespace tandem::rpc {

inline constexpr std::size_t kLengthSize = 4;

enum class FrameError : std::uint8_t {
  kLength,      ///< empty, or longer than allowed
  kVersion,     ///< not a frame of version 1
  kMalformed,   ///< not the unique encoding of a message of this schema
  kOutOfRange,  ///< a value outside its bound in rpc_messages.h
};
[[nodiscard]] std::string_view to_text(FrameError error) noexcept;

/// Length of the frame that follows these bytes, 1 ... `limit` [bytes].
[[nodiscard]] std::expected<std::size_t, FrameError> frame_length(std::span<const std::byte, kLengthSize> head,
                                                                  std::size_t limit = kFrameMax) noexcept;

/// Encodes length and frame. The buffer is wiped on destruction, since some frames carry secrets.
/// @return the bytes, or an error if a value is out of its bounds: a frame that the receiver would reject is not sent
[[nodiscard]] std::expected<SecretBuffer, FrameError> encode(const Frame& frame);

/// The part of a frame before its payload.
struct Head {
  Kind kind = Kind::kOk;
  std::uint32_t request = 0;
  friend bool operator==(const Head&, const Head&) = default;
};
/// Reads message kind and request number of a frame without its payload.
[[nodiscard]] std::expected<Head, FrameError> peek(std::span<const std::byte> frame) noexcept;

/// Decodes a frame. @param frame  without its length
[[nodiscard]] std::expected<Frame, FrameError> decode(std::span<const std::byte> frame);

}  // namespace tandem::rpc
