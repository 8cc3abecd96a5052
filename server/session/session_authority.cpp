#include <algorithm>
#include <cmath>

#include "server/session/session.h"

/// Authority changes: permission checks, scheduling with `AuthorityTransfer::kNotice` ticks of notice, execution and
/// cancellation (design notes, security 2.5).
namespace tandem::server {

namespace {
constexpr double kAuthorityTolerance = 1e-9;                           // of a difference of two authorities
constexpr Duration kRejectionEventInterval = std::chrono::seconds(1);  // of stale-link rejections, per session
// [s] for which FORCE reports a cancellation, because single datagrams may be lost.
constexpr double kCancelledTransferShown = 0.1;
}  // namespace

control::MasterArray Session::weights_of(const AuthorityRow& row) const noexcept {
  control::MasterArray w{};
  for (std::size_t i = 0; i < masters_; ++i) w[i] = row.alpha[i];
  return w;
}

/// Instructors may set the authority of all seats. Roles with a partial right may only give up their own, to
/// instructors; all other authorities must stay.
void Session::handle_authority_request(Time now, std::size_t i, const wire::AuthorityMessage& wish) noexcept {
  const AuthorityResult result = set_authority(now, seats_[i].role(), i, static_cast<std::uint8_t>(i), wish);
  if (result == AuthorityResult::kForbidden) reject_forbidden(now, i);
}

Session::AuthorityResult Session::set_authority(Time now, AccessRole who, std::size_t seat, std::uint8_t noted,
                                                const wire::AuthorityMessage& wish) noexcept {
  if (wish.tool >= tools().size() || wish.masters != masters_) return AuthorityResult::kInvalid;
  const Grant grant = allowed(who, Right::kAuthority);
  const control::MasterArray& before = tools()[wish.tool].transfer.scheduled();
  bool may = grant != Grant::kNo;
  // The server checks which seats may drive; it does not rely on the client.
  for (std::size_t k = 0; k < masters_; ++k) {
    const AccessRole whose = seats_[k].role();
    may = may && (wish.alpha[k] == 0 || allowed(whose, Right::kDrive) != Grant::kNo);
    if (grant == Grant::kYes) continue;
    const double gain = wish.alpha[k] - before[k];
    const bool instructor = allowed(whose, Right::kAuthority) == Grant::kYes;
    may = may && (k == seat    ? gain <= kAuthorityTolerance
                  : instructor ? gain >= -kAuthorityTolerance
                               : std::abs(gain) <= kAuthorityTolerance);
  }
  if (wish.version != authority_version_)
    return AuthorityResult::kOutdated;  // another change was faster: FORCE carries the newer authority
  if (!may) return AuthorityResult::kForbidden;
  const auto weights = tools()[wish.tool].authority.normalised(wish.alpha);
  if (!weights) return AuthorityResult::kInvalid;
  if (const auto party = stale_party(now, wish.tool, *weights, TransferStage::kScheduling)) {
    reject_authority(now, noted, wish.tool, *weights, *party);
    return AuthorityResult::kStaleLink;
  }
  schedule_authority(now, noted, wish.tool, wish.alpha, AuthorityTransfer::kNotice);
  return AuthorityResult::kScheduled;
}

void Session::set_initial_authority(std::size_t tool, const control::MasterArray& wanted) noexcept {
  static_cast<void>(tools()[tool].authority.request(wanted));
  tools()[tool].transfer.set_initial(tools()[tool].authority.requested());
}

/// @param who    seat, AuditEvent::kControlPlane or AuditEvent::kTimeline
/// @param ahead  ticks until execution, at most AuthorityTransfer::kNotice
/// @pre `wanted` can be normalised
void Session::schedule_authority(Time now, std::uint8_t who, std::size_t tool, const control::MasterArray& wanted,
                                 std::uint32_t ahead) noexcept {
  Tool& of = tools()[tool];
  const control::MasterArray before = of.transfer.scheduled();
  of.transfer.schedule(of.authority.normalised(wanted).value_or(before), {.wanted = wanted, .by = who}, ahead);
  ++authority_version_;
  emit_authority_event(now, AuditEvent::What::kAuthority, who, tool, before, of.transfer.scheduled());
}

/// Announces the scene's own changes `AuthorityTransfer::kNotice` ticks ahead, so that each acts at its time. Their
/// links are checked at execution.
void Session::schedule_timeline_events(Time now) noexcept {
  if (!begun_ || clock_stopped()) return;
  for (; next_event_ < scene_->timeline.size(); ++next_event_) {
    const TimedAuthority& event = scene_->timeline[next_event_];
    const double ahead = std::ceil((event.at - time()) / dt_ - 0.5);  // the nearest tick
    if (ahead > AuthorityTransfer::kNotice) return;
    schedule_authority(now, AuditEvent::kTimeline, event.row.tool, weights_of(event.row),
                       static_cast<std::uint32_t>(std::max(0.0, ahead)));
  }
}

/// While the clock is stopped, an announced change of the timeline waits. A change by a participant or an operator is
/// still executed after its 50 ticks.
void Session::advance_transfers() noexcept {
  for (Tool& tool : tools())
    if (!clock_stopped() || tool.transfer.latest_by() != AuditEvent::kTimeline) tool.transfer.tick();
}

/// Executes the changes that are due. If a link became stale since the announcement, the authority stays as it is,
/// under a new version. A change of the timeline is deferred instead, because the scene requests it only once.
void Session::execute_transfers(Time now) noexcept {
  for (std::size_t j = 0; j < tools().size(); ++j) {
    AuthorityTransfer& handover = tools()[j].transfer;
    const AuthorityTransfer::Change* const due = handover.due();
    if (due == nullptr) continue;
    control::ToolAuthority& row = tools()[j].authority;
    const control::MasterArray weights = row.normalised(due->wanted).value_or(row.requested());
    const auto party = stale_party(now, j, weights, TransferStage::kExecution);
    if (!party) {
      static_cast<void>(row.request(due->wanted));
      continue;
    }
    const AuthorityTransfer::Change change = *due;
    const bool last = !handover.pending();
    if (change.by == AuditEvent::kTimeline && last) {
      if (!change.reported)
        emit_authority_event(now, AuditEvent::What::kAuthorityDeferred, change.by, j, row.requested(), weights, *party);
      handover.schedule(weights, {.wanted = change.wanted, .by = change.by, .reported = true});
      continue;
    }
    handover.cancel(row.requested());
    if (last) ++authority_version_;
    emit_authority_event(now, AuditEvent::What::kAuthorityCancelled, change.by, j, weights, row.requested(), *party);
    for (std::size_t i = 0; i < masters_; ++i)
      if (i == change.by || std::abs(weights[i] - row.requested()[i]) > kAuthorityTolerance)
        report_cancelled_transfer(i);
  }
}

/// First seat whose link is too stale for a change of authority over a tool; nullopt if there is none. The limit is
/// the `silence_limit` of the seat's gate, 20 ms unless the scene sets another. A seat that gains authority must be
/// present and within the limit. A present seat that loses authority must be within the limit at scheduling, so that
/// it receives the announcement. At execution it may be lost as well: it then loses its authority anyway. While the
/// tool is braked no authority moves, so no link is checked.
std::optional<std::size_t> Session::stale_party(Time now, std::size_t tool, const control::MasterArray& weights,
                                                TransferStage moment) const noexcept {
  const control::ToolAuthority& row = tools()[tool].authority;
  if (row.held()) return std::nullopt;
  const Duration limit = from_seconds(scene_->gate.silence_limit);
  for (std::size_t i = 0; i < masters_; ++i) {
    const double gain = weights[i] - row.requested()[i];
    const bool judged = gain > kAuthorityTolerance ||
                        (gain < -kAuthorityTolerance && moment == TransferStage::kScheduling && present_[i]);
    if (judged && (!present_[i] || seats_[i].silence(now) > limit)) return i;
  }
  return std::nullopt;
}

/// Rejects a request because of a stale link. Clients repeat requests: every FORCE reports the rejection, the audit
/// log at most once per second.
void Session::reject_authority(Time now, std::uint8_t who, std::size_t tool, const control::MasterArray& wanted,
                               std::size_t party) noexcept {
  if (who < masters_) report_cancelled_transfer(who);
  if (refused_at_ && now - *refused_at_ < kRejectionEventInterval) return;
  refused_at_ = now;
  emit_authority_event(now, AuditEvent::What::kAuthorityRejected, who, tool, tools()[tool].transfer.scheduled(), wanted,
                       party);
}

void Session::report_cancelled_transfer(std::size_t seat) noexcept {
  cancelled_transfer_ticks_[seat] = static_cast<std::uint32_t>(std::lround(kCancelledTransferShown / dt_));
}

void Session::emit_authority_event(Time now, AuditEvent::What what, std::uint8_t who, std::size_t tool,
                                   const control::MasterArray& before, const control::MasterArray& after,
                                   std::size_t party) noexcept {
  AuditEvent e;
  e.what = what;
  e.seat = who;
  e.tool = static_cast<std::uint8_t>(tool);
  e.masters = static_cast<std::uint8_t>(masters_);
  e.party = static_cast<std::uint8_t>(party);
  e.before = before;
  e.after = after;
  e.version = authority_version_;
  e.tick = session_tick_;
  e.at = now;
  audit_.push(e);
}

/// The parties of the last scheduled change over a tool, for the notice to seat `i`.
wire::TransferParties Session::transfer_parties(std::size_t j, std::size_t i) const noexcept {
  const AuthorityTransfer& handover = tools()[j].transfer;
  const control::MasterArray &after = handover.scheduled(), &before = tools()[j].authority.requested();
  const std::uint8_t by = handover.latest_by();
  wire::TransferParties p{.by = wire::TransferParties::kOperator, .tool = static_cast<std::uint32_t>(j)};
  if (by == AuditEvent::kTimeline) p.by = wire::TransferParties::kScene;
  if (by < seats_.size()) p.by = by + 1U;
  std::size_t gain = 0, one = i;
  for (std::size_t k = 0; k < masters_; ++k)
    if (after[k] - before[k] > kAuthorityTolerance) ++gain, one = k;
  if (gain == 1) p.to = static_cast<std::uint32_t>(one + 1);
  p.percent = static_cast<std::uint32_t>(std::lround(100 * std::clamp(after[gain == 1 ? one : i], 0.0, 1.0)));
  return p;
}

/// Fills the authority notice of the next FORCE: the last decision that affects this seat, until it is executed.
void Session::fill_transfer_message(std::size_t i, wire::ForceMessage& m) noexcept {
  m.transfer = wire::TransferNotice::kNone;
  m.transfer_ticks = 0;
  m.transfer_parties = {};
  if (cancelled_transfer_ticks_[i] > 0) {
    --cancelled_transfer_ticks_[i];
    m.transfer = wire::TransferNotice::kCancelled;
  }
  if (i >= masters_ || !begun_) return;
  for (std::size_t j = 0; j < tools().size(); ++j) {
    const Tool& tool = tools()[j];
    // During a stop no authority moves. The seats are notified at once of changes that act after the resume; changes
    // of the timeline wait with the clock.
    const bool waits = clock_stopped() && tool.transfer.latest_by() == AuditEvent::kTimeline;
    if (!tool.transfer.pending() || waits) continue;
    const double gain = tool.transfer.scheduled()[i] - tool.authority.requested()[i];
    if (std::abs(gain) <= kAuthorityTolerance) continue;
    m.transfer = gain > 0 ? wire::TransferNotice::kGaining : wire::TransferNotice::kLosing;
    m.transfer_ticks = tool.transfer.ticks_left();
    m.transfer_parties = transfer_parties(j, i);
    return;
  }
}

}  // namespace tandem::server
