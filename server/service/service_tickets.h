#pragma once

#include <cstdint>
#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>

#include "server/directory/ownership.h"

namespace tandem::server {

/// Uses of join tickets in a whole service: each ticket once. A use is a key of the directory under a lease that ends
/// after the ticket, so that the directory forgets it without a sweep, and without a look at any wall clock.
class ServiceTickets {
 public:
  enum class Outcome : std::uint8_t {
    kAccepted,
    kUsed,      ///< used before
    kNoAnswer,  ///< the directory does not answer, or this server owns the session no more; to be tried again
  };
  struct Result {
    std::uint64_t order = 0;
    Outcome outcome = Outcome::kNoAnswer;
  };
  static constexpr Duration kAnswerLimit = std::chrono::seconds(3);
  /// Tickets that end in one period share a lease, which ends one period later.
  static constexpr Duration kPeriod = std::chrono::hours(1);
  static constexpr Duration kLifeMax = std::chrono::hours(24);
  static constexpr Duration kAskAgain = std::chrono::milliseconds(100);  ///< after an error of a grant or a restore
  static constexpr std::size_t kWaitingMax = 1024;
  /// Tickets of which this server knows that it has used them; further ones cannot be restored.
  static constexpr std::size_t kAcceptedMax = 65536;

  /// @param ownership  must outlive this
  ServiceTickets(directory::Ownership& ownership, directory::DirectoryKeys keys)
      : ownership_(ownership), keys_(std::move(keys)) {}

  /// Uses a ticket for a session of this server; a result with this `order` follows.
  /// @param life   for which the ticket stays valid, at most kLifeMax
  /// @param again  as `directory::Ownership::use_ticket`
  void use(Time now, const std::string& session, const std::string& ticket, Duration life, std::uint64_t order,
           bool again = false);
  /// Makes a ticket valid again whose use this server was granted; any other stays as it is.
  void restore(const std::string& session, const std::string& ticket);
  /// Uses get new leases: those of a directory that is lost do not exist.
  void forget_leases() { leases_.clear(); }
  /// Whether a ticket of the session is not yet valid again in the directory.
  [[nodiscard]] bool restoring(std::string_view session) const noexcept;
  [[nodiscard]] bool restoring() const noexcept { return !restores_.empty(); }
  /// Whether the use of a ticket for the session is under way.
  [[nodiscard]] bool uses_wait(std::string_view session) const noexcept;
  /// Takes a notice about a ticket.
  void on_notice(const directory::Notice& notice);

  /// Returns the request to begin now, if there is one, after it has passed waiting uses to the ownership.
  [[nodiscard]] std::optional<directory::Request> poll_request(Time now, directory::OperationId operation,
                                                               Duration retry_after);
  /// Takes a reply. Returns whether it belongs to this object.
  bool on_reply(const directory::Reply& reply);
  [[nodiscard]] std::optional<Result> poll_result();

 private:
  struct Use {
    std::string session;
    std::uint64_t order = 0;  ///< 0: its result was reported already
    std::int64_t period = 0;
    bool asked = false, again = false;
    Time ends{};
  };
  struct Accepted {
    std::int64_t period = 0;
    directory::Revision revision = 0;  ///< of the use
  };
  struct Restore {
    std::string session, ticket;
    directory::Revision owner = 0, use = 0;
  };

  void pass_on(Time now);

  directory::Ownership& ownership_;
  directory::DirectoryKeys keys_;
  std::map<std::string, Use> uses_;                    ///< by ticket
  std::map<std::string, Accepted> accepted_;           ///< by ticket
  std::map<std::int64_t, directory::LeaseId> leases_;  ///< by period
  std::deque<Restore> restores_;
  std::deque<Result> results_;
  directory::OperationId operation_ = 0;  ///< under way: a grant or a restore; 0: none
  std::optional<std::int64_t> granting_;  ///< period of the grant; nullopt: a restore
  Time sent_{};
  Duration pause_{};  ///< before the next one, since `sent_`
};

}  // namespace tandem::server
