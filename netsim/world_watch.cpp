#include "netsim/world_watch.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "server/session_monitor.h"

namespace tandem::netsim {

namespace {

// The limits of the force gate and of authority (design notes, control 7; security 2.4), said here once more: an oracle that read
// them from the guard would follow its mistakes.
constexpr double kSlewActive = 1000, kSlewRampIn = 10;  // [N/s]
constexpr double kGateStepMax = 0.01;                   // [s] of lateness the slew makes up for
constexpr double kRampOut = 0.1;                        // [s]
constexpr double kLossSlew = 10;                        // [1/s] when a holder is lost
constexpr double kEvaluatorShare = 0.5;                 // of force and tank, for who only feels
constexpr double kStoppedMax = 0.22;                    // [s] a stopped hand may still have weight
/// Somebody stopped the session, or its server does not keep its time.
constexpr bool lets_go(wire::SessionState state) noexcept {
  return state == wire::SessionState::kStopped || state == wire::SessionState::kPaused || state == wire::SessionState::kPassive;
}
constexpr unsigned kMisreadMax = 3;                     // samples the last good reading stands in for
constexpr double kTankPerKg = 0.18, kTankMin = 0.02, kTankMax = 0.1;  // [J/kg], [J]
constexpr double kSpeedMax = 1.6;                       // [m/s], and how many samples on end
constexpr unsigned kFastMax = 5;
constexpr double kTankSlack = 1e-3;                     // [J] a hand that pulls along overdraws within one tick
constexpr double kUnseen = 1.6e-4;                      // [m] of way that the gate, which books by encoders, does not see: two steps of them
constexpr double kLatePower = 1;                        // [W] by which a hand of 2 m/s does so while its program wakes up late
constexpr double kFeltMax = 0.2;                        // [N/ms] a step of authority
constexpr double kFeltSlewMax = 10;                     // [1/s] of authority: faster, and the strongest springs' shares are felt
constexpr double kLifeTicks = 3, kLifeMin = 0.005, kLifeMax = 0.03, kFade = 0.02;  // ticks, [s]: a command's life, and how its force then fades
constexpr double kFarTouch = 1, kFarLinear = 50;        // [m] no hand of such a device is there; a rail has no end


double tip_norm(const AxisArray& effort, const AxisArray& scale, std::size_t dof) noexcept {
  double sum = 0;
  for (std::size_t a = 0; a < dof; ++a) sum += effort[a] * effort[a] / scale[a];
  return std::sqrt(sum);
}

bool all_finite(const AxisArray& v, std::size_t dof) noexcept {
  return std::all_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(dof), [](double e) { return std::isfinite(e); });
}

}  // namespace

WorldWatch::WorldWatch(const SceneSpec& scene)
    : scene_(&scene), seats_(scene.seats.size()), alpha_(scene.tools.size()), held_(scene.tools.size(), true), handover_(scene) {}

/// Hands that pull against each other, or that somebody pushes, empty the accounts they live on, and rightly so; so does a scene
/// that lets less heat be spent, gates its flow sources, or hangs a seat on several tools.
bool WorldWatch::calm() noexcept {
  const auto passive = [](const SeatSpec& s) {
    return s.kind == SeatKind::kSlave || s.hand.model == HandModel::kRelaxed || s.hand.model == HandModel::kNone;
  };
  const auto pushed = [](const SeatSpec& s) { return !s.hand.deviations.empty(); };
  ordinary_ = scene_->channel.law == LawKind::kSetPosition && scene_->channel.mfs == MfsMode::kOpen &&
              scene_->channel.eta >= ChannelSpec{}.eta && scene_->tools.size() == 1 && std::ranges::none_of(scene_->seats, pushed) &&
              std::ranges::count_if(scene_->seats, std::not_fn(passive)) == 1;
  if (ordinary_) mover_ = static_cast<std::size_t>(std::ranges::find_if_not(scene_->seats, passive) - scene_->seats.begin());
  return ordinary_;
}

void WorldWatch::server_heard(std::size_t seat, std::uint64_t index) noexcept {
  Seat& s = seats_[seat];
  // Not "newer": what came first may act later than an answer to a challenge, or one too many, that was sent after it.
  if (s.given_to_server.first(index)) ++s.server_heard;
}

