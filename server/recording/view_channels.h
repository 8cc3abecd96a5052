#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "common/mcap/mcap_writer.h"
#include "proto/recording/view_messages.h"
#include "proto/spec/lesson.h"
#include "proto/spec/scene_spec.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Channels in Foxglove's own messages, so that viewers show hands, tools, forces and surfaces without a plug-in:
/// /view/scene, /tf and a pose of every seat and tool at 60 Hz, and /log.
class ViewChannels {
 public:
  static constexpr double kHz = 30;

  /// Adds schemas and channels to the file. @param scene  outlives this object
  ViewChannels(const SceneSpec& scene, mcap::Writer& file);

  /// Adds the messages of a tick if they are due. @param time  of the messages [ns]
  void add(const TickRecord& record, std::uint64_t time, mcap::Writer& file);
  /// Adds a line to /log.
  void log(rec::LogLevel level, const std::string& name, const std::string& text, std::uint32_t tick,
           std::uint64_t time, mcap::Writer& file) const;
  /// Surfaces are in the next message again, so that every chunk shows them.
  void begin_chunk() noexcept { boxes_due_ = true; }

 private:
  void add_frame(const std::string& child, const Triple& position, std::uint16_t channel, std::uint32_t tick,
                 std::uint64_t time, mcap::Writer& file) const;

  const SceneSpec* scene_;
  std::uint16_t scene_channel_ = 0, transform_channel_ = 0, log_channel_ = 0;
  std::vector<std::uint16_t> seat_channels_, tool_channels_;
  std::vector<std::string> tool_frames_;
  std::vector<rec::ViewBox> boxes_;
  bool boxes_due_ = true;
  std::int64_t last_frame_ = -1;  ///< number of the last frame of 60 Hz
  std::vector<rec::ViewBody> bodies_;
};

}  // namespace tandem::server
