#include "server/app/control/seat_reservation.h"

#include <utility>

#include "server/session/session_snapshot.h"

namespace tandem::server {
namespace {

/// As long as the session reserves the seat of a silent owner (Session::may_admit): without a server the owner could
/// not send.
constexpr Duration kReservedAfterRestart = std::chrono::seconds(2);

}  // namespace

void SeatReservation::restore(const Checkpoint::Seat& seat, Time resume_until, Time now, std::string person) noexcept {
  latest_ = seat.resume;
  resumable_ = seat.resume != Hash{};
  force_scale_ = seat.force_scale;
  resume_until_ = resume_until;
  person_ = std::move(person);
  if (seat.taken && resumable_) reserved_until_ = now + kReservedAfterRestart;
}

SeatReservation::ResumeMatch SeatReservation::match(const Secret<32>& secret, const Hash& workstation) const noexcept {
  if (!resumable_) return ResumeMatch::kNone;
  const Hash hash = resume_hash(secret.bytes, workstation);
  if (equal_secret(hash, latest_)) return ResumeMatch::kLatest;
  return previous_ != Hash{} && equal_secret(hash, previous_) ? ResumeMatch::kPrevious : ResumeMatch::kNone;
}

bool SeatReservation::may_resume(ResumeMatch match, Duration silence, bool ever_heard, Time now) const noexcept {
  if (match == ResumeMatch::kNone || (match == ResumeMatch::kPrevious && ever_heard)) return false;
  return silence <= kResumeLife && (!resume_until_ || now <= *resume_until_);
}

void SeatReservation::offer(ResumeMatch match, bool ever_heard, double scale,
                            const std::optional<auth::Id16>& ticket) noexcept {
  ticket_ = ticket;
  offered_scale_ = scale;
  next_previous_ = match == ResumeMatch::kNone ? Hash{} : ever_heard || resume_until_ ? latest_ : previous_;
}

void SeatReservation::admit(const WorkstationRow& owner, std::uint32_t cid, const Hash& secret, std::string person,
                            Time now) {
  ticket_.reset();  // it is used
  owner_ = owner;
  cid_ = cid;
  previous_person_ = std::exchange(person_, std::move(person));
  previous_since_ = std::exchange(since_, now);
  previous_ = next_previous_;
  latest_ = secret;
  resumable_ = true;
  force_scale_ = offered_scale_;
  resume_until_.reset();
  reserved_until_ = Time{};
}

std::optional<auth::Id16> SeatReservation::end_join() noexcept {
  joining_ = false;
  return std::exchange(ticket_, std::nullopt);
}

std::optional<WorkstationRow> SeatReservation::remove_owner(std::string why) {
  lost_cid_ = cid_;
  lost_why_ = std::move(why);
  resumable_ = false;
  return std::exchange(owner_, std::nullopt);
}

}  // namespace tandem::server
