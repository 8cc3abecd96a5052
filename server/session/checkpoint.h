#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <type_traits>

#include "common/base/axes.h"
#include "proto/spec/scene_spec.h"
#include "server/session/restore_counts.h"
#include "server/session/stop_latch.h"

namespace tandem::server {

/// State from which a new server process restores a session: owners of the seats, authority, tool positions, stop
/// level. It contains no velocities, stored energies or forces, so a restore cannot push a hand (ARCHITECTURE.md,
/// invariant 39).
struct Checkpoint {
  using Hash = std::array<std::byte, 32>;
  struct Seat {
    bool taken = false;
    Hash resume{};           ///< resume_hash of the resume secret of the seat's client; zero: none
    double force_scale = 1;  ///< share of the scene's force limit that the ticket allows, 0 to 1
  };
  struct Tool {
    std::array<double, kMastersMax> alpha{};  ///< scheduled authority, by master; sum 1
    AxisArray x{};                            ///< position of the virtual mass, port axes [m] or [rad]
    AxisArray slave{};  ///< joint positions of a slave simulated by the server [rad] or [m]; zero for other tools
  };
  Hash scene{};             ///< scene_hash of the scene
  std::uint64_t epoch = 1;  ///< increases by 1 with each restart
  std::uint32_t session_tick = 0;
  std::uint32_t authority_version = 1;
  std::uint32_t stops = 0;
  StopLatch::Level stop = StopLatch::Level::kNone;
  bool begun = false;  ///< session time was running
  std::uint8_t seats_n = 0, masters_n = 0, tools_n = 0, dof = 0;
  std::array<Seat, kSeatsMax> seats{};
  std::array<Tool, kToolsMax> tools{};
  // The encoding has none of these: it is read by releases that do not know them (session_snapshot.h keeps three).
  std::optional<RestoreCounts> restores = RestoreCounts{};  ///< nullopt: not known
  StopLatch::Latest latest_stop{};                          ///< `at`: minus its age at the time of this checkpoint
  bool handed_over = false;  ///< the session ended here so that another server goes on with it
  /// Stops, pauses and resumes that were carried out in this process so far. Neither encoded nor restored.
  std::uint32_t orders = 0;
};
static_assert(std::is_trivially_copyable_v<Checkpoint> && sizeof(Checkpoint) <= 4096);

/// SHA-256 over the effective text of a scene. A checkpoint is restored only for the same hash.
[[nodiscard]] Checkpoint::Hash scene_hash(const SceneSpec& scene);
/// SHA-256 of a label, the fingerprint of the client's workstation and the resume secret. A seat stores this hash
/// only. The secret is therefore valid only over a connection that proved the same key.
/// @param workstation  SHA-256 of its public key; zeros for ephemeral keys, where all clients share one key that
/// changes at each start
[[nodiscard]] Checkpoint::Hash resume_hash(std::span<const std::byte, 32> secret,
                                           const Checkpoint::Hash& workstation) noexcept;

inline constexpr std::size_t kCheckpointMax = 4096;
/// Writes the layout version, the fields in their order (little-endian, arrays up to their counts), then the SHA-256
/// of all that.
/// @return bytes written; 0 if `out` is too small
[[nodiscard]] std::size_t encode_checkpoint(const Checkpoint& checkpoint, std::span<std::byte> out) noexcept;

enum class CheckpointError : std::uint8_t {
  kSize,     ///< not the exact length for its counts
  kVersion,  ///< unknown layout version
  kDigest,   ///< wrong digest: damaged, or truncated and followed by other bytes
  kRange,    ///< a number out of range
};
/// Parses any bytes. @return a checkpoint with all numbers in range, or the error
[[nodiscard]] std::expected<Checkpoint, CheckpointError> decode_checkpoint(std::span<const std::byte> bytes) noexcept;

/// Why a session of `scene` cannot be restored from it; empty if it can.
[[nodiscard]] std::string incompatibility(const Checkpoint& checkpoint, const SceneSpec& scene);

}  // namespace tandem::server
