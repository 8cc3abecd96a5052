#include "common/io/clock.h"
#include "server/app/house.h"

/// Who comes back: to a seat whose connection was lost, or to a session that goes on after its server died.
namespace tandem::server {
namespace {

/// As long as a seat whose owner fell silent waits for him (Session::may_admit): he could not be heard while there was no server.
constexpr Duration kHeldAfterRestart = std::chrono::seconds(2);

}  // namespace

void House::remember(Room& room) {
  if (room.opening.kept == nullptr) return;
  const Checkpoint& from = room.opening.kept->checkpoint;
  room.sent_away = room.opening.kept->sent_away;
  for (std::size_t i = 0; i < room.claims.size(); ++i) {
    Claim& claim = room.claims[i];
    claim.resume_hash = from.seats[i].resume;
    claim.resumable = from.seats[i].resume != Checkpoint::Hash{};
    claim.force_scale = from.seats[i].force_scale;
    claim.back_until = room.opening.back_until;
    if (from.seats[i].taken && claim.resumable) claim.held_until = io::monotonic_now() + kHeldAfterRestart;
  }
  room.opening.kept = nullptr;  // read; it may go
}

Checkpoint::Hash House::bound_to(const WorkstationRow& workstation) const {
  // Where keys are made on the spot all clients share one, and another one after a restart.
  return trust_.on_disk() ? workstation.spki : Checkpoint::Hash{};
}

House::Back House::comes_back(const Claim& claim, const Secret<32>& secret, const WorkstationRow& workstation) const {
  if (!claim.resumable) return Back::kNo;
  const auto hash = resume_hash(secret.bytes, bound_to(workstation));
  if (equal_secret(hash, claim.resume_hash)) return Back::kByNewest;
  return claim.before_hash != Checkpoint::Hash{} && equal_secret(hash, claim.before_hash) ? Back::kByOneBefore : Back::kNo;
}

bool House::held_for_another(const Claim& claim) { return io::monotonic_now() < claim.held_until; }

bool House::too_late(const Claim& claim, Duration silence) {
  return silence > kResumeLife || (claim.back_until && io::monotonic_now() > *claim.back_until);
}

void House::give(Claim& claim, const Secret<32>& secret, const WorkstationRow& workstation, Entry& entry) const {
  claim.before_hash = claim.before_next;
  claim.resume_hash = entry.resume = resume_hash(secret.bytes, bound_to(workstation));
  claim.resumable = true;
  claim.force_scale = entry.force_scale = claim.offered_scale;
  claim.back_until.reset();
  claim.held_until = Time{};
}

}  // namespace tandem::server
