#include "proto/rpc/rpc_codec.h"

#include <google/protobuf/io/coded_stream.h>

#include <algorithm>
#include <cstring>

#include "common/base/raw_bytes.h"
#include "proto/rpc/rpc_convert.h"

namespace tandem::rpc {
namespace {

constexpr int kRecursionMax = 16;

/// Reads a varint of at most 32 bits in its shortest form and advances `in`; nothing if there is none.
std::optional<std::uint32_t> take_varint(std::span<const std::byte>& in) noexcept {
  std::uint64_t value = 0;
  for (std::size_t i = 0; i < 5 && i < in.size(); ++i) {
    const auto b = std::to_integer<std::uint64_t>(in[i]);
    value |= (b & 0x7f) << (7 * i);
    if ((b & 0x80) != 0) continue;
    if (value > 0xffffffffU || (b == 0 && i > 0)) return std::nullopt;
    in = in.subspan(i + 1);
    return static_cast<std::uint32_t>(value);
  }
  return std::nullopt;
}

/// Field number and wire type in protobuf encoding.
constexpr std::uint32_t tag(std::uint32_t field, std::uint32_t type) noexcept { return field << 3 | type; }
constexpr std::uint32_t kVarint = 0, kLengthDelimited = 2;

/// A frame that overwrites its secrets on destruction.
struct WipedFrame {
  pb::rpc::ControlFrame frame;
  ~WipedFrame() { wipe_secrets(frame); }
};

}  // namespace

std::string_view to_text(FrameError error) noexcept {
  switch (error) {
    case FrameError::kLength:
      return "the frame is too long, or empty";
    case FrameError::kVersion:
      return "the frame is of another version of Tandem";
    case FrameError::kMalformed:
      return "the bytes are no control frame";
    case FrameError::kOutOfRange:
      return "a value in the frame is out of its range";
  }
  return "?";
}

std::expected<std::size_t, FrameError> frame_length(std::span<const std::byte, kLengthSize> head,
                                                    std::size_t limit) noexcept {
  std::size_t length = 0;
  for (std::size_t i = 0; i < kLengthSize; ++i) length |= std::to_integer<std::size_t>(head[i]) << (8 * i);
  if (length == 0 || length > std::min(limit, kFrameMax)) return std::unexpected(FrameError::kLength);
  return length;
}

std::expected<Head, FrameError> peek(std::span<const std::byte> in) noexcept {
  if (in.empty() || in.size() > kFrameMax) return std::unexpected(FrameError::kLength);
  if (take_varint(in) != tag(1, kVarint) || take_varint(in) != kFrameVersion)
    return std::unexpected(FrameError::kVersion);
  std::uint32_t request = 0;
  auto field = take_varint(in);
  if (field == tag(2, kVarint)) {
    const auto number = take_varint(in);
    if (!number) return std::unexpected(FrameError::kMalformed);
    request = *number;
    field = take_varint(in);
  }
  if (!field || (*field & 7U) != kLengthDelimited) return std::unexpected(FrameError::kMalformed);
  const std::uint32_t number = *field >> 3;
  if (number < static_cast<std::uint32_t>(Kind::kHello) || number > static_cast<std::uint32_t>(Kind::kElsewhere))
    return std::unexpected(FrameError::kMalformed);
  return Head{static_cast<Kind>(number), request};
}

std::expected<Frame, FrameError> decode(std::span<const std::byte> in) {
  if (const auto head = peek(in); !head) return std::unexpected(head.error());
  WipedFrame read;
  google::protobuf::io::CodedInputStream stream(raw(in.data()), static_cast<int>(in.size()));
  stream.SetRecursionLimit(kRecursionMax);
  if (!read.frame.ParseFromCodedStream(&stream) || !stream.ConsumedEntireMessage())
    return std::unexpected(FrameError::kMalformed);
  // Encoding the result must give the same bytes. This rejects unknown fields, repeated fields and longer forms of
  // numbers.
  read.frame.DiscardUnknownFields();
  if (read.frame.ByteSizeLong() != in.size()) return std::unexpected(FrameError::kMalformed);
  SecretBuffer again(in.size());
  if (!read.frame.SerializeToArray(again.bytes().data(), static_cast<int>(again.size())) ||
      std::memcmp(again.bytes().data(), in.data(), in.size()) != 0)
    return std::unexpected(FrameError::kMalformed);
  Frame out;
  out.request = read.frame.request();
  if (!from_pb(read.frame, out.body)) return std::unexpected(FrameError::kOutOfRange);
  return out;
}

std::expected<SecretBuffer, FrameError> encode(const Frame& frame) {
  WipedFrame made;
  made.frame.set_version(kFrameVersion);
  made.frame.set_request(frame.request);
  to_pb(frame.body, made.frame);
  const std::size_t size = made.frame.ByteSizeLong();
  if (size > kFrameMax) return std::unexpected(FrameError::kLength);
  SecretBuffer out(kLengthSize + size);
  const auto bytes = out.bytes();
  for (std::size_t i = 0; i < kLengthSize; ++i) bytes[i] = static_cast<std::byte>(size >> (8 * i) & 0xffU);
  if (!made.frame.SerializeToArray(bytes.data() + kLengthSize, static_cast<int>(size)))
    return std::unexpected(FrameError::kMalformed);
  // The same check in both directions.
  Body judged;
  if (!from_pb(made.frame, judged)) return std::unexpected(FrameError::kOutOfRange);
  return out;
}

}  // namespace tandem::rpc
