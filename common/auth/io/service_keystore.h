#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <string>
#include <vector>

#include "common/auth/io/state_directory.h"
#include "common/auth/service_pin.h"
#include "common/auth/ticket_key.h"

namespace tandem::auth {

/// Folder of a service: its key, and the key with which all its servers sign tickets. It belongs on the computer of the
/// administrator, not on a server.
class ServiceKeystore {
 public:
  static constexpr const char* kKeyFile = "service_key";
  static constexpr const char* kTicketKeyFile = "ticket_key";
  static constexpr const char* kChangesFile = "service.textproto";
  static constexpr const char* kVouchedFile = "vouched.textproto";
  static constexpr const char* kLock = "lock";

  /// Creates the keys of a service in a folder that has none yet. @return the public key
  [[nodiscard]] static std::expected<rpc::PublicKey, std::string> init(const std::string& path);
  [[nodiscard]] static std::expected<ServiceKeystore, std::string> open(const std::string& path);

  [[nodiscard]] const rpc::PublicKey& public_key() const noexcept { return key_.verifier().key; }
  /// Changes of the key, encoded statements, oldest first.
  [[nodiscard]] const std::vector<std::vector<std::byte>>& key_changes() const noexcept { return key_changes_; }
  [[nodiscard]] const std::string& path() const noexcept { return folder_.path(); }

  /// Returns the text of a member file, which is secret. @return the field of the voucher that is out of range
  [[nodiscard]] std::expected<SecretBuffer, std::string> vouch(const Voucher& voucher) const;

  /// Enters a voucher that was made in the folder's list, from which expired ones are removed. Of more than
  /// VouchedRow::kMax those that expire first leave it.
  /// @param now  seconds since 1970, UTC
  /// @return the newest voucher of that name for another key that is still valid, or the error of the list
  [[nodiscard]] std::expected<std::optional<VouchedRow>, std::string> enter(const Voucher& voucher,
                                                                            std::int64_t now) const;

  /// Replaces the service's key, and announces the new one in a statement signed with the old one.
  /// @param now         seconds since 1970, UTC
  /// @param grace       time for which vouchers of the old key stay valid [s], at most KeyChange::kGraceMax
  /// @param new_tickets  also replaces the key that signs tickets
  /// @return the new public key
  [[nodiscard]] static std::expected<rpc::PublicKey, std::string> rotate(const std::string& path, std::int64_t now,
                                                                         std::int64_t grace, bool new_tickets);

 private:
  ServiceKeystore(StateDirectory folder, TicketKey key, TicketKey ticket_key,
                  std::vector<std::vector<std::byte>> key_changes)
      : folder_(std::move(folder)),
        key_(std::move(key)),
        ticket_key_(std::move(ticket_key)),
        key_changes_(std::move(key_changes)) {}

  StateDirectory folder_;
  TicketKey key_, ticket_key_;
  std::vector<std::vector<std::byte>> key_changes_;
};

}  // namespace tandem::auth
