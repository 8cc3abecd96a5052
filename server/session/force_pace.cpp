#include "server/session/force_pace.h"

#include <algorithm>
#include <cmath>

namespace tandem::server {

namespace {

bool same_contacts(const LocalContactList& a, const LocalContactList& b) noexcept {
  return std::ranges::equal(a.all(), b.all());
}
/// The pull of a slave follows from filtered delays, so it moves a little at every tick. One part in a hundred of the
/// coupling's stiffness is less than a hand notices (15 to 25 %).
bool same_pull(double a, double b) noexcept {
  constexpr double kStep = 0.01;
  return (a > 0) == (b > 0) && std::abs(a - b) <= kStep;
}
bool same_part(const wire::ToolForce& a, const wire::ToolForce& b) noexcept {
  return a.alpha == b.alpha && same_pull(a.slave_pull, b.slave_pull) && same_contacts(a.contacts, b.contacts);
}
/// The leader's hand as a sample, for the dead-band.
PortSample sample_of(const wire::Ghost& ghost) noexcept {
  PortSample out;
  for (std::size_t a = 0; a < ghost.x.size(); ++a) {
    out.x[a] = ghost.x[a];
    out.v[a] = ghost.v[a];
  }
  return out;
}

}  // namespace

ForcePace::ForcePace(const SeatSetup& setup)
    : dof_(setup.dof),
      copies_(setup.channel.law == LawKind::kReplica),
      assists_(setup.seat.assist.force > 0),
      pace_(setup::send_pace(setup, control::Side::kServer), 2 + setup.further.size()),
      further_(setup.further.size()) {}

bool ForcePace::changed(const wire::ForceMessage& force, std::span<const wire::ToolForce> further) const noexcept {
  if (force.session != last_.session || force.engage != last_.engage ||
      force.authority_version != last_.authority_version || force.missing != last_.missing ||
      force.stops != last_.stops || force.transfer != last_.transfer || force.transfer_ticks != last_.transfer_ticks ||
      force.transfer_parties != last_.transfer_parties || force.touching != last_.touching ||
      force.telemetry_every_tick != last_.telemetry_every_tick || force.ghost.leader != last_.ghost.leader ||
      !same_part(force, last_))
    return true;
  for (std::size_t k = 0; k < further.size(); ++k)
    if (!same_part(further[k], further_[k])) return true;
  return false;
}

bool ForcePace::noticeable(std::uint32_t tick, std::size_t tool, const wire::ToolForce& force,
                           double pull) const noexcept {
  const bool acts = !copies_ || force.alpha < 1 || force.slave_pull > 0;
  return pace_.noticeable(tick, tool, force.port, pull, acts);
}

bool ForcePace::due(std::uint32_t tick, const wire::ForceMessage& force, std::span<const wire::ToolForce> further,
                    bool engaged, const PortSample& pull) noexcept {
  if (!engaged || changed(force, further)) changed_ = tick;
  if (tick - changed_ < kRepeats) return true;
  if (!pace_.allowed(tick)) return false;
  if (pace_.overdue(tick)) return true;
  double norm = 0;
  for (std::size_t a = 0; a < dof_; ++a) norm += pull.f[a] * pull.f[a];
  norm = std::sqrt(norm);
  if (noticeable(tick, 0, force, norm)) return true;
  for (std::size_t k = 0; k < further.size(); ++k)
    if (noticeable(tick, 1 + k, further[k], norm)) return true;
  return assists_ && pace_.noticeable(tick, 1 + further.size(), sample_of(force.ghost), norm);
}

void ForcePace::sent(std::uint32_t tick, const wire::ForceMessage& force,
                     std::span<const wire::ToolForce> further) noexcept {
  pace_.record(0, force.port);
  for (std::size_t k = 0; k < further.size(); ++k) {
    pace_.record(1 + k, further[k].port);
    further_[k] = further[k];
  }
  pace_.record(1 + further.size(), sample_of(force.ghost));
  pace_.sent(tick);
  last_ = force;
}

}  // namespace tandem::server
