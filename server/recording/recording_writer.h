#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/mcap/mcap_writer.h"
#include "proto/recording/tick_messages.h"
#include "proto/spec/lesson.h"
#include "proto/spec/scene_spec.h"
#include "server/recording/input_packer.h"
#include "server/recording/recording_channels.h"
#include "server/recording/recording_info.h"
#include "server/recording/tool_digest.h"
#include "server/recording/view_channels.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// Turns the records of a session into the bytes of an MCAP file (server/recording/README.md). It opens no file and
/// reads no clock: the caller appends the bytes of `take` to a file. These bytes are whole chunks, so a file that ends
/// there is readable. The same calls and build give the same bytes.
///
/// Memory: one open chunk of kChunkNs or kChunkBytes, the bytes since the last `take`, and some 0.5 kB per chunk for
/// the index, up to DataSection::kChunksIndexed chunks. Used by an ordinary thread; throws std::bad_alloc only.
class RecordingWriter {
 public:
  static constexpr std::int64_t kChunkNs = 500'000'000;             ///< length of a chunk [ns]
  static constexpr std::size_t kChunkBytes = std::size_t{8} << 20;  ///< size at which a chunk ends earlier [bytes]

  /// @param scene  outlives the writer
  RecordingWriter(const SceneSpec& scene, const RecordingInfo& info);

  /// Adds the participant of each seat, in the order of the scene; empty: not known. Call it again when one changes:
  /// the last record is the present one, and all of them name persons of the file.
  /// @param workstations  seats whose name is that of a workstation; empty: none
  void set_persons(const std::vector<std::string>& persons, const std::vector<bool>& workstations = {});
  /// Adds a tick. Records whose tick is not later than the last one are ignored, because the session clock stood still;
  /// so are those from before the session runs.
  void add(const TickRecord& record);
  /// Adds inputs of the session, for replay, after the record of their tick.
  /// @param piece  of the input journal: its position (u64), then bytes, as InputJournal::drain gives them
  void add_inputs(std::span<const std::byte> piece);
  /// Adds inputs that were packed without rows of the recording, before those that follow them.
  /// @param block  as InputPacker::take gave it
  void add_input_block(std::string_view block);
  void add_event(const LessonEvent& event);
  void add_mark(const LessonMark& mark);
  void add_sheet(const LessonSheet& sheet);
  /// @pre link.seat is an index of the scene's seats
  void add_link(const LessonLink& link);
  /// States that `n` records were dropped since the last `add`, because a queue was full.
  void count_dropped(std::uint64_t n) noexcept { account_.drop(n); }

  /// Returns the whole records since the last call, to be appended to the file.
  [[nodiscard]] std::string take() { return file_.take(); }
  /// Ends the open chunk now, so that `take` returns everything so far.
  void flush();
  /// Ends the file: last chunk, counts, summary, footer. Nothing may follow but `take`.
  /// @param last  no other file continues the recording
  void finish(bool last = true);

  /// The file has a tick, a mark or a sheet; without, it has only how the session waited.
  [[nodiscard]] bool has_content() const noexcept { return content_; }
  /// The open chunk has messages; inputs alone, which wait to be packed, are none.
  [[nodiscard]] bool has_open_messages() const noexcept { return file_.open_bytes() > 0; }

  /// Size of the file without the open chunk [bytes].
  [[nodiscard]] std::uint64_t size() const noexcept { return file_.size(); }
  /// Ticks so far, and those recorded among them.
  [[nodiscard]] LessonCount counts() const noexcept { return account_.of(channels_.tool(0).recorded); }

 private:
  /// Adds a message of this tick unless it is that of the tick before.
  void add_if_new(TickChannels::Channel& channel);
  void add_always(TickChannels::Channel& channel);
  void note(std::uint16_t channel, std::string_view data);
  void begin_message(std::int64_t time_ns);
  void write_inputs(bool rest);
  void write_block(std::string_view block);
  [[nodiscard]] std::uint64_t log_time(std::int64_t time_ns) const noexcept;

  const SceneSpec* scene_;
  std::size_t masters_;
  std::int64_t start_unix_ns_;
  mcap::Writer file_;
  TickChannels channels_;
  NoteChannels notes_;
  ViewChannels view_;
  InputPacker inputs_;
  TickAccount account_;
  bool round_tools_;
  ToolDigest digest_;
  std::int64_t time_ns_ = 0;  ///< of the last record
  bool content_ = false;
  std::optional<std::int64_t> chunk_begin_;
  std::optional<rec::SessionSample> session_;
  std::string message_;
  std::string block_;  ///< of inputs
};

}  // namespace tandem::server
