#include "common/io/clock.h"
#include "server/app/control/session_registry.h"

/// Resume: a client returns to a seat whose connection was lost, or to a session that a new server process restored.
namespace tandem::server {
namespace {

/// As long as the session reserves the seat of a silent owner (Participants::may_admit): without a server the owner
/// could not send.
constexpr Duration kReservedAfterRestart = std::chrono::seconds(2);

}  // namespace

void SessionRegistry::restore_reservations(SessionEntry& room) {
  if (room.registration.snapshot == nullptr) return;
  const Checkpoint& from = room.registration.snapshot->checkpoint;
  room.removed_workstations = room.registration.snapshot->removed_workstations;
  for (std::size_t i = 0; i < room.reservations.size(); ++i) {
    SeatReservation& claim = room.reservations[i];
    claim.resume_hash = from.seats[i].resume;
    claim.resumable = from.seats[i].resume != Checkpoint::Hash{};
    claim.force_scale = from.seats[i].force_scale;
    claim.resume_until = room.registration.resume_until;
    if (from.seats[i].taken && claim.resumable) claim.reserved_until = io::monotonic_now() + kReservedAfterRestart;
  }
  room.registration.snapshot = nullptr;  // read; the caller may destroy it
}

Checkpoint::Hash SessionRegistry::resume_binding(const WorkstationRow& workstation) const {
  // Ephemeral keys are shared by all clients and change with each start.
  return trust_.on_disk() ? workstation.spki : Checkpoint::Hash{};
}

SessionRegistry::ResumeMatch SessionRegistry::verify_resume_secret(const SeatReservation& claim,
                                                                   const Secret<32>& secret,
                                                                   const WorkstationRow& workstation) const {
  if (!claim.resumable) return ResumeMatch::kNone;
  const auto hash = resume_hash(secret.bytes, resume_binding(workstation));
  if (equal_secret(hash, claim.resume_hash)) return ResumeMatch::kLatest;
  return claim.previous_hash != Checkpoint::Hash{} && equal_secret(hash, claim.previous_hash) ? ResumeMatch::kPrevious
                                                                                              : ResumeMatch::kNone;
}

bool SessionRegistry::reserved_for_owner(const SeatReservation& claim) {
  return io::monotonic_now() < claim.reserved_until;
}

bool SessionRegistry::resume_expired(const SeatReservation& claim, Duration silence) {
  return silence > kResumeLife || (claim.resume_until && io::monotonic_now() > *claim.resume_until);
}

void SessionRegistry::rotate_resume_secret(SeatReservation& claim, const Secret<32>& secret,
                                           const WorkstationRow& workstation, SeatConnection& entry) const {
  claim.previous_hash = claim.next_previous_hash;
  claim.resume_hash = entry.resume = resume_hash(secret.bytes, resume_binding(workstation));
  claim.resumable = true;
  claim.force_scale = entry.force_scale = claim.offered_scale;
  claim.resume_until.reset();
  claim.reserved_until = Time{};
}

}  // namespace tandem::server
