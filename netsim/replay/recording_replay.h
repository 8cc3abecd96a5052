#pragma once

#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "netsim/replay/session_replay.h"

namespace tandem::netsim {

/// Result of the replay of a recording.
struct RecordingReplay {
  std::string session;  ///< name of the session
  double length_s = 0;  ///< session time of the last row [s]
  std::optional<ReplayDifference> difference;
  std::string error;                      ///< why the inputs cannot be replayed (further); empty: they were, to the end
  std::vector<std::string> other_builds;  ///< builds that recorded, other than this program's
  bool other_scene = false;               ///< the inputs are of another scene than the one in the file
  bool complete = false;                  ///< the file has an undamaged end
  bool seats_compared = false;            ///< false: rows of seats show the hands themselves, before the network
  SessionReplay::Counts counts;
  std::uint64_t rows = 0;  ///< ticks whose recorded values were compared

  /// Everything was replayed, and equal.
  [[nodiscard]] bool equal() const noexcept { return !difference && error.empty() && counts.ticks > 0; }
};

/// Feeds the recorded inputs of a recording into the session core, and compares its outputs with their hashes and its
/// records with the recorded values, bit for bit.
/// @param file  bytes of an MCAP file; any bytes are safe
/// @return why it is no recording that can be replayed, or the result
[[nodiscard]] std::expected<RecordingReplay, std::string> replay_recording(std::span<const std::byte> file);

}  // namespace tandem::netsim
