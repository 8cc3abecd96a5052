#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "server/directory/directory.h"
#include "server/directory/directory_keys.h"
#include "server/directory/lease_times.h"

namespace tandem::directory {

/// Keeps a server registered under a lease, and knows until when the server may rely on it.
///
/// A renewal counts from the time at which it was sent, and only when a transaction that was sent after its answer has
/// been answered in the same term. The reason: the leader of etcd 3.4 answers renewals without asking its quorum. A
/// leader that was deposed without knowing it can answer for about an election timeout. A transaction needs the quorum.
class LeaseKeeper {
 public:
  enum class Event : std::uint8_t {
    kGranted,    ///< a new lease; nothing is owned under it yet
    kLost,       ///< the store has ended the lease; everything under it is gone
    kNameTaken,  ///< another server, or the one before a restart, is registered under this name; tried again
  };

  /// @pre `times.problem()` is empty and `server` is a valid name
  LeaseKeeper(std::string server, std::string text, LeaseTimes times, DirectoryKeys keys);

  /// Sets the text of the registration; it is written with the next request.
  void describe(std::string text) { text_ = std::move(text); }

  /// Returns the request to send at `now`, if there is one. The caller sends it after this call, never before.
  [[nodiscard]] std::optional<Request> poll_request(Time now, OperationId operation);
  /// Takes a reply. Returns whether it belongs to this object.
  bool on_reply(Time now, const Reply& reply);
  [[nodiscard]] std::optional<Event> poll_event();
  /// Takes the answer to a transaction that named this lease: the store has no such lease any more.
  void on_no_lease(LeaseId lease);

  [[nodiscard]] LeaseId lease() const noexcept { return lease_; }
  [[nodiscard]] bool registered() const noexcept { return lease_ != 0 && registered_; }
  /// Time from which the server holds its sessions. The past, without a lease.
  [[nodiscard]] Time hold_at() const noexcept { return counted_from_ + times_.hold_after; }
  /// Time from which no effort is left.
  [[nodiscard]] Time quiet_at() const noexcept { return hold_at() + times_.ramp; }
  /// Renewals that were answered but did not count, because the term had changed.
  [[nodiscard]] std::uint64_t doubtful_renewals() const noexcept { return doubtful_; }

 private:
  enum class Stage : std::uint8_t { kIdle, kGranting, kRenewing, kToConfirm, kConfirming, kRegistering };
  void lose();
  void on_confirmed(const Reply& reply);
  void on_registration(Time now, const Reply& reply);

  std::string server_, text_, written_text_, sent_text_;
  LeaseTimes times_;
  DirectoryKeys keys_;
  Stage stage_ = Stage::kIdle;
  OperationId operation_ = 0;
  Time stage_began_{}, next_renewal_{}, next_attempt_{};
  LeaseId lease_ = 0;
  bool registered_ = false;
  Time counted_from_{};     ///< sending time of the newest renewal that counts
  Time renewal_sent_{};     ///< of the renewal that is under way
  std::uint64_t term_ = 0;  ///< in its answer
  std::optional<Event> event_, next_event_;
  std::uint64_t doubtful_ = 0;
};

}  // namespace tandem::directory
