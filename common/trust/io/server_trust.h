#pragma once

#include <cstdint>
#include <expected>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "common/trust/books.h"
#include "common/trust/io/audit_log.h"
#include "common/trust/io/state_folder.h"
#include "common/trust/ticket.h"
#include "common/trust/tls_key.h"
#include "common/trust/used_tickets.h"

namespace tandem::trust {

/// What a server must have to know anybody: its key, its ticket key, its books. In a state folder, or thrown away at the end (loopback
/// demo). Books in a folder are shared with the commands beside a running server: each change is made under a lock over what the file
/// says now, and each look-up sees the file as it is now, so an enrolment or a revocation works at once.
/// One thread at a time.
class ServerTrust {
 public:
  /// Files of the folder.
  static constexpr const char* kKeyFile = "server_key.pem";
  static constexpr const char* kCertificateFile = "server_cert.pem";
  static constexpr const char* kTicketKeyFile = "ticket_key";
  static constexpr const char* kWorkstationsFile = "workstations.textproto";
  static constexpr const char* kCodesFile = "codes.textproto";
  static constexpr const char* kUsedFile = "used_tickets";
  static constexpr const char* kServingFile = "serving.textproto";
  static constexpr const char* kAuditFile = AuditLog::kFile;
  static constexpr const char* kEndFile = "end_in_s";
  static constexpr const char* kLock = "lock";  ///< of the books, for a change
  static constexpr const char* kServingLock = "serving.lock";

  /// Makes keys and empty books in a folder that has none yet. @return the server's pin
  [[nodiscard]] static std::expected<Pin, std::string> init(const std::string& path, std::int64_t now);
  /// Replaces the key that signs tickets: every ticket given out before is void. Keys, workstations and codes
  /// stay. @return what is wrong, such as a server that runs from the folder
  [[nodiscard]] static std::string renew_ticket_key(const std::string& path, std::int64_t now);
  /// Reads a folder that `init` made.
  [[nodiscard]] static std::expected<ServerTrust, std::string> open(const std::string& path);
  /// Everything that is wrong with such a folder, each with its remedy; empty: `open` and `begin_serving` would succeed, if no other
  /// server runs from it. Changes nothing.
  [[nodiscard]] static std::vector<std::string> mistakes(const std::string& path);
  /// Keys made on the spot, nothing on disk, nobody enrolled.
  [[nodiscard]] static ServerTrust throw_away(std::int64_t now);

  /// Marks this process as the one that serves from the folder, reads the used tickets and forgets expired ones. Needed before
  /// `redeem`. @return what is wrong, such as another server running
  [[nodiscard]] std::string begin_serving(std::int64_t now);

  [[nodiscard]] const Identity& identity() const noexcept { return identity_; }
  [[nodiscard]] const TicketKey& ticket_key() const noexcept { return ticket_key_; }
  [[nodiscard]] bool on_disk() const noexcept { return folder_.has_value(); }
  [[nodiscard]] const StateFolder* folder() const noexcept { return folder_ ? &*folder_ : nullptr; }

  /// As the book stands now.
  [[nodiscard]] std::expected<std::vector<WorkstationRow>, std::string> workstations();
  /// How many codes were given out and are still good: workstations that are about to be enrolled.
  [[nodiscard]] std::expected<std::size_t, std::string> open_codes(std::int64_t now) const;
  /// @return the row, nothing if the key is not enrolled (any more), or what is wrong with the book: then nobody may be let in
  [[nodiscard]] std::expected<std::optional<WorkstationRow>, std::string> find(const Pin& workstation);

  /// Both faults of a code (a person's) and of the books (ours).
  struct EnrolTrouble {
    std::optional<EnrolFault> fault;
    std::string text;
  };
  [[nodiscard]] std::expected<WorkstationRow, EnrolTrouble> enrol(const EnrolmentCode& code, const Pin& pin, std::int64_t now);
  [[nodiscard]] std::string give_out(const EnrolmentCode& code, std::string_view workstation, std::int64_t now, std::int64_t not_after);
  [[nodiscard]] std::expected<Revoked, std::string> revoke(std::string_view name);
  /// Without a code, for the workstation of the demo that the server makes itself.
  [[nodiscard]] std::string enrol_directly(const WorkstationRow& row);

  struct TicketTrouble {
    std::optional<TicketFault> fault;  ///< nothing: the book could not be written, `text` says why, and the ticket is as good as before
    std::string text;
  };
  /// Checks a ticket and uses it up: it is on disk before this returns, so that no crash makes it good again.
  [[nodiscard]] std::expected<Ticket, TicketTrouble> redeem(std::span<const std::byte> bytes, const TicketUse& use);

  /// Makes a redeemed ticket good again, of which nothing came: whoever had it got no seat, or no order of his was carried out. A server
  /// that dies in between leaves it used up. @return what is wrong
  [[nodiscard]] std::string give_back(const Id16& ticket);

  /// Asks the server that runs from this folder to end: no newcomers from now on, all hands let go in `grace_s`. @return what is wrong
  [[nodiscard]] std::string ask_to_end(std::uint32_t grace_s) const;
  /// For that server: what was asked since it began, once. Costs one system call.
  [[nodiscard]] std::optional<std::uint32_t> asked_to_end() const;

  /// For the commands beside a running server. @return what is wrong
  [[nodiscard]] std::string write_serving(const ServingSpec& serving) const;
  /// Nothing: no server is running.
  [[nodiscard]] std::expected<std::optional<ServingSpec>, std::string> read_serving() const;
  /// Writes one line to the audit log. Never a secret. No folder: nothing is written. @return what is wrong; the log remembers it too
  std::string audit(std::int64_t now, std::string_view event, std::string_view name, std::string_view detail = {});
  /// Tries again to write what the audit log owes. @return what is wrong still
  std::string retry_audit(std::int64_t now);
  /// From now on this process rotates the audit log; else it only appends.
  void keep_audit(const AuditLimits& limits) noexcept { audit_.keep(limits); }
  [[nodiscard]] const AuditLog& audit_log() const noexcept { return audit_; }

  ~ServerTrust();
  ServerTrust(ServerTrust&&) noexcept = default;
  ServerTrust& operator=(ServerTrust&&) noexcept = default;

 private:
  ServerTrust(Identity identity, TicketKey ticket_key) : identity_(std::move(identity)), ticket_key_(std::move(ticket_key)) {}

  struct Books {
    std::vector<WorkstationRow> workstations;
    std::vector<CodeRow> codes;
  };
  [[nodiscard]] std::expected<Books, std::string> read_books() const;
  /// Under the lock: reads both books, lets `change` work on them, writes what changed.
  template <class Change>
  [[nodiscard]] std::string change_books(Change change);
  [[nodiscard]] std::string rewrite_used(std::int64_t now);
  [[nodiscard]] std::string write_used(const Id16& ticket, std::int64_t not_after, std::int64_t now);

  Identity identity_;
  TicketKey ticket_key_;
  std::optional<StateFolder> folder_;
  StateFolder::Lock serving_;
  Books books_;               ///< without a folder: the books; with one: workstations as last read
  StateFolder::Stamp seen_;   ///< of the workstations' file as last read
  UsedTickets used_;
  std::size_t appended_ = 0;  ///< lines since the file of used tickets was written anew
  bool used_unsure_ = false;  ///< a change of that file failed: it is written anew with the next one
  AuditLog audit_;
};

}  // namespace tandem::trust
