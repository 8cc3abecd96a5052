#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "common/auth/io/audit_log.h"
#include "common/auth/io/state_directory.h"
#include "common/auth/registry.h"

namespace tandem::auth {

/// Workstations and codes of a server, in a state directory or in memory only. Lists in a directory are shared with
/// commands that run in parallel to the server. Each change reads the present file under a lock, and each look-up sees
/// the present file. Enrolments and revocations therefore take effect at once. One thread at a time.
class ServerRegistry {
 public:
  static constexpr const char* kWorkstationsFile = "workstations.textproto";
  static constexpr const char* kCodesFile = "codes.textproto";
  static constexpr const char* kLock = "lock";  ///< of the lists, for a change

  /// An error of the code (the user's) or of the registry (the server's).
  struct EnrollFailure {
    std::optional<EnrollError> fault;
    std::string text;
  };

  /// @param folder  null: the lists are in memory only
  ServerRegistry(std::shared_ptr<const StateDirectory> folder, std::shared_ptr<AuditLog> audit)
      : folder_(std::move(folder)), audit_(std::move(audit)) {}

  /// Returns the present list of workstations.
  [[nodiscard]] std::expected<std::vector<WorkstationRow>, std::string> workstations();
  /// @return the row; nullopt if the key is not or no longer enrolled; or the error of the list: no client may be
  /// admitted then
  [[nodiscard]] std::expected<std::optional<WorkstationRow>, std::string> find(const KeyFingerprint& workstation);
  /// Returns the number of issued codes that are still valid.
  [[nodiscard]] std::expected<std::size_t, std::string> pending_codes(std::int64_t now) const;

  [[nodiscard]] std::expected<WorkstationRow, EnrollFailure> enroll(const EnrolmentCode& code,
                                                                    const KeyFingerprint& fingerprint,
                                                                    std::int64_t now);
  [[nodiscard]] std::string issue_code(const EnrolmentCode& code, std::string_view workstation, std::int64_t now,
                                       std::int64_t not_after);
  [[nodiscard]] std::expected<Revoked, std::string> revoke(std::string_view name);
  /// Enrols without a code, for the demo workstation that the server creates itself.
  [[nodiscard]] std::string enroll_without_code(const WorkstationRow& row);

  /// Returns both present lists.
  [[nodiscard]] std::expected<RegistryLists, std::string> lists() const { return read(); }
  /// Whether a file of the lists has changed since the last call, or may have.
  [[nodiscard]] bool changed();
  /// Replaces both lists, if they are still `expected`, and writes who was enrolled or revoked at another server of the
  /// service to the audit log. @return whether they were; or the error
  [[nodiscard]] std::expected<bool, std::string> replace(const RegistryLists& expected, RegistryLists wanted,
                                                         std::int64_t now);

  /// Why the lists cannot be read; empty if they can.
  [[nodiscard]] std::string problem() const;

 private:
  using Lists = RegistryLists;
  [[nodiscard]] std::expected<Lists, std::string> read() const;
  /// Reads both lists under the lock, applies `change` and writes the changed lists.
  template <class Change>
  [[nodiscard]] std::string modify(Change change);
  void audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail = {});

  std::shared_ptr<const StateDirectory> folder_;
  std::shared_ptr<AuditLog> audit_;
  Lists lists_;                 ///< without a directory: the lists; with one: the workstations as last read
  StateDirectory::Stamp seen_;  ///< of the workstations' file as last read
  std::pair<StateDirectory::Stamp, StateDirectory::Stamp> compared_;  ///< as of the last call of `changed`
};

}  // namespace tandem::auth
