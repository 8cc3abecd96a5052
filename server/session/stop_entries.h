#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

#include "server/session/stop_latch.h"

namespace tandem::server {

/// The newest stop as entries of a snapshot's list of removed workstations, where older releases keep it
/// (session_snapshot.cpp): label, place of the entry from 0, and 20 bytes of the stop.
using SnapshotEntry = std::array<std::byte, 32>;
inline constexpr std::string_view kStopLabel = "tandem-stop";

/// @param stop   its `at` is minus its age
/// @param epoch  of the snapshot
/// @return nothing if the author is not known
[[nodiscard]] std::vector<SnapshotEntry> stop_entries(const StopLatch::Latest& stop, std::uint64_t epoch);

/// Finds the stop among any entries.
/// @param seats  number of seats of the scene
/// @return level kNone if it is missing, incomplete or invalid, or if another epoch wrote it: that of an older release,
/// which does not know these entries
[[nodiscard]] StopLatch::Latest stop_of(std::span<const SnapshotEntry> entries, std::uint64_t epoch, std::size_t seats);

}  // namespace tandem::server
