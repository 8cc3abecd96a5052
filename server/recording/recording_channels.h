#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "common/mcap/mcap_writer.h"
#include "proto/spec/lesson.h"
#include "proto/spec/scene_spec.h"

namespace tandem::server {

/// Channels of a recording that have a message for every tick, with their account.
class TickChannels {
 public:
  /// Adds schemas and channels to the file. @param scene  outlives this object
  TickChannels(const SceneSpec& scene, mcap::Writer& file);

  /// A channel with one message per tick.
  struct Channel {
    std::uint16_t id = 0;
    std::string topic;
    std::string last;            ///< message of the tick before
    std::uint64_t recorded = 0;  ///< messages
  };
  [[nodiscard]] Channel& seat(std::size_t i) noexcept { return channels_[kSeats + i]; }
  /// Tools have a message in every tick, seats and authority where one is new.
  [[nodiscard]] Channel& tool(std::size_t j) noexcept { return channels_[kSeats + seats_ + j]; }
  [[nodiscard]] const Channel& tool(std::size_t j) const noexcept { return channels_[kSeats + seats_ + j]; }
  [[nodiscard]] Channel& authority() noexcept { return channels_[0]; }
  [[nodiscard]] const std::vector<Channel>& all() const noexcept { return channels_; }

 private:
  static constexpr std::size_t kSeats = 1;  ///< channels before those of seats
  std::size_t seats_;
  std::vector<Channel> channels_;
};

/// Numbers of the channels whose messages are rare.
struct NoteChannels {
  std::uint16_t session = 0, inputs = 0, link = 0, events = 0, marks = 0, sheets = 0, counts = 0;
};
[[nodiscard]] NoteChannels add_note_channels(mcap::Writer& file);

/// Account of ticks: recorded + dropped + never received = ticks, for every channel.
class TickAccount {
 public:
  /// A tick was recorded. @param tick  above that of the call before
  void add(std::uint32_t tick) noexcept;
  /// Records of `count` ticks were dropped before they reached the recording.
  void drop(std::uint64_t count) noexcept { pending_ += count; }
  /// Ends the account: drops after the last recorded tick count as ticks.
  void finish() noexcept;

  [[nodiscard]] std::uint64_t ticks() const noexcept { return ticks_; }
  /// Account of a channel with `recorded` messages, at most ticks() - dropped.
  [[nodiscard]] LessonCount of(std::uint64_t recorded) const noexcept {
    return {recorded, dropped_, ticks_ - dropped_ - recorded};
  }
  [[nodiscard]] bool begun() const noexcept { return ticks_ > 0; }
  [[nodiscard]] std::uint32_t last_tick() const noexcept { return last_; }

 private:
  std::uint64_t ticks_ = 0, dropped_ = 0, pending_ = 0;
  std::uint32_t last_ = 0;
};

/// Topic of a seat or a tool: `/NAME`. A tool whose name is that of a seat, and a name that is a topic of the
/// recording, get an underscore behind it.
[[nodiscard]] std::string seat_topic(const SceneSpec& scene, std::size_t seat);
[[nodiscard]] std::string tool_topic(const SceneSpec& scene, std::size_t tool);

/// Adds a channel with a schema for its message, one per file. @return its number
std::uint16_t add_recording_channel(mcap::Writer& file, const std::string& topic, std::uint16_t schema,
                                    std::string_view kind, const std::string& name = {});

}  // namespace tandem::server
