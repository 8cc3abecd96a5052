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

#include "common/auth/key_fingerprint.h"
#include "common/auth/ticket_key.h"
#include "proto/spec/access_role.h"

namespace tandem::auth {

using Id16 = std::array<std::byte, 16>;

/// The right of one workstation to join one seat of one session, once. All times are seconds since 1970, UTC, on the
/// clocks of servers: the one that signs, and the one that checks. In a service these may be two; clocks of clients do
/// not matter.
struct Ticket {
  static constexpr std::uint32_t kVersion = 2;                       ///< of the format
  static constexpr std::size_t kNameMax = 32;                        ///< of seats and persons
  static constexpr std::int64_t kLifeMax = std::int64_t{12} * 3600;  ///< [s]
  static constexpr std::uint16_t kFullForce = 1000;

  Id16 ticket_id{};  ///< random; makes the ticket single-use
  Id16 session_id{};
  std::string seat;  ///< 0 to 32 characters of A-Z a-z 0-9 _ -; empty: a console
  AccessRole role = AccessRole::kObserver;
  KeyFingerprint workstation;              ///< only the machine with this key may use the ticket
  std::uint16_t force_scale = kFullForce;  ///< of the scene's force limit [1/1000], 1 to 1000
  std::int64_t not_before = 0;             ///< first second of validity
  std::int64_t not_after = 0;              ///< last second of validity; at most 12 h after not_before
  std::uint64_t epoch_min = 0;             ///< smallest valid epoch of the session
  std::string person{};                    ///< name of the person who gets it: as `seat`; empty: not named

  friend bool operator==(const Ticket&, const Ticket&) = default;
};

/// An encoded SignedTicket (proto/schema/ticket.proto), at most 256 bytes.
using TicketBytes = std::vector<std::byte>;

/// @return the ticket, or the field that is out of range (nothing was signed then)
[[nodiscard]] std::expected<TicketBytes, std::string> sign_ticket(const Ticket& ticket, const TicketKey& key);

/// Text form of a ticket for users: `ticket:` and base32.
[[nodiscard]] std::string ticket_text(std::span<const std::byte> ticket);
/// @return the ticket, or the error with the next step: no ticket, damaged, or of another version
[[nodiscard]] std::expected<TicketBytes, std::string> ticket_from_text(std::string_view text);

/// Returns the session named in a ticket; not authenticated. nullopt: no ticket.
[[nodiscard]] std::optional<Id16> claimed_session(std::span<const std::byte> bytes);

/// Returns the key of the workstation named in a ticket; not authenticated. nullopt: no ticket.
[[nodiscard]] std::optional<KeyFingerprint> claimed_workstation(std::span<const std::byte> bytes);

/// Returns the role named in a ticket; not authenticated. nullopt: no ticket, or an unknown role.
[[nodiscard]] std::optional<AccessRole> claimed_role(std::span<const std::byte> bytes);

/// The rule that a ticket violates.
enum class TicketCheck : std::uint8_t {
  kFormat,  ///< not the encoding of a ticket
  kVersion,
  kKey,  ///< signed with a key that this server does not have
  kSignature,
  kContent,  ///< signed, but a field is out of range: an error of the signer
  kNotYet,
  kExpired,
  kWorkstation,  ///< of another machine
  kEnrolment,    ///< from before the workstation was enrolled, which was revoked meanwhile
  kSession,
  kEpoch,
  kSeat,
  kRole,
  kUsed,
  kBookFull,  ///< the list of redeemed tickets is full
};
inline constexpr std::size_t kTicketChecks = 15;

/// The violated rule with details.
struct TicketError {
  TicketCheck rule = TicketCheck::kFormat;
  std::int64_t seconds = 0;  ///< [s] kExpired: since expiry; kNotYet: until validity
  std::string detail;        ///< the ticket's seat or role, where that helps

  friend bool operator==(const TicketError&, const TicketError&) = default;
};
/// Returns the message for users: the error and the next step.
[[nodiscard]] std::string to_text(const TicketError& fault);
/// Returns one word for counters and logs.
[[nodiscard]] std::string_view name_of(TicketCheck rule) noexcept;

/// The intended use of a ticket.
struct TicketUse {
  Id16 session_id{};
  std::uint64_t epoch = 0;
  std::string_view seat;
  std::optional<AccessRole> role;  ///< of the seat in the scene; nullopt: any
  KeyFingerprint workstation;      ///< key that the TLS handshake proved
  std::int64_t now = 0;            ///< [s] since 1970, UTC
  /// Time of the workstation's enrolment [s], from which on its tickets count: a revocation voids those before, also if
  /// the same key is enrolled again.
  std::int64_t enrolled_at = 0;
};

/// Checks all rules but single use, in the order of TicketCheck. No content of a ticket is trusted before its signature
/// is verified.
[[nodiscard]] std::expected<Ticket, TicketError> check_ticket(std::span<const std::byte> bytes,
                                                              const TicketVerifier& key, const TicketUse& use);

}  // namespace tandem::auth
