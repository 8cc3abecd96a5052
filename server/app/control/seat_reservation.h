#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "common/auth/ticket.h"
#include "common/base/secret.h"
#include "common/base/time.h"
#include "proto/spec/registry_spec.h"
#include "server/session/checkpoint.h"

namespace tandem::server {

/// Owner of one seat as the control plane knows it: the workstation, its resume secrets (as hashes) and a join in
/// progress. The session knows whether datagrams of the owner arrive. Times are those of one monotonic clock.
///
/// A join is `begin_join`, then `offer`, `admit` and `end_join`, or `end_join` at any point after a failure. At most
/// two secrets are valid: the latest, and the one before it until datagrams of the new connection arrive, because a
/// Welcome may be lost. Any thread, one at a time.
class SeatReservation {
 public:
  using Hash = Checkpoint::Hash;
  enum class ResumeMatch : std::uint8_t { kNone, kLatest, kPrevious };

  /// Restores the seat after a restart of the server. If it was taken, it is reserved for its owner for 2 s from `now`
  /// on.
  /// @param person  name of the owner; empty: not named
  void restore(const Checkpoint::Seat& seat, Time resume_until, Time now, std::string person = {}) noexcept;

  /// Which of the owner's secrets this is.
  /// @param workstation  key to which the secret is bound
  [[nodiscard]] ResumeMatch match(const Secret<32>& secret, const Hash& workstation) const noexcept;
  /// Whether a secret that matched is still valid, which it is for 10 min after its owner was lost.
  /// @param silence     of the seat, as the session reports it; zero for a free seat
  /// @param ever_heard  the session received datagrams of the newest connection
  [[nodiscard]] bool may_resume(ResumeMatch match, Duration silence, bool ever_heard, Time now) const noexcept;
  /// Whether the seat is reserved for its former owner, after a restart.
  [[nodiscard]] bool reserved(Time now) const noexcept { return now < reserved_until_; }
  [[nodiscard]] bool joining() const noexcept { return joining_; }

  void begin_join() noexcept {
    joining_ = true;
    join_void_ = false;
  }
  /// The join in progress must fail, because the seat is being taken away from its owner.
  void void_join() noexcept { join_void_ = true; }
  [[nodiscard]] bool join_void() const noexcept { return join_void_; }
  /// The client gets a Welcome. The seat's data change when `admit` follows.
  /// @param match   of its resume secret, which `may_resume` accepted; kNone: a new owner
  /// @param scale   share of the scene's force limit, 0 to 1
  /// @param ticket  redeemed for this join
  void offer(ResumeMatch match, bool ever_heard, double scale, const std::optional<auth::Id16>& ticket) noexcept;
  /// The client owns the seat from now on.
  /// @param cid     connection id of its datagrams
  /// @param secret  resume_hash of its new resume secret
  /// @param person  name in the ticket; empty: not named
  void admit(const WorkstationRow& owner, std::uint32_t cid, const Hash& secret, std::string person, Time now);
  /// @return the redeemed ticket, if the join ends before `admit`
  std::optional<auth::Id16> end_join() noexcept;

  /// Share of the scene's force limit that the owner's ticket allows, 0 to 1.
  [[nodiscard]] double force_scale() const noexcept { return force_scale_; }
  /// Current or last owner; nullopt: none, or removed.
  [[nodiscard]] const std::optional<WorkstationRow>& owner() const noexcept { return owner_; }
  /// Connection id of the current or last owner.
  [[nodiscard]] std::uint32_t cid() const noexcept { return cid_; }
  /// Name of the current or last owner, from the ticket; empty: not named.
  [[nodiscard]] const std::string& person() const noexcept { return person_; }
  /// Name of the owner at a time; empty: not named, or earlier than the last two owners.
  [[nodiscard]] std::string person_at(Time t) const {
    return t >= since_ ? person_ : t >= previous_since_ ? previous_person_ : std::string{};
  }
  /// Whether the owner was admitted at or after this time.
  [[nodiscard]] bool admitted_since(Time t) const noexcept { return owner_ && since_ >= t; }
  /// Whether this connection owns the seat.
  [[nodiscard]] bool owned_by(std::uint32_t cid) const noexcept { return cid_ == cid && owner_; }

  /// Invalidates the resume secrets. @return false: they were invalid
  bool expire() noexcept { return std::exchange(resumable_, false); }
  /// The seat has no owner any more.
  void release() noexcept { owner_.reset(); }
  /// Takes the seat away from its owner, whose secrets expire. @param why actor and reason  @return the owner
  std::optional<WorkstationRow> remove_owner(std::string why);
  /// Actor and reason if the seat was taken away from this connection; empty otherwise.
  [[nodiscard]] std::string lost_reason(std::uint32_t cid) const { return lost_cid_ == cid ? lost_why_ : ""; }

 private:
  bool joining_ = false;
  bool join_void_ = false;
  std::optional<auth::Id16> ticket_;  ///< of the join in progress
  std::optional<WorkstationRow> owner_;
  std::uint32_t cid_ = 0;
  bool resumable_ = false;
  Hash latest_{}, previous_{};
  Hash next_previous_{};  ///< `previous_` if the join in progress succeeds
  double force_scale_ = 1, offered_scale_ = 1;
  /// After a restart, until the owner is back. Otherwise the session knows for how long the owner is silent.
  std::optional<Time> resume_until_;
  Time reserved_until_{};
  std::string person_, previous_person_;
  Time since_{}, previous_since_{};  ///< start of the time of `person_`, of `previous_person_`
  std::uint32_t lost_cid_ = 0;       ///< connection from which the seat was taken away last
  std::string lost_why_;
};

}  // namespace tandem::server
