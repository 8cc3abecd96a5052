#include <algorithm>
#include <cmath>

#include "server/session.h"

/// Who moves weight between hands, who may, and how it comes to pass: decided, announced, carried out `Handover::kNotice` ticks later
/// (design notes, security 2.5), or called off.
namespace tandem::server {

namespace {
constexpr double kSame = 1e-9;  // of two weights
constexpr Duration kBetweenComplaints = std::chrono::seconds(1);  // of one session, that somebody's link is too old
constexpr double kCalledOffShown = 0.1;                           // [s] FORCE says so: some of them may be lost
}  // namespace

control::Weights Session::weights_of(const AuthorityRow& row) const noexcept {
  control::Weights w{};
  for (std::size_t i = 0; i < masters_; ++i) w[i] = row.alpha[i];
  return w;
}

/// An instructor sets all weights; who may only offer back gives of his own to instructors and touches nobody else's.
void Session::hear_authority(Time now, std::size_t i, const wire::AuthorityMessage& wish) noexcept {
  const AuthorityResult result = set_authority(now, seats_[i].role(), i, static_cast<std::uint8_t>(i), wish);
  if (result == AuthorityResult::kForbidden) forbid(now, i);
}

Session::AuthorityResult Session::set_authority(Time now, AccessRole who, std::size_t seat, std::uint8_t noted,
                                                const wire::AuthorityMessage& wish) noexcept {
  if (wish.tool >= tools_.size() || wish.masters != masters_) return AuthorityResult::kWrong;
  const Grant grant = allowed(who, Right::kAuthority);
  const control::Weights& before = tools_[wish.tool].handover.decided();
  bool may = grant != Grant::kNo;
  for (std::size_t k = 0; k < masters_; ++k) {  // the server, not the client, says who may never drive
    const AccessRole whose = seats_[k].role();
    may = may && (wish.alpha[k] == 0 || allowed(whose, Right::kDrive) != Grant::kNo);
    if (grant == Grant::kYes) continue;
    const double gain = wish.alpha[k] - before[k];
    const bool instructor = allowed(whose, Right::kAuthority) == Grant::kYes;
    may = may && (k == seat ? gain <= kSame : instructor ? gain >= -kSame : std::abs(gain) <= kSame);
  }
  if (wish.version != authority_version_) return AuthorityResult::kOutdated;  // somebody was faster: the newer weights are in FORCE
  if (!may) return AuthorityResult::kForbidden;
  const auto weights = tools_[wish.tool].authority.normalised(wish.alpha);
  if (!weights) return AuthorityResult::kWrong;
  if (const auto party = out_of_touch(now, wish.tool, *weights, Moment::kDecision)) {
    refuse_authority(now, noted, wish.tool, *weights, *party);
    return AuthorityResult::kOutOfTouch;
  }
  decide_authority(now, noted, wish.tool, wish.alpha, Handover::kNotice);
  return AuthorityResult::kAnnounced;
}

void Session::begin_authority(std::size_t tool, const control::Weights& wanted) noexcept {
  static_cast<void>(tools_[tool].authority.request(wanted));
  tools_[tool].handover.begin_with(tools_[tool].authority.requested());
}

/// @pre `wanted` can be normalised
void Session::decide_authority(Time now, std::uint8_t who, std::size_t tool, const control::Weights& wanted, std::uint32_t ahead) noexcept {
  Tool& of = tools_[tool];
  const control::Weights before = of.handover.decided();
  of.handover.decide(of.authority.normalised(wanted).value_or(before), {.wanted = wanted, .who = who}, ahead);
  ++authority_version_;
  note_authority(now, AuditEvent::What::kAuthority, who, tool, before, of.handover.decided());
}

/// A scene's own changes are known ahead, so they are announced ahead: each acts at its time. Their links are judged then.
void Session::follow_timeline(Time now) noexcept {
  if (!begun_ || clock_stands()) return;
  for (; next_event_ < scene_->timeline.size(); ++next_event_) {
    const TimedAuthority& event = scene_->timeline[next_event_];
    const double ahead = std::ceil((event.at - time()) / dt_ - 0.5);  // the tick nearest to it
    if (ahead > Handover::kNotice) return;
    decide_authority(now, AuditEvent::kTimeline, event.row.tool, weights_of(event.row), static_cast<std::uint32_t>(std::max(0.0, ahead)));
  }
}

/// An announced change of the timeline waits while the clock stands still; what a person decides meanwhile comes after its 50 ticks.
void Session::move_handovers_on() noexcept {
  for (Tool& tool : tools_)
    if (!clock_stands() || tool.handover.newest_by() != AuditEvent::kTimeline) tool.handover.tick();
}

/// What was announced for this tick. It may have become impossible since: then the weights stay as they are, and that is a new version.
/// What the scene wants is put off instead: nobody would say it again.
void Session::hand_over(Time now) noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Handover& handover = tools_[j].handover;
    const Handover::Change* const due = handover.due();
    if (due == nullptr) continue;
    control::AuthorityRow& row = tools_[j].authority;
    const control::Weights weights = row.normalised(due->wanted).value_or(row.requested());
    const auto party = out_of_touch(now, j, weights, Moment::kCarryingOut);
    if (!party) {
      static_cast<void>(row.request(due->wanted));
      continue;
    }
    const Handover::Change change = *due;
    const bool last = !handover.pending();
    if (change.who == AuditEvent::kTimeline && last) {
      if (!change.told) note_authority(now, AuditEvent::What::kAuthorityPutOff, change.who, j, row.requested(), weights, *party);
      handover.decide(weights, {.wanted = change.wanted, .who = change.who, .told = true});
      continue;
    }
    handover.call_off(row.requested());
    if (last) ++authority_version_;
    note_authority(now, AuditEvent::What::kAuthorityCalledOff, change.who, j, weights, row.requested(), *party);
    for (std::size_t i = 0; i < masters_; ++i)
      if (i == change.who || std::abs(weights[i] - row.requested()[i]) > kSame) tell_called_off(i);
  }
}

