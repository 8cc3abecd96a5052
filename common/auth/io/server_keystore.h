#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/auth/io/audit_log.h"
#include "common/auth/io/state_directory.h"
#include "common/auth/redeemed_tickets.h"
#include "common/auth/registry.h"
#include "common/auth/ticket.h"
#include "common/auth/tls_key.h"

namespace tandem::auth {

/// Key store and registry of a server: its key, its ticket key, its workstations and codes. They are in a state
/// directory, or in memory only (loopback demo). Lists in a directory are shared with commands that run in parallel to
/// the server. Each change reads the present file under a lock, and each look-up sees the present file. Enrolments and
/// revocations therefore take effect at once. One thread at a time.
class ServerKeystore {
 public:
  /// Files of the directory.
  static constexpr const char* kKeyFile = "server_key.pem";
  static constexpr const char* kCertificateFile = "server_cert.pem";
  static constexpr const char* kTicketKeyFile = "ticket_key";
  static constexpr const char* kWorkstationsFile = "workstations.textproto";
  static constexpr const char* kCodesFile = "codes.textproto";
  static constexpr const char* kUsedFile = "used_tickets";
  static constexpr const char* kServingFile = "serving.textproto";
  static constexpr const char* kAuditFile = AuditLog::kFile;
  static constexpr const char* kEndFile = "end_in_s";
  static constexpr const char* kLock = "lock";  ///< of the lists, for a change
  static constexpr const char* kServingLock = "serving.lock";

  /// Creates keys and empty lists in a directory that has none yet. @return the server's fingerprint
  [[nodiscard]] static std::expected<KeyFingerprint, std::string> init(const std::string& path, std::int64_t now);
  /// Replaces the key that signs tickets, which invalidates all issued tickets. Keys, workstations and codes stay.
  /// @return the error, such as a server that runs from the directory
  [[nodiscard]] static std::string rotate_ticket_key(const std::string& path, std::int64_t now);
  /// Reads a directory that `init` created.
  [[nodiscard]] static std::expected<ServerKeystore, std::string> open(const std::string& path);
  /// Returns all errors of such a directory, each with its remedy. Empty: `open` and `begin_serving` would succeed, if
  /// no other server runs from it. Changes nothing.
  [[nodiscard]] static std::vector<std::string> find_errors(const std::string& path);
  /// Creates ephemeral keys: nothing on disk, no workstation enrolled.
  [[nodiscard]] static ServerKeystore ephemeral(std::int64_t now);

  /// Marks this process as the one that serves from the directory, reads the redeemed tickets and removes expired ones.
  /// Required before `redeem`. @return the error, such as another running server
  [[nodiscard]] std::string begin_serving(std::int64_t now);

  [[nodiscard]] const Identity& identity() const noexcept { return identity_; }
  [[nodiscard]] const TicketKey& ticket_key() const noexcept { return ticket_key_; }
  [[nodiscard]] bool on_disk() const noexcept { return folder_.has_value(); }
  [[nodiscard]] const StateDirectory* folder() const noexcept { return folder_ ? &*folder_ : nullptr; }

  /// Returns the present list of workstations.
  [[nodiscard]] std::expected<std::vector<WorkstationRow>, std::string> workstations();
  /// Returns the number of issued codes that are still valid.
  [[nodiscard]] std::expected<std::size_t, std::string> pending_codes(std::int64_t now) const;
  /// @return the row; nullopt if the key is not or no longer enrolled; or the error of the list: no client may be
  /// admitted then
  [[nodiscard]] std::expected<std::optional<WorkstationRow>, std::string> find(const KeyFingerprint& workstation);

  /// An error of the code (the user's) or of the registry (the server's).
  struct EnrollFailure {
    std::optional<EnrollError> fault;
    std::string text;
  };
  [[nodiscard]] std::expected<WorkstationRow, EnrollFailure> enroll(const EnrolmentCode& code,
                                                                    const KeyFingerprint& fingerprint,
                                                                    std::int64_t now);
  [[nodiscard]] std::string issue_code(const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                                       std::int64_t not_after);
  [[nodiscard]] std::expected<Revoked, std::string> revoke(std::string_view name);
  /// Enrols without a code, for the demo workstation that the server creates itself.
  [[nodiscard]] std::string enroll_without_code(const WorkstationRow& row);

  struct RedeemFailure {
    std::optional<TicketError> fault;  ///< nullopt: the list could not be written, `text` gives the reason, and the
                                       ///< ticket is as valid as before
    std::string text;
  };
  /// Checks and redeems a ticket. It is on disk before this returns, so that no crash makes the ticket valid again.
  [[nodiscard]] std::expected<Ticket, RedeemFailure> redeem(std::span<const std::byte> bytes, const TicketUse& use);

  /// Makes a redeemed ticket valid again if its use had no effect: the client got no seat, or none of its commands was
  /// executed. If the server ends in between, the ticket stays redeemed. @return the error
  [[nodiscard]] std::string restore_ticket(const Id16& ticket);

  /// Requests the server that runs from this directory to end: it rejects new joins at once and disengages all hands in
  /// `grace_s`.
  /// @return the error
  [[nodiscard]] std::string request_shutdown(std::uint32_t grace_s) const;
  /// For that server: returns a request made since it began, once. Costs one system call.
  [[nodiscard]] std::optional<std::uint32_t> requested_shutdown() const;

  /// For commands that run in parallel to the server. @return the error
  [[nodiscard]] std::string write_serving(const ServingSpec& serving) const;
  /// Returns the description of the running server; nullopt: no server is running.
  [[nodiscard]] std::expected<std::optional<ServingSpec>, std::string> read_serving() const;
  /// Writes one line to the audit log; never pass a secret. Without a directory nothing is written. @return the error;
  /// the log keeps it too
  std::string audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail = {});
  /// Retries to write the lines that the audit log lost. @return the remaining error
  std::string retry_audit(std::int64_t now);
  /// Makes this process rotate the audit log from now on; otherwise it only appends.
  void enable_audit_rotation(const AuditLimits& limits) noexcept { audit_.enable_rotation(limits); }
  [[nodiscard]] const AuditLog& audit_log() const noexcept { return audit_; }

  ~ServerKeystore();
  ServerKeystore(ServerKeystore&&) noexcept = default;
  ServerKeystore& operator=(ServerKeystore&&) noexcept = default;

 private:
  ServerKeystore(Identity identity, TicketKey ticket_key)
      : identity_(std::move(identity)), ticket_key_(std::move(ticket_key)) {}

  struct Books {
    std::vector<WorkstationRow> workstations;
    std::vector<CodeRow> codes;
  };
  [[nodiscard]] std::expected<Books, std::string> read_books() const;
  /// Reads both lists under the lock, applies `change` and writes the changed lists.
  template <class Change>
  [[nodiscard]] std::string change_books(Change change);
  [[nodiscard]] std::string rewrite_used(std::int64_t now);
  [[nodiscard]] std::string write_used(const Id16& ticket, std::int64_t not_after, std::int64_t now);

  Identity identity_;
  TicketKey ticket_key_;
  std::optional<StateDirectory> folder_;
  StateDirectory::Lock serving_;
  Books books_;                 ///< without a directory: the lists; with one: the workstations as last read
  StateDirectory::Stamp seen_;  ///< of the workstations' file as last read
  RedeemedTickets used_;
  std::size_t appended_ = 0;  ///< lines since the file of redeemed tickets was last rewritten
  bool used_unsure_ = false;  ///< a change of that file failed: the next change rewrites it
  AuditLog audit_;
};

}  // namespace tandem::auth
