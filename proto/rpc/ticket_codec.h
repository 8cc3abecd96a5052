#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Codec of join tickets (proto/schema/ticket.proto). It knows neither keys nor rules: common/auth signs and judges.
/// Each value has exactly one encoding, which every platform produces; a decoder rejects all other bytes.
namespace tandem::rpc {

/// Content of a ticket; no field is checked for its range.
struct TicketContent {
  std::uint32_t role = 0;
  std::uint32_t force_scale = 0;  ///< [1/1000]
  std::array<std::byte, 16> ticket_id{}, session_id{};
  std::array<std::byte, 32> workstation{};  ///< SHA-256 of its public key
  std::string seat;
  std::int64_t not_before = 0, not_after = 0;  ///< [s] since 1970, UTC
  std::uint64_t epoch_min = 0;
  std::string person{};  ///< empty: not named

  friend bool operator==(const TicketContent&, const TicketContent&) = default;
};

/// A ticket with its signature.
struct SignedTicket {
  std::uint32_t version = 0;       ///< of the format
  std::uint32_t kid = 0;           ///< names the key
  std::vector<std::byte> content;  ///< an encoded TicketContent; not authenticated before its signature is verified
  std::array<std::byte, 64> signature{};

  friend bool operator==(const SignedTicket&, const SignedTicket&) = default;
};

inline constexpr std::size_t kSignedTicketMax = 256;  ///< longest SignedTicket [bytes]

[[nodiscard]] std::vector<std::byte> encode(const TicketContent& content);
[[nodiscard]] std::vector<std::byte> encode(const SignedTicket& ticket);
/// @return nullopt if the bytes are not exactly what `encode` writes for some value
[[nodiscard]] std::optional<TicketContent> decode_ticket_content(std::span<const std::byte> bytes);
/// As `decode_ticket_content`; also nullopt beyond kSignedTicketMax. The content is not decoded.
[[nodiscard]] std::optional<SignedTicket> decode_signed_ticket(std::span<const std::byte> bytes);

}  // namespace tandem::rpc
