#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>

/// Frames between a host and a Falcon with running firmware: 16 bytes each way, one reply per frame.
///   '<'  3 x 4 nibbles, least significant first  flags  spare  '>'
/// Every byte between the brackets is a value + 0x41. Brackets therefore never occur inside, and the start of a frame
/// can always be found.
/// Source: source code of public drivers; the meaning of single flag bits is not confirmed on hardware.
namespace tandem::hal {

inline constexpr std::size_t kFalconFrame = 16;
using FalconBytes = std::array<std::byte, kFalconFrame>;
/// Largest motor value observed in the vendor's traffic; the field could hold more.
inline constexpr std::int16_t kFalconMotorMax = 4095;

/// Bits of the flag byte, host to device. Public sources contradict each other: a comment has homing 0x10 and red,
/// green, blue 2, 4, 8.
/// Running code uses the values below. They are a table so that tests on hardware can correct them.
struct FalconFlagBits {
  std::uint8_t homing = 0x01;
  std::array<std::uint8_t, 3> light{0x02, 0x04, 0x08};  ///< green, blue, red
};

/// Host to device.
struct FalconCommand {
  std::array<std::int16_t, 3> motor{};  ///< counts; positive values pull the thighs in, see falcon_force.h
  bool homing = false;                  ///< search the origin; must be set in every frame
  std::uint8_t lights = 0;              ///< bit 0 green, 1 blue, 2 red
  friend bool operator==(const FalconCommand&, const FalconCommand&) = default;
};

/// Device to host.
struct FalconReply {
  std::array<std::int16_t, 3> encoder{};  ///< counts
  std::uint8_t buttons = 0;               ///< 1 plus (right), 2 forward, 4 centre, 8 minus (left)
  std::uint8_t homed = 0;                 ///< bit per leg
  friend bool operator==(const FalconReply&, const FalconReply&) = default;
};
inline constexpr std::uint8_t kFalconAllHomed = 0x07;

enum class FrameError : std::uint8_t { kBrackets, kNibble, kFlags };

[[nodiscard]] FalconBytes encode(const FalconCommand& command, const FalconFlagBits& bits = {}) noexcept;
[[nodiscard]] FalconBytes encode(const FalconReply& reply) noexcept;
[[nodiscard]] std::expected<FalconCommand, FrameError> decode_command(std::span<const std::byte, kFalconFrame> bytes,
                                                                      const FalconFlagBits& bits = {}) noexcept;
[[nodiscard]] std::expected<FalconReply, FrameError> decode_reply(
    std::span<const std::byte, kFalconFrame> bytes) noexcept;

/// Extracts frames from a byte stream that arrives in pieces of any size.
/// A frame is returned only if all of its 16 bytes followed its '<' without interruption. It never contains a byte of
/// an older frame.
class FalconFramer {
 public:
  /// Takes one byte. Returns the frame that it completes, valid until the next call.
  [[nodiscard]] std::optional<std::span<const std::byte, kFalconFrame>> push(std::byte byte) noexcept;
  /// Discards a partial frame: after a purge, a reset, a stall.
  void clear() noexcept { filled_ = 0; }
  /// Returns the number of bytes discarded since construction because they belonged to no complete frame.
  [[nodiscard]] std::uint64_t thrown_away() const noexcept { return thrown_away_; }
  [[nodiscard]] bool inside_frame() const noexcept { return filled_ > 0; }

 private:
  FalconBytes frame_{};
  std::size_t filled_ = 0;
  std::uint64_t thrown_away_ = 0;
};

}  // namespace tandem::hal
