#include "server/session/authority_control.h"

#include <algorithm>
#include <cmath>

#include "server/policy/roles.h"

namespace tandem::server {

namespace {
constexpr double kTolerance = 1e-9;                                    // of a difference of two authorities
constexpr Duration kRejectionEventInterval = std::chrono::seconds(1);  // of stale-link rejections, per session
// [s] for which FORCE reports a cancellation, because single datagrams may be lost.
constexpr double kCancelledShown = 0.1;

control::MasterArray weights_of(const AuthorityRow& row) noexcept {
  control::MasterArray w{};
  std::copy_n(row.alpha.begin(), w.size(), w.begin());
  return w;
}
}  // namespace

AuthorityControl::AuthorityControl(const SceneSpec& scene, const SessionClock& clock, std::span<Tool> tools,
                                   std::span<const SeatEndpoint> seats, const std::array<bool, kSeatsMax>& present,
                                   AuditTrail& audit) noexcept
    : scene_(&scene),
      clock_(&clock),
      tools_(tools),
      seats_(seats),
      present_(&present),
      audit_(&audit),
      masters_(scene.masters()),
      version_(1 + static_cast<std::uint32_t>(scene.authority.size())) {
  for (const AuthorityRow& row : scene.authority) set_initial(row.tool, weights_of(row));
}

void AuthorityControl::restore(const Checkpoint& from) noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) set_initial(j, from.tools[j].alpha);
  version_ = from.authority_version + 1;
  // The checkpoint contains the result of the changes that were announced when it was made.
  const double announced = clock_->time() + (AuthorityTransfer::kNotice + 0.5) * clock_->dt();
  while (from.begun && next_event_ < scene_->timeline.size() && scene_->timeline[next_event_].at <= announced)
    ++next_event_;
}

void AuthorityControl::save(Checkpoint& to) const noexcept {
  to.authority_version = version_;
  for (std::size_t j = 0; j < tools_.size(); ++j) to.tools[j].alpha = tools_[j].transfer.scheduled();
}

void AuthorityControl::set_initial(std::size_t tool, const control::MasterArray& wanted) noexcept {
  static_cast<void>(tools_[tool].authority.request(wanted));
  tools_[tool].transfer.set_initial(tools_[tool].authority.requested());
}

/// The server checks which seats may drive; it does not rely on the client.
bool AuthorityControl::permitted(const Requester& by, const wire::AuthorityMessage& wish) const noexcept {
  const Grant grant = allowed(by.role, Right::kAuthority);
  const control::MasterArray& before = tools_[wish.tool].transfer.scheduled();
  bool may = grant != Grant::kNo;
  for (std::size_t k = 0; k < masters_; ++k) {
    const AccessRole whose = seats_[k].role();
    may = may && (wish.alpha[k] == 0 || allowed(whose, Right::kDrive) != Grant::kNo);
    if (grant == Grant::kYes) continue;
    const double gain = wish.alpha[k] - before[k];
    const bool instructor = allowed(whose, Right::kAuthority) == Grant::kYes;
    may = may && (k == by.seat ? gain <= kTolerance : instructor ? gain >= -kTolerance : std::abs(gain) <= kTolerance);
  }
  return may;
}

CommandResult AuthorityControl::request(Time now, const Requester& by, const wire::AuthorityMessage& wish) noexcept {
  if (wish.tool >= tools_.size() || wish.masters != masters_) return CommandResult::kInvalid;
  if (wish.version != version_)
    return CommandResult::kOutdated;  // another change was faster: FORCE carries the newer authority
  if (!permitted(by, wish)) return CommandResult::kForbidden;
  const auto weights = tools_[wish.tool].authority.normalised(wish.alpha);
  if (!weights) return CommandResult::kInvalid;
  if (const auto party = stale_party(now, wish.tool, *weights, Stage::kScheduling)) {
    reject(now, by.audited_as, wish.tool, *weights, *party);
    return CommandResult::kStaleLink;
  }
  schedule(now, by.audited_as, wish.tool, wish.alpha, AuthorityTransfer::kNotice);
  return CommandResult::kDone;
}