void WorldWatch::note(std::string_view invariant, std::size_t seat, bool expected) {
  violations_.note(invariant, scene_->seats[seat].name, t_, expected);
}

void WorldWatch::check(std::uint32_t lived, const server::Session& session,
                       const std::vector<WorldStation>& stations) {
  t_ = session.time();
  server::SessionMonitor{}.check(session, violations_);
  check_gathering(session);
  check_authority(lived, session);
  if (lived > 0) handover_.check(lived, session, violations_);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const WorldStation& station = stations[i];
    Seat& s = seats_[i];
    const server::SeatPort& port = session.seat(i);
    const client::Seat* seat = station.seat();
    if (seat != nullptr) scale_ = seat->setup().axis_scale;
    const hal::sim::Truth& truth = station.device().truth();
    const double far = scene_->seats[i].device.model == DeviceModel::kTouch ? kFarTouch : kFarLinear;
    if (!truth.x.allFinite() || truth.x.norm() > far) note("diverged", i);
    check_energy(i, station);
    if (scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster) check_hand(i, station);
    if (s.starts != station.starts()) s.begin_anew(station.starts());
    if (s.joins != station.joins()) {  // another connection: its counters begin anew, the hand goes on
      s.joins = station.joins();
      s.accepted = s.session_tick = 0;
      for (End& end : s.client) end.known = false;
    }
    check_role(i, station, port);

    const bool slave = scene_->seats[i].kind == SeatKind::kSlave;
    if (lived == 1 && (slave || scene_->tools.size() == 1 || scene_->channel.law == LawKind::kReplica)) {
      check_server_ends(i, session, seat, slave);
    } else {
      for (End& end : s.server) end.known = false;
    }
    check_once(i, station, port);
    if (seat == nullptr) continue;
    if (!station.served_now()) {
      for (End& end : s.client) end.known = false;
      continue;
    }
    const Time own = station.own_time(station.served_at());
    check_effort(own, i, station);
    check_silence(own, i, station);
    check_reading(i, station);
    check_sensor(i, station);
    check_speed(i, station);
    check_client_ends(i, *seat, session, slave);
    s.was_active = seat->gate().active();
    s.trips = seat->gate().trips();
    s.effort = seat->effort();
    s.served = own;
  }
}

/// Who may do what, said here once more: no force to observers, a stopped hand is let go and acts on nothing, a stopped session
/// engages nobody, and who sends what nobody may is not wanted.
void WorldWatch::check_role(std::size_t i, const WorldStation& station, const server::SeatPort& port) {
  const Role role = scene_->seats[i].role;
  const bool watches = role == Role::kObserver && scene_->seats[i].kind == SeatKind::kMaster;
  if (watches && port.tx.engage) note("observer_force", i);
  const bool stopped = lets_go(port.tx.session);
  if (stopped && port.tx.engage) note("stop_engages_nobody", i);
  const client::Seat* seat = station.seat();
  if (seat == nullptr || !station.served_now()) return;
  if (watches && tip_norm(seat->effort(), seat->setup().axis_scale, scene_->dof) > 0) note("observer_force", i);
  if (seat->stopped() && seat->gate().active()) note("own_stop", i);
}

/// After a restart of the server nobody is engaged before everybody with weight is back, unless an instructor goes on without.
void WorldWatch::check_gathering(const server::Session& session) {
  if (session.epoch() != epoch_) {
    epoch_ = session.epoch();
    gathering_ = true;
    for (Seat& s : seats_) s.needed = s.led;
  }
  bool away = false, engages = false;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    Seat& s = seats_[i];
    away |= s.needed && !session.seat(i).taken();
    engages |= session.seat(i).tx.engage;
    s.led = false;
    for (std::size_t j = 0; i < scene_->masters() && j < scene_->tools.size(); ++j)
      s.led |= session.tool(j).handover.decided()[i] > 0 && session.seat(i).taken() && !gathering_ && session.session_tick() > 0;
    s.led |= gathering_ && s.needed;
  }
  away_ = away;
  if (gathering_ && away && engages) violations_.note("gathering", "", t_, false);
}

