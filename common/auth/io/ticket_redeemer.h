#pragma once

#include <cstdint>
#include <expected>
#include <memory>
#include <optional>
#include <span>
#include <string>

#include "common/auth/io/state_directory.h"
#include "common/auth/redeemed_tickets.h"
#include "common/auth/ticket.h"

namespace tandem::auth {

/// Redeems join tickets, each once. With a state directory a redeemed ticket is on disk before `redeem` returns, so
/// that no crash makes it valid again. One thread at a time.
class TicketRedeemer {
 public:
  static constexpr const char* kFile = "used_tickets";

  struct Failure {
    std::optional<TicketError> fault;  ///< nullopt: the list could not be written, `text` gives the reason, and the
                                       ///< ticket is as valid as before
    std::string text;
  };

  /// @param folder  null: tickets are stored in memory only
  TicketRedeemer(const TicketVerifier& verifier, std::shared_ptr<const StateDirectory> folder)
      : verifier_(verifier), folder_(std::move(folder)) {}

  /// Reads the redeemed tickets and removes expired ones. Required before `redeem` if there is a directory; only the
  /// process that serves from the directory may call it. @return the error
  [[nodiscard]] std::string begin(std::int64_t now);
  /// Checks and redeems a ticket.
  [[nodiscard]] std::expected<Ticket, Failure> redeem(std::span<const std::byte> bytes, const TicketUse& use);
  /// Whether a ticket that may be used thus was redeemed already. A ticket that is wrong in any other way is not.
  [[nodiscard]] bool was_redeemed(std::span<const std::byte> bytes, const TicketUse& use) const;
  /// Makes a redeemed ticket valid again if its use had no effect: the client got no seat, or none of its commands was
  /// executed. If the server ends in between, the ticket stays redeemed. @return the error
  [[nodiscard]] std::string restore(const Id16& ticket);

  /// Reads the file of a directory. @return the list, or the error with its remedy
  [[nodiscard]] static std::expected<RedeemedTickets, std::string> read(const StateDirectory& folder);

 private:
  [[nodiscard]] std::string rewrite(std::int64_t now);
  [[nodiscard]] std::string write(const Id16& ticket, std::int64_t not_after, std::int64_t now);

  TicketVerifier verifier_;
  std::shared_ptr<const StateDirectory> folder_;
  RedeemedTickets used_;
  bool begun_ = false;
  std::size_t appended_ = 0;  ///< lines since the file was last rewritten
  bool unsure_ = false;       ///< a change of the file failed: the next change rewrites it
};

}  // namespace tandem::auth