void AuthorityControl::schedule(Time now, std::uint8_t by, std::size_t tool, const control::MasterArray& wanted,
                                std::uint32_t ahead) noexcept {
  Tool& of = tools_[tool];
  const control::MasterArray before = of.transfer.scheduled();
  of.transfer.schedule(of.authority.normalised(wanted).value_or(before), {.wanted = wanted, .by = by}, ahead);
  scheduled_ = true;
  ++version_;
  emit(now, AuditEvent::What::kAuthority, by, tool, before, of.transfer.scheduled());
}

/// Rejects a request because of a stale link. Clients repeat requests: every FORCE reports the rejection, the audit
/// log at most once per second.
void AuthorityControl::reject(Time now, std::uint8_t by, std::size_t tool, const control::MasterArray& wanted,
                              std::size_t party) noexcept {
  if (by < masters_) show_cancelled(by);
  if (rejected_at_ && now - *rejected_at_ < kRejectionEventInterval) return;
  rejected_at_ = now;
  emit(now, AuditEvent::What::kAuthorityRejected, by, tool, tools_[tool].transfer.scheduled(), wanted, party);
}

/// While the clock is stopped, an announced change of the timeline waits. A change by a participant or an operator is
/// still executed after its 50 ticks.
void AuthorityControl::step(Time now, bool clock_stopped) noexcept {
  for (Tool& tool : tools_)
    if (!clock_stopped || tool.transfer.latest_by() != AuditEvent::kTimeline) tool.transfer.tick();
  if (clock_->begun() && !clock_stopped) schedule_timeline(now);
  for (std::size_t j = 0; j < tools_.size(); ++j) execute(now, j);
  scheduled_ = std::ranges::any_of(tools_, [](const Tool& tool) { return tool.transfer.pending(); });
}

/// Announces the scene's own changes `AuthorityTransfer::kNotice` ticks ahead, so that each acts at its time. Their
/// links are checked at execution.
void AuthorityControl::schedule_timeline(Time now) noexcept {
  for (; next_event_ < scene_->timeline.size(); ++next_event_) {
    const TimedAuthority& event = scene_->timeline[next_event_];
    const double ahead = std::ceil((event.at - clock_->time()) / clock_->dt() - 0.5);  // the nearest tick
    if (ahead > AuthorityTransfer::kNotice) return;
    schedule(now, AuditEvent::kTimeline, event.row.tool, weights_of(event.row),
             static_cast<std::uint32_t>(std::max(0.0, ahead)));
  }
}

/// Executes the change that is due. If a link became stale since the announcement, the authority stays as it is, under
/// a new version. A change of the timeline is deferred instead, because the scene requests it only once.
void AuthorityControl::execute(Time now, std::size_t j) noexcept {
  AuthorityTransfer& transfer = tools_[j].transfer;
  const AuthorityTransfer::Change* const due = transfer.due();
  if (due == nullptr) return;
  control::ToolAuthority& row = tools_[j].authority;
  const control::MasterArray weights = row.normalised(due->wanted).value_or(row.requested());
  const auto party = stale_party(now, j, weights, Stage::kExecution);
  if (!party) {
    static_cast<void>(row.request(due->wanted));
    return;
  }
  const AuthorityTransfer::Change change = *due;
  const bool last = !transfer.pending();
  if (change.by == AuditEvent::kTimeline && last) {
    if (!change.reported)
      emit(now, AuditEvent::What::kAuthorityDeferred, change.by, j, row.requested(), weights, *party);
    transfer.schedule(weights, {.wanted = change.wanted, .by = change.by, .reported = true});
    return;
  }
  transfer.cancel(row.requested());
  if (last) ++version_;
  emit(now, AuditEvent::What::kAuthorityCancelled, change.by, j, weights, row.requested(), *party);
  for (std::size_t i = 0; i < masters_; ++i)
    if (i == change.by || std::abs(weights[i] - row.requested()[i]) > kTolerance) show_cancelled(i);
}

