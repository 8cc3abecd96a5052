#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/base/time.h"
#include "proto/control_messages.h"
#include "server/checkpoint.h"

namespace tandem::server {

/// What a restart needs of a session: its checkpoint, and under which id and code people know it. One file, for its owner only: it holds
/// the session's code, and no secret of anybody (resume secrets are hashed).
struct KeptSession {
  Checkpoint checkpoint;
  control::Id id{};
  std::string name;            ///< 1 ... 255 bytes
  std::string code;            ///< at most 255; empty: tickets only
  std::int64_t written_s = 0;  ///< wall time [s since 1970, UTC]
  std::vector<std::array<std::byte, 32>> sent_away{};  ///< keys of workstations that the session's code does not let in again; at most kSentAwayMax
};

/// A resume secret is good for so long after its owner was lost, and a file for so long after it was written (design notes, security 1.4).
inline constexpr std::int64_t kResumeLifeS = 600;
inline constexpr Duration kResumeLife = std::chrono::seconds(kResumeLifeS);

/// So many are remembered; then nobody gets in by the code any more, only by a ticket.
inline constexpr std::size_t kSentAwayMax = 128;
inline constexpr std::size_t kKeptMax = kCheckpointMax + 1024 + 32 * kSentAwayMax;  ///< [bytes]

/// Magic, wall time, id, name, code, how many were sent away (one byte) and their keys, checkpoint, SHA-256 of all that. @return nothing if a name is too long
[[nodiscard]] std::vector<std::byte> encode_kept(const KeptSession& kept);
/// Any bytes give a session with numbers in range, or what is wrong with them, for a person.
[[nodiscard]] std::expected<KeptSession, std::string> decode_kept(std::span<const std::byte> bytes);

/// Why `scene` cannot go on from it now; empty when it can.
/// @param now  wall time [s]
[[nodiscard]] std::string unfit(const KeptSession& kept, std::string_view name, const SceneSpec& scene, std::int64_t now);

}  // namespace tandem::server
