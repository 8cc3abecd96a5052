#include "hal/drivers/falcon/falcon_frame.h"

namespace tandem::hal {
namespace {

constexpr std::byte kOpen{'<'}, kClose{'>'};
constexpr unsigned kOffset = 0x41;  // 'A'
constexpr std::size_t kFlags = 13, kSpare = 14, kLast = 15;

constexpr unsigned value(std::byte b) noexcept { return std::to_integer<unsigned>(b) - kOffset; }
constexpr std::byte coded(unsigned v) noexcept { return static_cast<std::byte>(v + kOffset); }

void put(FalconBytes& out, std::size_t at, std::int16_t number) noexcept {
  const auto bits = static_cast<std::uint16_t>(number);
  for (std::size_t i = 0; i < 4; ++i) out[at + i] = coded((bits >> (4 * i)) & 0xFu);
}

FalconBytes frame_of(const std::array<std::int16_t, 3>& numbers, unsigned flags) noexcept {
  FalconBytes out{};
  out[0] = kOpen;
  for (std::size_t i = 0; i < 3; ++i) put(out, 1 + 4 * i, numbers[i]);
  out[kFlags] = coded(flags);
  out[kSpare] = coded(0);
  out[kLast] = kClose;
  return out;
}

struct Fields {
  std::array<std::int16_t, 3> numbers{};
  unsigned flags = 0;
};

std::expected<Fields, FrameError> fields_of(std::span<const std::byte, kFalconFrame> in) noexcept {
  if (in[0] != kOpen || in[kLast] != kClose) return std::unexpected(FrameError::kBrackets);
  Fields fields;
  for (std::size_t i = 0; i < 3; ++i) {
    unsigned bits = 0;
    for (std::size_t n = 0; n < 4; ++n) {
      const unsigned nibble = value(in[1 + 4 * i + n]);
      if (nibble > 0xF) return std::unexpected(FrameError::kNibble);
      bits |= nibble << (4 * n);
    }
    fields.numbers[i] = static_cast<std::int16_t>(static_cast<std::uint16_t>(bits));
  }
  fields.flags = value(in[kFlags]);
  if (fields.flags > 0x7F) return std::unexpected(FrameError::kFlags);
  return fields;  // the meaning of the spare byte is unknown: every value is accepted
}

}  // namespace

FalconBytes encode(const FalconCommand& command, const FalconFlagBits& bits) noexcept {
  unsigned flags = command.homing ? bits.homing : 0u;
  for (std::size_t i = 0; i < 3; ++i) {
    if ((command.lights >> i & 1) != 0) flags |= bits.light[i];
  }
  return frame_of(command.motor, flags & 0x7F);
}

FalconBytes encode(const FalconReply& reply) noexcept {
  return frame_of(reply.encoder, (reply.buttons & 0xFu) | (reply.homed & 0x7u) << 4);
}

std::expected<FalconCommand, FrameError> decode_command(std::span<const std::byte, kFalconFrame> bytes,
                                                        const FalconFlagBits& bits) noexcept {
  const auto fields = fields_of(bytes);
  if (!fields) return std::unexpected(fields.error());
  FalconCommand command{.motor = fields->numbers, .homing = (fields->flags & bits.homing) != 0};
  for (unsigned i = 0; i < 3; ++i) {
    if ((fields->flags & bits.light[i]) != 0) command.lights = static_cast<std::uint8_t>(command.lights | 1u << i);
  }
  return command;
}

std::expected<FalconReply, FrameError> decode_reply(std::span<const std::byte, kFalconFrame> bytes) noexcept {
  const auto fields = fields_of(bytes);
  if (!fields) return std::unexpected(fields.error());
  return FalconReply{.encoder = fields->numbers,
                     .buttons = static_cast<std::uint8_t>(fields->flags & 0xF),
                     .homed = static_cast<std::uint8_t>(fields->flags >> 4 & 0x7)};
}

std::optional<std::span<const std::byte, kFalconFrame>> FalconFramer::push(std::byte byte) noexcept {
  if (byte == kOpen) {
    thrown_away_ += filled_;
    filled_ = 0;
  } else if (filled_ == 0) {
    ++thrown_away_;
    return std::nullopt;
  }
  if ((byte == kClose) != (filled_ == kLast)) {  // the frame is too short or too long: discard it
    thrown_away_ += filled_ + 1;
    filled_ = 0;
    return std::nullopt;
  }
  frame_[filled_++] = byte;
  if (filled_ < kFalconFrame) return std::nullopt;
  filled_ = 0;
  return std::span<const std::byte, kFalconFrame>(frame_);
}

}  // namespace tandem::hal