/// First seat whose link is too stale for a change of authority over a tool; nullopt if there is none. The limit is
/// the `silence_limit` of the seat's gate, 20 ms unless the scene sets another. A seat that holds back datagrams may
/// lose two heartbeats before that counts. A seat that gains authority must be
/// present and within the limit. A present seat that loses authority must be within the limit at scheduling, so that
/// it receives the announcement. At execution it may be lost as well: it then loses its authority anyway. While the
/// tool is braked no authority moves, so no link is checked.
std::optional<std::size_t> AuthorityControl::stale_party(Time now, std::size_t tool,
                                                         const control::MasterArray& weights,
                                                         Stage stage) const noexcept {
  const control::ToolAuthority& row = tools_[tool].authority;
  if (row.held()) return std::nullopt;
  const Duration limit = from_seconds(scene_->gate.silence_limit);
  for (std::size_t i = 0; i < masters_; ++i) {
    const double gain = weights[i] - row.requested()[i];
    const bool present = (*present_)[i];
    const bool judged = gain > kTolerance || (gain < -kTolerance && stage == Stage::kScheduling && present);
    if (judged && (!present || seats_[i].silence(now) > limit + 2 * seats_[i].held_back())) return i;
  }
  return std::nullopt;
}

void AuthorityControl::show_cancelled(std::size_t seat) noexcept {
  cancelled_ticks_[seat] = static_cast<std::uint32_t>(std::lround(kCancelledShown / clock_->dt()));
}

std::uint32_t AuthorityControl::origin(std::size_t j) const noexcept {
  const std::uint8_t by = tools_[j].transfer.latest_by();
  if (by == AuditEvent::kTimeline) return wire::TransferParties::kScene;
  return by < seats_.size() ? by + 1U : wire::TransferParties::kOperator;
}

/// The parties of the last scheduled change over a tool, for the notice to seat `i`.
wire::TransferParties AuthorityControl::parties(std::size_t j, std::size_t i) const noexcept {
  const AuthorityTransfer& transfer = tools_[j].transfer;
  const control::MasterArray &after = transfer.scheduled(), &before = tools_[j].authority.requested();
  wire::TransferParties p{.by = origin(j), .tool = static_cast<std::uint32_t>(j)};
  std::size_t gain = 0, one = i;
  for (std::size_t k = 0; k < masters_; ++k)
    if (after[k] - before[k] > kTolerance) ++gain, one = k;
  if (gain == 1) p.to = static_cast<std::uint32_t>(one + 1);
  p.percent = static_cast<std::uint32_t>(std::lround(100 * std::clamp(after[gain == 1 ? one : i], 0.0, 1.0)));
  return p;
}

/// During a stop no authority moves. The seats are notified at once of changes that act after the resume; changes of
/// the timeline wait with the clock.
void AuthorityControl::fill_notice(std::size_t i, bool clock_stopped, wire::ForceMessage& m) noexcept {
  m.transfer = wire::TransferNotice::kNone;
  m.transfer_ticks = 0;
  m.transfer_parties = {};
  if (cancelled_ticks_[i] > 0) {
    --cancelled_ticks_[i];
    m.transfer = wire::TransferNotice::kCancelled;
  }
  if (i >= masters_ || !clock_->begun()) return;
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const AuthorityTransfer& transfer = tools_[j].transfer;
    if (!transfer.pending() || (clock_stopped && transfer.latest_by() == AuditEvent::kTimeline)) continue;
    const double gain = transfer.scheduled()[i] - tools_[j].authority.requested()[i];
    if (std::abs(gain) <= kTolerance) continue;
    m.transfer = gain > 0 ? wire::TransferNotice::kGaining : wire::TransferNotice::kLosing;
    m.transfer_ticks = transfer.ticks_left();
    m.transfer_parties = parties(j, i);
    return;
  }
}

void AuthorityControl::emit(Time now, AuditEvent::What what, std::uint8_t by, std::size_t tool,
                            const control::MasterArray& before, const control::MasterArray& after,
                            std::size_t party) noexcept {
  audit_->emit(now, {.what = what,
                     .seat = by,
                     .tool = static_cast<std::uint8_t>(tool),
                     .masters = static_cast<std::uint8_t>(masters_),
                     .party = static_cast<std::uint8_t>(party),
                     .version = version_,
                     .before = before,
                     .after = after});
}

}  // namespace tandem::server
