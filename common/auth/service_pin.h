#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/key_fingerprint.h"
#include "common/auth/ticket_key.h"
#include "proto/rpc/service_codec.h"
#include "proto/spec/registry_spec.h"

/// Trust in the servers of a service. A service has one key [Ed25519, RFC 8032], which lies on no server. With it the
/// administrator vouches for each server. A client pins the public key at enrolment, and so accepts servers that it has
/// never seen. All times are seconds since 1970, UTC.
namespace tandem::auth {

/// A statement that a server belongs to a service.
struct Voucher {
  static constexpr std::int64_t kDay = 86400;
  static constexpr std::int64_t kLifeMax = 1200 * kDay;  ///< [s]

  std::string name;             ///< of the server, unique in its service: 1 to 32 characters of A-Z a-z 0-9 _ -
  KeyFingerprint server;        ///< its key
  std::int64_t not_before = 0;  ///< first second of validity
  std::int64_t not_after = 0;   ///< last second of validity; at most kLifeMax after not_before

  friend bool operator==(const Voucher&, const Voucher&) = default;
};

/// A statement that a service has a new key, signed with the old one.
struct KeyChange {
  static constexpr std::int64_t kGraceMax = 400 * Voucher::kDay;  ///< [s]

  rpc::PublicKey old_key{}, new_key{};
  std::int64_t at = 0;
  std::int64_t old_until = 0;  ///< vouchers of the old key are valid up to this second; at most kGraceMax after `at`

  friend bool operator==(const KeyChange&, const KeyChange&) = default;
};

/// @return the encoded statement, or the field that is out of range (nothing was signed then)
[[nodiscard]] std::expected<std::vector<std::byte>, std::string> sign_voucher(const Voucher& voucher,
                                                                              const TicketKey& service_key);
/// @pre change.old_key is that of `old_key`
[[nodiscard]] std::expected<std::vector<std::byte>, std::string> sign_key_change(const KeyChange& change,
                                                                                 const TicketKey& old_key);

/// The rule that a voucher violates.
enum class VoucherCheck : std::uint8_t {
  kFormat,  ///< not the encoding of a statement
  kVersion,
  kService,   ///< signed with a key of another service, or with one that this service replaced before the last one
  kReplaced,  ///< signed with a key of this service that is no longer valid
  kSignature,
  kContent,  ///< signed, but no voucher, or a field is out of range
  kNotYet,
  kExpired,
  kServer,  ///< of another server
};
struct VoucherError {
  VoucherCheck rule = VoucherCheck::kFormat;
  std::int64_t seconds = 0;  ///< [s] kExpired: since expiry; kNotYet: until validity
  std::string name{};        ///< of the server in the voucher, where its signature is valid
};
/// Returns the message for users: the error and the next step.
[[nodiscard]] std::string to_text(const VoucherError& error);

/// Checks a voucher in the order of VoucherCheck. No content is trusted before its signature is verified.
/// @param server  key that the server has to have
/// @param now     on the client's clock
[[nodiscard]] std::expected<Voucher, VoucherError> check_voucher(std::span<const std::byte> bytes,
                                                                 const ServicePin& pin, const KeyFingerprint& server,
                                                                 std::int64_t now);

/// Returns the pin after those changes that continue its key, oldest first. Every other statement is ignored: it is
/// older than the pin, of another service, or not signed by the pinned key.
[[nodiscard]] ServicePin follow_key_changes(ServicePin pin, std::span<const std::vector<std::byte>> changes);

/// A server that a client accepts as a member of the pinned service.
struct AcceptedMember {
  Voucher voucher;
  ServicePin pin;  ///< newer than the pin before, if the service has changed its key
};
/// Judges the credential in a server's certificate. @return the reason for rejection, with the next step
[[nodiscard]] std::expected<AcceptedMember, std::string> accept_member(std::span<const std::byte> credential,
                                                                       const ServicePin& pin,
                                                                       const KeyFingerprint& server, std::int64_t now);
/// Judges what one server sends about another: its voucher, or its whole credential.
[[nodiscard]] std::expected<AcceptedMember, std::string> accept_sent_member(std::span<const std::byte> statement,
                                                                            const ServicePin& pin,
                                                                            const KeyFingerprint& server,
                                                                            std::int64_t now);
/// Whether two pins are of one service, before and after a change of its key.
[[nodiscard]] bool same_service(const ServicePin& a, const ServicePin& b) noexcept;
/// Returns the pin of the service to which a server belongs that the client trusts already by its own key. It has the
/// key before the last change, for servers that have no voucher of the new key yet.
/// @return the reason if the credential does not vouch for that server
[[nodiscard]] std::expected<ServicePin, std::string> first_pin(std::span<const std::byte> credential,
                                                               const KeyFingerprint& server, std::int64_t now);

}  // namespace tandem::auth
