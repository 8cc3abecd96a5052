#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "netsim/replay/journal_reader.h"
#include "netsim/replay/row_comparison.h"
#include "netsim/replay/session_replay.h"
#include "proto/spec/lesson.h"

namespace tandem::mcap {
class Reader;
}

namespace tandem::netsim {

/// Result of the replay of a recording.
struct RecordingReplay {
  std::string session;  ///< name of the session
  double length_s = 0;  ///< session time of the last row [s]
  std::optional<ReplayDifference> difference;
  std::string error;                      ///< why the inputs cannot be replayed (further); empty: they were, to the end
  std::vector<std::string> other_builds;  ///< builds that recorded, other than this program's
  bool other_scene = false;               ///< the inputs are of another scene than the one in the file
  bool complete = false;                  ///< all files have an undamaged end
  bool seats_compared = false;            ///< false: rows of seats show the hands themselves, before the network
  SessionReplay::Counts counts;
  std::uint64_t rows = 0;    ///< ticks whose recorded values were compared
  std::uint64_t unseen = 0;  ///< ticks before the recording: only what the seats were sent was compared

  /// Everything was replayed, and equal.
  [[nodiscard]] bool equal() const noexcept { return !difference && error.empty() && counts.ticks > 0; }
};

/// Feeds the recorded inputs of a recording into the session core, and compares its outputs with their hashes and its
/// records with the recorded values, bit for bit. The files of a recording are added in their order; one at a time, and
/// the rows of the one before, are in memory.
class RecordingReplayer {
 public:
  RecordingReplayer() = default;
  RecordingReplayer(const RecordingReplayer&) = delete;  // its parts refer to each other
  RecordingReplayer& operator=(const RecordingReplayer&) = delete;

  /// Replays a file.
  /// @param file  bytes of an MCAP file; any bytes are safe
  /// @return why it is no recording that can be replayed, or none that continues the files before, without its name
  [[nodiscard]] std::expected<void, std::string> add(std::span<const std::byte> file);
  /// No further file changes the result: there is a difference or an error.
  [[nodiscard]] bool ended() const noexcept { return !out_.error.empty() || out_.difference; }
  /// Returns the result. @pre a file was added
  [[nodiscard]] RecordingReplay finish();

 private:
  void begin(const Lesson& lesson);
  [[nodiscard]] bool feed(const mcap::Reader& reader, const Lesson& lesson);

  RecordingReplay out_;
  std::unique_ptr<Lesson> facts_;  ///< of the first file, without rows
  std::optional<SessionReplay> replay_;
  std::optional<RowComparison> rows_;
  JournalReader journal_;
  std::optional<std::uint32_t> last_row_;  ///< session tick
};

/// Replays a recording of one file, as RecordingReplayer.
[[nodiscard]] std::expected<RecordingReplay, std::string> replay_recording(std::span<const std::byte> file);

}  // namespace tandem::netsim
