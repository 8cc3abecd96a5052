#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/io/audit_log.h"
#include "common/auth/io/server_registry.h"
#include "common/auth/io/service_membership.h"
#include "common/auth/io/serving_file.h"
#include "common/auth/io/state_directory.h"
#include "common/auth/io/ticket_redeemer.h"
#include "common/auth/ticket_key.h"
#include "common/auth/tls_key.h"

namespace tandem::auth {

/// Keys of a server: its key and its ticket key, in a state directory or in memory only (loopback demo), and the parts
/// that use the directory: registry, tickets, description of the running server, audit log. One thread at a time.
class ServerKeystore {
 public:
  /// Files of the directory.
  static constexpr const char* kKeyFile = "server_key.pem";
  static constexpr const char* kCertificateFile = "server_cert.pem";
  static constexpr const char* kTicketKeyFile = "ticket_key";
  static constexpr const char* kAuditFile = AuditLog::kFile;
  static constexpr const char* kMemberFile = "member.textproto";  ///< only of a server that belongs to a service

  /// Creates keys and empty lists in a directory that has none yet. @return the server's fingerprint
  [[nodiscard]] static std::expected<KeyFingerprint, std::string> init(const std::string& path, std::int64_t now);
  /// Replaces the key that signs tickets, which invalidates all issued tickets. Keys, workstations and codes stay.
  /// @return the error, such as a server that runs from the directory, or that belongs to a service
  [[nodiscard]] static std::string rotate_ticket_key(const std::string& path, std::int64_t now);
  /// Makes the server of a directory a member of a service, or renews its membership. From then on it signs and accepts
  /// tickets with the service's ticket key.
  /// @param member  text of the member file
  /// @param file    its name, for errors
  /// @param older   also takes a member file from before a rotation of the service's key that the present one knows
  /// @return the membership, or the error, such as a server that runs from the directory
  [[nodiscard]] static std::expected<ServiceMembership, std::string> join_service(const std::string& path,
                                                                                  std::span<const std::byte> member,
                                                                                  const std::string& file,
                                                                                  std::int64_t now, bool older = false);
  /// Reads a directory that `init` created.
  [[nodiscard]] static std::expected<ServerKeystore, std::string> open(const std::string& path);
  /// Returns all errors of such a directory, each with its remedy. Empty: `open` and `begin_serving` would succeed, if
  /// no other server runs from it. Changes nothing.
  [[nodiscard]] static std::vector<std::string> find_errors(const std::string& path);
  /// Creates ephemeral keys: nothing on disk, no workstation enrolled.
  [[nodiscard]] static ServerKeystore ephemeral(std::int64_t now);

  /// Marks this process as the one that serves from the directory, reads the redeemed tickets and removes expired ones.
  /// Required before tickets are redeemed. @return the error, such as another running server, or an expired voucher
  [[nodiscard]] std::string begin_serving(std::int64_t now);

  [[nodiscard]] const Identity& identity() const noexcept { return identity_; }
  [[nodiscard]] const TicketKey& ticket_key() const noexcept { return ticket_key_; }
  /// Membership in a service; null: the server belongs to none.
  [[nodiscard]] const ServiceMembership* membership() const noexcept { return membership_ ? &*membership_ : nullptr; }
  [[nodiscard]] bool on_disk() const noexcept { return folder_ != nullptr; }
  [[nodiscard]] const StateDirectory* folder() const noexcept { return folder_.get(); }

  [[nodiscard]] ServerRegistry& registry() noexcept { return registry_; }
  [[nodiscard]] TicketRedeemer& tickets() noexcept { return tickets_; }
  [[nodiscard]] const ServingFile& serving() const noexcept { return serving_; }

  /// Writes one line to the audit log; never pass a secret. Without a directory nothing is written. @return the error
  /// (AuditLog::write); the log keeps it too
  std::string audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail = {});
  /// Retries to write the lines that the audit log lost. @return the remaining error
  std::string retry_audit(std::int64_t now);
  /// Makes this process rotate the audit log from now on; otherwise it only appends.
  void enable_audit_rotation(const AuditLimits& limits) noexcept { audit_->enable_rotation(limits); }
  /// Lets a thread write the audit log from now on, so that `audit` never waits for the disk.
  void write_audit_behind() {
    if (folder_) audit_->write_behind(folder_);
  }
  [[nodiscard]] const AuditLog& audit_log() const noexcept { return *audit_; }

 private:
  /// As `open`, without the membership.
  [[nodiscard]] static std::expected<ServerKeystore, std::string> open_alone(const std::string& path);
  /// @param folder  null: ephemeral keys
  ServerKeystore(Identity identity, TicketKey ticket_key, std::shared_ptr<const StateDirectory> folder);

  Identity identity_;
  TicketKey ticket_key_;
  std::optional<ServiceMembership> membership_;
  std::shared_ptr<const StateDirectory> folder_;
  std::shared_ptr<AuditLog> audit_ = std::make_shared<AuditLog>();
  ServerRegistry registry_;
  TicketRedeemer tickets_;
  ServingFile serving_;
};

}  // namespace tandem::auth
