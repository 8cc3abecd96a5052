#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "proto/spec/lesson.h"

/// Messages of a recording that are rare: events, marks, sheets, links, inputs, counts (proto/schema/recording.proto).
/// `decode_*` accept any bytes; they return nullopt if these are damaged or a text is longer than kTextMax.
namespace tandem::rec {

inline constexpr std::size_t kTextMax = std::size_t{64} * 1024;  ///< longest text that is read [bytes]

/// Account of all channels of one message per tick.
struct CountsMessage {
  struct Channel {
    std::string topic;
    LessonCount count;
  };
  std::uint64_t ticks = 0;
  std::vector<Channel> channels;
  std::uint64_t tools_digest = 0;  ///< 0: none
};

[[nodiscard]] std::string encode_event(const LessonEvent& event);
[[nodiscard]] std::string encode_mark(const LessonMark& mark);
[[nodiscard]] std::string encode_sheet(const LessonSheet& sheet);
/// @param seat  name of the seat, because its index means nothing without the scene
[[nodiscard]] std::string encode_link(const LessonLink& link, const std::string& seat);
[[nodiscard]] std::string encode_counts(const CountsMessage& counts);
/// Replaces `out` by a message Inputs.
void encode_inputs(std::uint32_t tick, std::span<const std::byte> data, std::string& out);

/// The caller sets `tick` and `time_ns` of an event, and `tick` of a link, from the message's own number and time.
[[nodiscard]] std::optional<LessonEvent> decode_event(std::span<const std::byte> bytes);
[[nodiscard]] std::optional<LessonMark> decode_mark(std::span<const std::byte> bytes);
[[nodiscard]] std::optional<LessonSheet> decode_sheet(std::span<const std::byte> bytes);
/// @param seat  receives the name of the seat
[[nodiscard]] std::optional<LessonLink> decode_link(std::span<const std::byte> bytes, std::string& seat);
[[nodiscard]] std::optional<CountsMessage> decode_counts(std::span<const std::byte> bytes);

/// Inputs of the session in one tick. `data` lies in the bytes that were read.
struct InputsMessage {
  std::uint32_t tick = 0;
  std::span<const std::byte> data;
};
[[nodiscard]] std::optional<InputsMessage> decode_inputs(std::span<const std::byte> bytes) noexcept;

}  // namespace tandem::rec