/// A reading that stands still for long while the hand is led far away and pulled otherwise must have let the hand go.
void WorldWatch::check_sensor(std::size_t i, const WorldStation& station) {
  constexpr double kLong = 0.2, kFar = 0.01, kPull = 1;  // [s], [m], [N]: twice what the guard goes by
  const client::Seat& seat = *station.seat();
  Seat::Frozen& was = seats_[i].frozen;
  const Time now = station.served_at();
  const AxisArray& ref = seat.channel().state().ref;
  const bool frozen = scene_->seats[i].kind == SeatKind::kMaster && seat.gate().active() && station.suffers(Fault::Kind::kFrozen, now) &&
                      !station.misread_now();
  if (!frozen || !was.on) was = {now, ref, seat.effort(), frozen};
  if (!frozen || seconds(now - was.since) < kLong) return;
  double way = 0, pull = 0;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    way += (ref[a] - was.ref[a]) * (ref[a] - was.ref[a]) * scale_[a];
    pull += (seat.effort()[a] - was.effort[a]) * (seat.effort()[a] - was.effort[a]) / scale_[a];
  }
  if (way > kFar * kFar && pull > kPull * kPull) note("frozen_sensor", i);
}

void WorldWatch::noted(const server::AuditEvent& e) {
  using What = server::AuditEvent::What;
  if (e.what == What::kGathered) {
    const bool by_itself = e.seat >= scene_->seats.size();  // else an instructor went on without those who are missing
    if (gathering_ && by_itself && away_) violations_.note("gathering", "", t_, false);
    gathering_ = false;
  }
  handover_.noted(e);
  if (e.seat >= scene_->seats.size()) return;
  const Role role = scene_->seats[e.seat].role;
  if ((e.what == What::kStop || e.what == What::kResume || e.what == What::kGathered) && role != Role::kInstructor) note("role", e.seat);
  if (e.what == What::kPause && role != Role::kTrainee && role != Role::kEvaluator) note("role", e.seat);
  if (e.what == What::kAuthority && role != Role::kInstructor) {
    if (role != Role::kTrainee || e.after[e.seat] > e.before[e.seat] + 1e-9) note("role", e.seat);
    for (std::size_t k = 0; k < scene_->masters(); ++k)
      if (k != e.seat && scene_->seats[k].role != Role::kInstructor && std::abs(e.after[k] - e.before[k]) > 1e-9) note("role", e.seat);
  }
}

void WorldWatch::check_effort(Time own, std::size_t i, const WorldStation& station) {
  const client::Seat& seat = *station.seat();
  const Seat& s = seats_[i];
  const AxisArray& scale = seat.setup().axis_scale;
  if (!all_finite(seat.effort(), scene_->dof)) return note("effort_finite", i);
  if (!all_finite(seat.sample().port.x, scene_->dof) || !all_finite(seat.sample().port.v, scene_->dof)) note("sample_finite", i);
  const double norm = tip_norm(seat.effort(), scale, scene_->dof);
  if (norm > share(i) * scene_->gate.force_max * (1 + 1e-9)) note("effort_limited", i);
  if (!seat.gate().active() || norm == 0) return;  // letting go at once is always allowed
  // A program that stood still for longer than a command and its device's release last finds motors without force: what it gives
  // then is a step from zero, not from the effort it remembers.
  const double forgotten = std::clamp(kLifeTicks / scene_->tick_hz, kLifeMin, kLifeMax) + kFade;
  const bool stood_still = s.served != Time{} && seconds(own - s.served) > forgotten;
  AxisArray change{};
  for (std::size_t a = 0; a < scene_->dof; ++a) change[a] = seat.effort()[a] - (stood_still ? 0 : s.effort[a]);
  const double dt = s.served == Time{} ? 0 : std::clamp(seconds(own - s.served), 0.0, kGateStepMax);
  const double rate = seat.gate().phase() == control::GatePhase::kRampIn ? kSlewRampIn : kSlewActive;
  if (tip_norm(change, scale, scene_->dof) > rate * dt * (1 + 1e-6) + 1e-9) note("effort_slew", i);
}

