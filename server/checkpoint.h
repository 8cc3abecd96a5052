#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <type_traits>

#include "common/base/axes.h"
#include "proto/scene_spec.h"
#include "server/stop_lane.h"

namespace tandem::server {

/// What a session needs to go on after its server died: who sat where, who had authority, where the tools stood, and whether somebody
/// had stopped it. No velocities, no stored energy, no forces: nothing of it can push a hand (design notes, security 2.5).
struct Checkpoint {
  using Hash = std::array<std::byte, 32>;
  struct Seat {
    bool taken = false;
    Hash resume{};  ///< resume_hash of the secret its client may come back with; zero: none
    double force_scale = 1;  ///< of the scene's force limit, as its ticket allowed: 0 ... 1
  };
  struct Tool {
    std::array<double, kMastersMax> alpha{};  ///< requested weights, by master; sum 1
    AxisArray x{};                            ///< port axes of the virtual mass [m] or [rad]
    AxisArray slave{};                        ///< joints of the slave the server steps [rad] or [m]; zero for others
  };
  Hash scene{};                    ///< scene_hash of the scene it belongs to
  std::uint64_t epoch = 1;         ///< rises with each restart
  std::uint32_t session_tick = 0;
  std::uint32_t authority_version = 1;
  std::uint32_t stops = 0;
  StopLane::Level stop = StopLane::Level::kNone;
  bool begun = false;              ///< session time was running
  std::uint8_t seats_n = 0, masters_n = 0, tools_n = 0, dof = 0;
  std::array<Seat, kSeatsMax> seats{};
  std::array<Tool, kToolsMax> tools{};
};
static_assert(std::is_trivially_copyable_v<Checkpoint> && sizeof(Checkpoint) <= 4096);

/// What a checkpoint compares: SHA-256 over everything a scene says.
[[nodiscard]] Checkpoint::Hash scene_hash(const SceneSpec& scene);
/// What a seat keeps of its client's resume secret: SHA-256 of a label, the key that the client's workstation is known by, and the secret.
/// So the secret is good only over a connection that proved this key.
/// @param workstation  SHA-256 of its public key; zeros where all clients share one key that changes at each start (keys made on the spot)
[[nodiscard]] Checkpoint::Hash resume_hash(std::span<const std::byte, 32> secret, const Checkpoint::Hash& workstation) noexcept;

inline constexpr std::size_t kCheckpointMax = 4096;
/// Version, fields in their order, little-endian, arrays up to their counts, SHA-256 of all that.
/// @return bytes written; 0 if `out` is too small
[[nodiscard]] std::size_t encode_checkpoint(const Checkpoint& checkpoint, std::span<std::byte> out) noexcept;

enum class CheckpointError : std::uint8_t {
  kSize,     ///< not the exact length of its counts
  kVersion,  ///< another layout
  kDigest,   ///< damaged, or cut off and something else behind it
  kRange,    ///< a number that cannot be meant
};
/// Any bytes give a checkpoint with numbers in range, or an error.
[[nodiscard]] std::expected<Checkpoint, CheckpointError> decode_checkpoint(std::span<const std::byte> bytes) noexcept;

/// Why a session of `scene` cannot go on from it; empty when it can.
[[nodiscard]] std::string unfit(const Checkpoint& checkpoint, const SceneSpec& scene);

}  // namespace tandem::server
