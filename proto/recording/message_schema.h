#pragma once

#include <cstdint>
#include <string>

namespace tandem::rec {

/// Messages of the channels of a recording: own ones, and those of Foxglove for viewers.
enum class MessageKind : std::uint8_t {
  kSeat,
  kTool,
  kAuthority,
  kSession,
  kInputs,
  kLink,
  kEvent,
  kMark,
  kSheet,
  kCounts,
  kSceneUpdate,
  kFrameTransform,
  kPoseInFrame,
  kLog
};
inline constexpr std::size_t kMessageKinds = 14;

/// Full name of a message, such as `tandem.recording.Seat`.
[[nodiscard]] std::string message_name(MessageKind kind);
/// Serialized google.protobuf.FileDescriptorSet: the file that defines the message, after all files that it imports,
/// with no other messages than it and those in its fields.
[[nodiscard]] std::string message_schema(MessageKind kind);

}  // namespace tandem::rec