void WorldWatch::check_silence(Time own, std::size_t i, const WorldStation& station) {
  const Time now = station.served_at();
  const client::Seat& seat = *station.seat();
  Seat& s = seats_[i];
  const link::Freshness& fresh = seat.link().freshness();
  if (fresh.heard() && fresh.arrived() != s.arrived) {
    s.arrived = fresh.arrived();
    s.silence_limit = 0;
    s.fresh = now;
    // Also the word that tells the gate to let go; not one so old that it ended the link.
    if (seat.gate().active() || (s.was_active && seat.gate().trips() == s.trips)) s.given = 0;
  }
  const double half_tick = 0.5 / scene_->tick_hz;
  if (s.fresh != Time{}) {
    const double silence = seconds(now - s.fresh);
    const bool hand = scene_->seats[i].kind == SeatKind::kMaster;
    // The longest that was in force since the last word: who loses his authority or his server in a silence lets go from then on.
    s.silence_limit = std::max(s.silence_limit, hand ? silence_limits(scene_->gate, scene_->channel.law, seat.authority()).most : scene_->gate.silence_limit);
    const double limit = s.silence_limit;
    if (seat.gate().active() && silence > limit + half_tick) note("silence_ramps", i);
    if (silence > limit + kRampOut + 3 * half_tick) {
      double power = 0;  // what is left may brake a hand and never push it
      for (std::size_t a = 0; a < scene_->dof; ++a) power += seat.effort()[a] * seat.sample().port.v[a];
      if (power > 1e-9) note("silence_brakes", i);
    }
  }
  const bool replica = scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster;
  const double patience = replica ? silence_limits(scene_->gate, LawKind::kReplica, seat.authority()).most : 0;
  if (seat.gate().active() && seconds(fresh.loop_age(own)) > scene_->gate.loop_age_max + patience + 1e-9) note("loop_age", i);
}

/// Of force and tank that this hand may be given.
double WorldWatch::share(std::size_t i) const noexcept { return scene_->seats[i].role == Role::kEvaluator ? kEvaluatorShare : 1; }

/// A hand that is faster than anybody means to be is let go; so is one whose device says that its motors are too hot.
void WorldWatch::check_speed(std::size_t i, const WorldStation& station) {
  const bool fast = station.seat()->gate().active() && !station.misread_now() && !station.suffers(Fault::Kind::kFrozen, station.served_at()) &&
                    station.device().state().dx.norm() > kSpeedMax;
  seats_[i].fast = fast ? seats_[i].fast + 1 : 0;
  if (seats_[i].fast > kFastMax) note("over_speed", i);
  const bool hot = station.seat()->gate().active() && !station.misread_now() && station.suffers(Fault::Kind::kHot, station.served_at());
  seats_[i].hot = hot ? seats_[i].hot + 1 : 0;
  if (seats_[i].hot > kFastMax) note("over_temperature", i);
}

/// After the last fresh datagram a motor gives its hand at most the tank of its gate; judged by what the motor did, not by the
/// gate's own account.
void WorldWatch::check_energy(std::size_t i, const WorldStation& station) {
  Seat& s = seats_[i];
  const client::Seat* seat = station.seat();
  if (seat == nullptr || s.fresh == Time{}) return;
  if (seat->gate().active() && !s.was_active) s.given = 0;
  s.given += station.worked_now();
  // An effort that was given acts until its program wakes up again, and nobody can take it back before.
  s.late = s.awake ? 0 : s.late + 1 / scene_->tick_hz;
  s.awake = station.served_now();
  const double tank = share(i) * std::clamp(kTankPerKg * station.device().caps().mass.value_or(0), kTankMin, kTankMax);
  const double unseen = share(i) * scene_->gate.force_max * kUnseen;
  if (s.given > tank + kTankSlack + unseen + kLatePower * s.late) note("loss_energy", i);
}

void WorldWatch::check_reading(std::size_t i, const WorldStation& station) {
  const client::Seat& seat = *station.seat();
  Seat& s = seats_[i];
  s.misread = station.misread_now() ? s.misread + 1 : 0;
  if (s.misread <= kMisreadMax) return;
  if (seat.gate().phase() != control::GatePhase::kFault || tip_norm(seat.effort(), seat.setup().axis_scale, scene_->dof) != 0)
    note("bad_reading_faults", i);
}

