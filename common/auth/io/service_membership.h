#pragma once

#include <cstdint>
#include <expected>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "common/auth/service_pin.h"
#include "common/auth/ticket_key.h"

namespace tandem::auth {

/// Membership of a server in a service: contents of its member file, without the secret.
struct ServiceMembership {
  rpc::PublicKey service_key{};
  std::vector<std::byte> voucher;                   ///< of this server, an encoded statement
  std::string name;                                 ///< of this server in the service
  std::vector<std::vector<std::byte>> key_changes;  ///< of the service's key, encoded statements, oldest first
  std::int64_t not_before = 0, not_after = 0;       ///< of the voucher, seconds since 1970, UTC

  /// Returns the encoded MemberCredential that this server shows in its certificate.
  [[nodiscard]] std::vector<std::byte> credential() const {
    return rpc::encode(rpc::MemberCredential{service_key, voucher, key_changes});
  }
};

/// Reads a member file and checks its signatures, not the times of the voucher.
/// @param file    name for errors
/// @param server  key of the server that the voucher has to name
/// @return the membership and the service's ticket key, or the error with the next step
[[nodiscard]] std::expected<std::pair<ServiceMembership, TicketKey>, std::string> read_membership(
    std::span<const std::byte> text, const std::string& file, const KeyFingerprint& server);

/// Returns the commands that make a member file of the service's present key for a server and take it.
/// @param name  of the server in its service; empty: unknown
[[nodiscard]] std::string renewal(const std::string& name, const KeyFingerprint& server);

/// Whether a member file is from before a change of the service's key that the present one knows.
[[nodiscard]] bool is_older(const ServiceMembership& file, const ServiceMembership& present);

/// Returns why a server with this membership may not serve at this time, with the remedy; empty: it may.
[[nodiscard]] std::string membership_problem(const ServiceMembership& membership, const KeyFingerprint& server,
                                             std::int64_t now);

}  // namespace tandem::auth
