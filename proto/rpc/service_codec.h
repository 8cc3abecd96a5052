#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

/// Codec of the statements of a service's key (proto/schema/service.proto). It knows neither keys nor rules:
/// common/auth signs and judges. Each value has exactly one encoding; a decoder rejects all other bytes.
namespace tandem::rpc {

using PublicKey = std::array<std::byte, 32>;

/// Content of a voucher; no field is checked for its range.
struct VoucherContent {
  std::string name;                            ///< of the server
  std::array<std::byte, 32> server{};          ///< SHA-256 of its public key
  std::int64_t not_before = 0, not_after = 0;  ///< [s] since 1970, UTC

  friend bool operator==(const VoucherContent&, const VoucherContent&) = default;
};

/// Content of a change of the key; no field is checked for its range.
struct KeyChangeContent {
  PublicKey old_key{}, new_key{};
  std::int64_t at = 0, old_until = 0;  ///< [s] since 1970, UTC

  friend bool operator==(const KeyChangeContent&, const KeyChangeContent&) = default;
};

/// A content with its signature.
struct ServiceStatement {
  std::uint32_t version = 0;       ///< of the format
  std::uint32_t kid = 0;           ///< names the key
  std::vector<std::byte> content;  ///< not authenticated before its signature is verified
  std::array<std::byte, 64> signature{};

  friend bool operator==(const ServiceStatement&, const ServiceStatement&) = default;
};

/// Part of a server's certificate that its clients check. The statements are encoded, and not checked.
struct MemberCredential {
  PublicKey service_key{};
  std::vector<std::byte> voucher;
  std::vector<std::vector<std::byte>> key_changes;  ///< oldest first, at most kKeyChangesMax

  friend bool operator==(const MemberCredential&, const MemberCredential&) = default;
};

inline constexpr std::size_t kStatementMax = 256;    ///< longest ServiceStatement [bytes]
inline constexpr std::size_t kKeyChangesMax = 8;     ///< in a MemberCredential
inline constexpr std::size_t kCredentialMax = 2560;  ///< longest MemberCredential [bytes]

[[nodiscard]] std::vector<std::byte> encode(const VoucherContent& content);
[[nodiscard]] std::vector<std::byte> encode(const KeyChangeContent& content);
[[nodiscard]] std::vector<std::byte> encode(const ServiceStatement& statement);
[[nodiscard]] std::vector<std::byte> encode(const MemberCredential& credential);
/// @return nullopt if the bytes are too long, or not exactly what `encode` writes for some value
[[nodiscard]] std::optional<VoucherContent> decode_voucher_content(std::span<const std::byte> bytes);
[[nodiscard]] std::optional<KeyChangeContent> decode_key_change_content(std::span<const std::byte> bytes);
[[nodiscard]] std::optional<ServiceStatement> decode_service_statement(std::span<const std::byte> bytes);
[[nodiscard]] std::optional<MemberCredential> decode_member_credential(std::span<const std::byte> bytes);

}  // namespace tandem::rpc