/// Whose link is too old for a change of weights over a tool: older than his own gate bears (`silence_limit`, 20 ms where a scene says
/// nothing else); nullopt: nobody's. Who gains must be there. Who loses must be reached by the announcement; later he may be lost as
/// well, for then his weight goes anyway, and so it may from who is not there at all. While nobody has weight, nobody's moves.
std::optional<std::size_t> Session::out_of_touch(Time now, std::size_t tool, const control::Weights& weights, Moment moment) const noexcept {
  const control::AuthorityRow& row = tools_[tool].authority;
  if (row.held()) return std::nullopt;
  const Duration limit = from_seconds(scene_->gate.silence_limit);
  for (std::size_t i = 0; i < masters_; ++i) {
    const double gain = weights[i] - row.requested()[i];
    const bool judged = gain > kSame || (gain < -kSame && moment == Moment::kDecision && present_[i]);
    if (judged && (!present_[i] || seats_[i].silence(now) > limit)) return i;
  }
  return std::nullopt;
}

/// A client repeats what it asks for: it is told in every FORCE and written down now and then.
void Session::refuse_authority(Time now, std::uint8_t who, std::size_t tool, const control::Weights& wanted, std::size_t party) noexcept {
  if (who < masters_) tell_called_off(who);
  if (refused_at_ && now - *refused_at_ < kBetweenComplaints) return;
  refused_at_ = now;
  note_authority(now, AuditEvent::What::kAuthorityRefused, who, tool, tools_[tool].handover.decided(), wanted, party);
}

void Session::tell_called_off(std::size_t seat) noexcept { called_off_[seat] = static_cast<std::uint32_t>(std::lround(kCalledOffShown / dt_)); }

void Session::note_authority(Time now, AuditEvent::What what, std::uint8_t who, std::size_t tool, const control::Weights& before,
                             const control::Weights& after, std::size_t party) noexcept {
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

/// Who gave what to whom, as seat `i` is told.
wire::HandoverParties Session::parties(std::size_t j, std::size_t i) const noexcept {
  const Handover& handover = tools_[j].handover;
  const control::Weights &after = handover.decided(), &before = tools_[j].authority.requested();
  const std::uint8_t by = handover.newest_by();
  wire::HandoverParties p{.by = wire::HandoverParties::kOperator, .tool = static_cast<std::uint32_t>(j)};
  if (by == AuditEvent::kTimeline) p.by = wire::HandoverParties::kScene;
  if (by < seats_.size()) p.by = by + 1U;
  std::size_t gain = 0, one = i;
  for (std::size_t k = 0; k < masters_; ++k)
    if (after[k] - before[k] > kSame) ++gain, one = k;
  if (gain == 1) p.to = static_cast<std::uint32_t>(one + 1);
  p.percent = static_cast<std::uint32_t>(std::lround(100 * std::clamp(after[gain == 1 ? one : i], 0.0, 1.0)));
  return p;
}

/// What the next FORCE says of a seat's weight: the last decision about it, as long as that is to come.
void Session::tell_handover(std::size_t i, wire::ForceMessage& m) noexcept {
  m.handover = wire::Handover::kNone;
  m.handover_ticks = 0;
  m.handover_parties = {};
  if (called_off_[i] > 0) {
    --called_off_[i];
    m.handover = wire::Handover::kCalledOff;
  }
  if (i >= masters_ || !begun_) return;
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const Tool& tool = tools_[j];
    // In a stop nobody gets weight, but who will have it when the session goes on is told at once; the scene's changes wait with its clock.
    const bool waits = clock_stands() && tool.handover.newest_by() == AuditEvent::kTimeline;
    if (!tool.handover.pending() || waits) continue;
    const double gain = tool.handover.decided()[i] - tool.authority.requested()[i];
    if (std::abs(gain) <= kSame) continue;
    m.handover = gain > 0 ? wire::Handover::kComes : wire::Handover::kGoes;
    m.handover_ticks = tool.handover.left();
    m.handover_parties = parties(j, i);
    return;
  }
}

}  // namespace tandem::server