/// A datagram acts at most once and never backwards: no more act than came new, and the ticks they tell never decrease.
void WorldWatch::check_once(std::size_t i, const WorldStation& station, const server::SeatPort& port) {
  Seat& s = seats_[i];
  if (port.generation() >= s.generation) {
    if (port.generation() - s.generation > s.server_heard) note("acts_once", i);
    if (port.heard().seat_tick < s.seat_tick) note("never_backwards", i);
  }
  s.generation = port.generation();
  s.seat_tick = port.heard().seat_tick;
  s.server_heard = 0;
  const client::Seat* seat = station.seat();
  if (seat == nullptr) return;
  const std::uint64_t accepted = seat->link().stats().accepted;
  if (accepted > s.accepted && accepted - s.accepted > station.heard_now()) note("acts_once", i);
  if (seat->force().session_tick < s.session_tick) note("never_backwards", i);
  s.accepted = accepted;
  s.session_tick = seat->force().session_tick;
}

void WorldWatch::check_authority(std::uint32_t lived, const server::Session& session) {
  for (std::size_t i = 0; i < scene_->masters(); ++i)
    seats_[i].stopped_s = session.seat(i).taken() && session.seat(i).heard().stop ? seats_[i].stopped_s + lived / scene_->tick_hz : 0;
  const double step = std::max(scene_->alpha_slew, kLossSlew) * lived / scene_->tick_hz + 1e-9;
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    const control::AuthorityRow& row = session.tool(j).authority;
    const bool stopped = lets_go(session.state());
    if (stopped && lived > 0 && !row.held()) violations_.note("stop_holds_tools", scene_->tools[j].name, t_, false);
    for (std::size_t i = 0; i < scene_->masters(); ++i) {
      const double alpha = row.alpha(i);
      const bool refused = session.seat(i).heard().stop || session.seat(i).conduct().isolated(session.last_tick());
      if (refused && lived == 1 && !held_[j] && alpha > alpha_[j][i] + 1e-9) note("refused_gains_weight", i);
      if (alpha > 0 && seats_[i].stopped_s > kStoppedMax) note("stop_takes_weight", i);
      const Role role = scene_->seats[i].role;
      if (alpha > 0 && (role == Role::kEvaluator || role == Role::kObserver)) note("authority_role", i);
      if (!row.held() && !held_[j] && std::abs(alpha - alpha_[j][i]) > step) note("authority_slew", i);
    }
    if (lived == 1 && !row.held()) check_felt(j, session);
    for (std::size_t i = 0; i < scene_->masters(); ++i) alpha_[j][i] = row.alpha(i);
    held_[j] = row.held();
  }
}

/// Whether this seat's spring pulls at no other tool: only then its elongation is bounded by what its motor can pull.
bool WorldWatch::serves_only(std::size_t tool, std::size_t i, const server::Session& session) const noexcept {
  for (std::size_t j = 0; j < scene_->tools.size(); ++j)
    if (j != tool && (session.tool(j).authority.alpha(i) > 0 || scene_->follow[i][j] > 0)) return false;
  return true;
}

/// What a change of authority does at once: every spring that pulls at the tool pulls with another share of its force. No motor
/// can give a hand more of it in this tick, as tool and hand are a mass and a spring apart.
void WorldWatch::check_felt(std::size_t j, const server::Session& session) {
  if (scene_->alpha_slew > kFeltSlewMax) return;  // the scene wants it so fast
  const server::Tool& tool = session.tool(j);
  AxisArray change{};
  for (std::size_t i = 0; i < scene_->masters(); ++i) {
    const double by = tool.authority.alpha(i) - alpha_[j][i];
    if (by == 0) continue;
    if (scene_->channel.law != LawKind::kReplica && !serves_only(j, i, session)) return;
    const control::EndState& spring = session.seat(i).end(j).state();
    for (std::size_t a = 0; a < scene_->dof; ++a) change[a] += by * spring.k[a] * (spring.ref[a] - (tool.x(a) - tool.moved()[a]));
  }
  const double ms = 1e3 / scene_->tick_hz;
  if (tip_norm(change, scale_, scene_->dof) > kFeltMax * ms) violations_.note("authority_felt", scene_->tools[j].name, t_, false);
}

}  // namespace tandem::netsim
