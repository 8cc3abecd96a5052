#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "proto/rpc/rpc_messages.h"
#include "server/session/checkpoint.h"

namespace tandem::server {

/// State that a restart needs of a session: its checkpoint, id, name and code. Stored as one file that only its
/// owner can read: it contains the session's code. It contains no resume secrets, only their hashes.
struct SessionSnapshot {
  Checkpoint checkpoint;
  rpc::Id id{};
  std::string name;            ///< 1 ... 255 bytes
  std::string code;            ///< session code, at most 255 bytes; empty: tickets only
  std::int64_t written_s = 0;  ///< wall-clock time [s since 1970, UTC]
  /// Fingerprints of removed workstations: the session's code does not admit them again. At most
  /// kRemovedWorkstationsMax.
  std::vector<std::array<std::byte, 32>> removed_workstations{};
  /// Names of the persons at the seats, from their tickets (rpc::is_name); empty: not named. At most kSeatsMax.
  std::vector<std::string> persons{};
  /// Rest of the time that the session was given when it was created [s], 0 ... rpc::kLifeMaxS; nullopt: no limit.
  std::optional<std::int64_t> life_left_s{};
};

/// Lifetime of a resume secret after its owner was lost, and of a snapshot after it was written (ARCHITECTURE.md,
/// invariant 45).
inline constexpr std::int64_t kResumeLifeS = 600;
inline constexpr Duration kResumeLife = std::chrono::seconds(kResumeLifeS);

/// Maximum number of stored removed workstations. Once it is reached the session code admits no clients, and every
/// join needs a ticket.
inline constexpr std::size_t kRemovedWorkstationsMax = 128;
inline constexpr std::size_t kSnapshotMax =
    kCheckpointMax + 1024 + 32 * kRemovedWorkstationsMax + 33 * kSeatsMax;  ///< [bytes]

/// Takes a newer checkpoint. The session does not know the person who stops it from a seat: that is the one who has the
/// seat in the first checkpoint with the stop.
void set_checkpoint(SessionSnapshot& kept, const Checkpoint& newest);

/// Writes magic, wall time, id, name, code, number of removed workstations (one byte), their fingerprints, number of
/// persons (one byte), their names, checkpoint, then the SHA-256 of all that. Counts of restores, the rest of the
/// session's time and the newest stop are more entries of the removed workstations, if there is room: older releases
/// keep them, and read the rest as ever.
/// @return empty if the name is missing, or if a text or the list is too long
[[nodiscard]] std::vector<std::byte> encode_snapshot(const SessionSnapshot& kept);
/// Parses any bytes. @return a snapshot with all numbers in range, or the reason for the rejection, as text for the
/// log
[[nodiscard]] std::expected<SessionSnapshot, std::string> decode_snapshot(std::span<const std::byte> bytes);

/// Why a session of this name and scene cannot be restored from it now; empty if it can.
/// @param now  wall-clock time [s since 1970, UTC]
[[nodiscard]] std::string incompatibility(const SessionSnapshot& kept, std::string_view name, const SceneSpec& scene,
                                          std::int64_t now);

}  // namespace tandem::server
