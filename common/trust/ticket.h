#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "common/trust/pin.h"
#include "common/trust/ticket_key.h"
#include "proto/access_role.h"

namespace tandem::trust {

using Id16 = std::array<std::byte, 16>;

/// The right of one workstation to take one seat of one session, once. All times are seconds since 1970, UTC, of the server's clock:
/// it signs and it judges, so clocks of other machines do not matter.
struct Ticket {
  static constexpr std::uint8_t kVersion = 1;
  static constexpr std::size_t kSeatMax = 32;
  static constexpr std::int64_t kLifeMax = 12 * 3600;  ///< [s]
  static constexpr std::uint16_t kFullForce = 1000;

  Id16 ticket_id{};          ///< random; makes it single-use
  Id16 session_id{};
  std::string seat;          ///< 0 to 32 characters of A-Z a-z 0-9 _ -; empty for an operator or a recorder, who sit on none, and an instructor at a console
  AccessRole role = AccessRole::kObserver;
  Pin workstation;           ///< only the machine with this key may use it
  std::uint16_t force_scale = kFullForce;  ///< of the scene's force limit [1/1000], 1 to 1000
  std::int64_t not_before = 0;             ///< first second in which it is good
  std::int64_t not_after = 0;              ///< last second in which it is good; at most 12 h after not_before
  std::uint64_t epoch_min = 0;             ///< good for a session of this epoch or a later one

  friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// Layout, numbers little-endian; every ticket has these bytes and no others:
///   0 u8 version = 1 | 1 u8 role | 2 u16 force_scale | 4 u32 kid | 8 ticket_id 16 | 24 session_id 16 | 40 workstation 32 |
///   72 seat 32, filled up with zeros | 104 i64 not_before | 112 i64 not_after | 120 u64 epoch_min |
///   128 signature 64: Ed25519 over "tandem ticket v1\0" and bytes 0 ... 127.
inline constexpr std::size_t kTicketSize = 192;
using TicketBytes = std::array<std::byte, kTicketSize>;

/// @return the ticket, or which field is beyond its range (then nothing was signed)
[[nodiscard]] std::expected<TicketBytes, std::string> sign_ticket(const Ticket& ticket, const TicketKey& key);

/// As people carry it: `ticket:` and base32.
[[nodiscard]] std::string ticket_text(const TicketBytes& ticket);
[[nodiscard]] std::expected<TicketBytes, std::string> ticket_from_text(std::string_view text);

/// The session a ticket says it is for; nothing is proven.
[[nodiscard]] Id16 session_named_in(const TicketBytes& ticket) noexcept;

/// The role a ticket says it is for; nothing is proven. Nothing: not the length of a ticket, or no role.
[[nodiscard]] std::optional<AccessRole> role_named_in(std::span<const std::byte> bytes) noexcept;

/// The rule that a ticket breaks.
enum class TicketRule : std::uint8_t {
  kLength,       ///< not 192 bytes
  kVersion,
  kKey,          ///< made under a key this server does not have
  kSignature,
  kContent,      ///< signed, but a field is beyond its range: a signer's mistake
  kNotYet,
  kExpired,
  kWorkstation,  ///< of another machine
  kSession,
  kEpoch,
  kSeat,
  kRole,
  kUsed,
  kBookFull,     ///< too many tickets are remembered as used
};
inline constexpr std::size_t kTicketRules = 14;

/// Which rule, and by how much.
struct TicketFault {
  TicketRule rule = TicketRule::kLength;
  std::int64_t seconds = 0;  ///< kExpired: ago; kNotYet: ahead
  std::string detail;        ///< what the ticket says, where that helps: its seat, its role

  friend bool operator==(const TicketFault&, const TicketFault&) = default;
};
/// For a person: what is wrong and what to do.
[[nodiscard]] std::string to_text(const TicketFault& fault);
/// One word for counters and logs.
[[nodiscard]] std::string_view name_of(TicketRule rule) noexcept;

/// What somebody wants to do with a ticket.
struct TicketUse {
  Id16 session_id{};
  std::uint64_t epoch = 0;
  std::string_view seat;
  std::optional<AccessRole> role;  ///< that the seat has in the scene; nothing: any
  Pin workstation;                 ///< of the key that the TLS handshake proved
  std::int64_t now = 0;            ///< [s] since 1970, UTC
};

/// Everything but single use. Checks in the order of TicketRule; nothing of a ticket is believed before its signature is right.
[[nodiscard]] std::expected<Ticket, TicketFault> check_ticket(std::span<const std::byte> bytes, const TicketVerifier& key, const TicketUse& use);

}  // namespace tandem::trust
