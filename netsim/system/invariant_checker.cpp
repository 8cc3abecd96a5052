#include "netsim/system/invariant_checker.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include "server/session/session_invariant_checker.h"

namespace tandem::netsim {

namespace {

// Limits of the force gate and of authority (design notes, control 7; security 2.4). The checker has its own copy: a
// checker that read them from the guard would follow the guard's errors.
constexpr double kSlewActive = 1000, kSlewRampIn = 10;  // [N/s]
constexpr double kGateStepMax = 0.01;                   // [s], lateness that the slew limit makes up for
constexpr double kRampOut = 0.1;                        // [s]
constexpr double kLossSlew = 10;                        // [1/s] when a seat with authority is lost
constexpr double kEvaluatorShare = 0.5;                 // share of force and tank for evaluators
constexpr double kStoppedMax = 0.22;                    // [s] for which a stopped hand may keep authority
/// Returns whether the state disengages all hands: a stopped or paused session, or an overloaded server.
constexpr bool lets_go(wire::SessionState state) noexcept {
  return state == wire::SessionState::kStopped || state == wire::SessionState::kPaused ||
         state == wire::SessionState::kOverloaded;
}
constexpr unsigned kMisreadMax = 3;                                   // samples for which the last good reading is used
constexpr double kTankPerKg = 0.18, kTankMin = 0.02, kTankMax = 0.1;  // [J/kg], [J]
constexpr double kSpeedMax = 1.6;                                     // [m/s], and the number of consecutive samples
constexpr unsigned kFastMax = 5;
constexpr double kTankSlack = 1e-3;  // [J] that a hand pulling along overdraws within one tick
constexpr double kUnseen = 1.6e-4;  // [m] that the gate cannot see, because it measures by encoders: two of their steps
constexpr double kLatePower = 1;    // [W] that a hand at 2 m/s overdraws while its program wakes up late
constexpr double kFeltMax = 0.2;    // [N/ms] that a step of authority may cause
constexpr double kFeltSlewMax = 10;  // [1/s] of authority; above it, users feel the shares of the stiffest springs
constexpr double kLifeTicks = 3, kLifeMin = 0.005, kLifeMax = 0.03,
                 kFade = 0.02;  // ticks, [s]: validity of a command, and the fade of its force after that
constexpr double kFarTouch = 1, kFarLinear = 50;  // [m] out of reach on such a device; a rail has no end

double tip_norm(const AxisArray& effort, const AxisArray& scale, std::size_t dof) noexcept {
  double sum = 0;
  for (std::size_t a = 0; a < dof; ++a) sum += effort[a] * effort[a] / scale[a];
  return std::sqrt(sum);
}

bool all_finite(const AxisArray& v, std::size_t dof) noexcept {
  return std::all_of(v.begin(), v.begin() + static_cast<std::ptrdiff_t>(dof),
                     [](double e) { return std::isfinite(e); });
}

}  // namespace

InvariantChecker::InvariantChecker(const SceneSpec& scene)
    : scene_(&scene),
      seats_(scene.seats.size()),
      alpha_(scene.tools.size()),
      held_(scene.tools.size(), true),
      transfers_(scene) {}

/// Ordinary motion requires that no two hands pull against each other and no hand is pushed. Both empty the energy
/// accounts, as intended. Scenes with a lower heat credit, gated flow sources or a seat on several tools are excluded
/// for the same reason.
bool InvariantChecker::begin_recovery_phase() noexcept {
  const auto passive = [](const SeatSpec& s) {
    return s.kind == SeatKind::kSlave || s.hand.model == HandModel::kRelaxed || s.hand.model == HandModel::kNone;
  };
  const auto pushed = [](const SeatSpec& s) { return !s.hand.deviations.empty(); };
  ordinary_ = scene_->channel.law == LawKind::kSetPosition && scene_->channel.mfs == MfsMode::kOpen &&
              scene_->channel.eta >= ChannelSpec{}.eta && scene_->tools.size() == 1 &&
              std::ranges::none_of(scene_->seats, pushed) &&
              std::ranges::count_if(scene_->seats, std::not_fn(passive)) == 1;
  if (ordinary_)
    moving_seat_ = static_cast<std::size_t>(std::ranges::find_if_not(scene_->seats, passive) - scene_->seats.begin());
  return ordinary_;
}

void InvariantChecker::on_server_datagram(std::size_t seat, std::uint64_t index) noexcept {
  SeatState& s = seats_[seat];
  // The order of sending is not compared: after a path challenge or a drop, an older datagram may act later than a
  // newer one.
  if (s.given_to_server.is_first(index)) ++s.server_heard;
}

void InvariantChecker::note(std::string_view invariant, std::size_t seat, bool expected) {
  violations_.add(invariant, scene_->seats[seat].name, t_, expected);
}

void InvariantChecker::check(std::uint32_t lived, const server::Session& session,
                             const std::vector<SimulatedClient>& stations) {
  t_ = session.clock().time();
  server::SessionInvariantChecker{}.check(session, violations_);
  check_restart_barrier(session);
  check_authority(lived, session);
  if (lived > 0) transfers_.check(lived, session, violations_);
  for (std::size_t i = 0; i < stations.size(); ++i) {
    const SimulatedClient& station = stations[i];
    SeatState& s = seats_[i];
    const server::SeatEndpoint& port = session.seat(i);
    const client::Seat* seat = station.seat();
    if (seat != nullptr) scale_ = seat->setup().axis_scale;
    const hal::sim::GroundTruth& truth = station.device().ground_truth();
    const double far = scene_->seats[i].device.model == DeviceModel::kTouch ? kFarTouch : kFarLinear;
    if (!truth.x.allFinite() || truth.x.norm() > far) note("diverged", i);
    check_energy(i, station);
    if (scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster) check_hand(i, station);
    if (s.starts != station.starts()) s.reset_for_restart(station.starts());
    if (s.joins != station.joins()) {  // a new connection: its counters start at 0, the hand continues
      s.joins = station.joins();
      s.accepted = s.session_tick = 0;
      for (EndState& end : s.client) end.known = false;
    }
    check_role(i, station, port);

    const bool slave = scene_->seats[i].kind == SeatKind::kSlave;
    if (lived == 1 && (slave || scene_->tools.size() == 1 || scene_->channel.law == LawKind::kReplica)) {
      check_server_ends(i, session, seat, slave);
    } else {
      for (EndState& end : s.server) end.known = false;
    }
    check_once(i, station, port);
    if (seat == nullptr) continue;
    if (!station.ran_in_tick()) {
      for (EndState& end : s.client) end.known = false;
      continue;
    }
    const Time own = station.own_time(station.last_run());
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

/// Checks the rights of roles with its own copy of the rules. Observers receive no force. A stopped hand is disengaged
/// and affects nothing. A stopped session engages no seat. Forged requests for authority have no effect.
void InvariantChecker::check_role(std::size_t i, const SimulatedClient& station, const server::SeatEndpoint& port) {
  const Role role = scene_->seats[i].role;
  const bool watches = role == Role::kObserver && scene_->seats[i].kind == SeatKind::kMaster;
  if (watches && port.tx.engage) note("observer_force", i);
  const bool stopped = lets_go(port.tx.session);
  if (stopped && port.tx.engage) note("stop_engages_nobody", i);
  const client::Seat* seat = station.seat();
  if (seat == nullptr || !station.ran_in_tick()) return;
  if (watches && tip_norm(seat->effort(), seat->setup().axis_scale, scene_->dof) > 0) note("observer_force", i);
  if (seat->requests().locally_stopped() && seat->gate().active()) note("own_stop", i);
}

/// Checks the restart barrier: after a restart of the server no seat engages before all seats with authority are back.
/// An instructor may resume the session earlier.
void InvariantChecker::check_restart_barrier(const server::Session& session) {
  if (session.epoch() != epoch_) {
    epoch_ = session.epoch();
    recovering_ = true;
    for (SeatState& s : seats_) s.required_for_resume = s.led;
  }
  bool away = false, engages = false;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    SeatState& s = seats_[i];
    away |= s.required_for_resume && !session.seat(i).taken();
    engages |= session.seat(i).tx.engage;
    s.led = false;
    for (std::size_t j = 0; i < scene_->masters() && j < scene_->tools.size(); ++j)
      s.led |= session.tool(j).transfer.scheduled()[i] > 0 && session.seat(i).taken() && !recovering_ &&
               session.clock().session_tick() > 0;
    s.led |= recovering_ && s.required_for_resume;
  }
  participant_missing_ = away;
  if (recovering_ && away && engages) violations_.add("gathering", "", t_, false);
}

/// Checks that the client releases a hand whose reading stays frozen while the reference moves far and the pull
/// changes.
void InvariantChecker::check_sensor(std::size_t i, const SimulatedClient& station) {
  constexpr double kLong = 0.2, kFar = 0.01, kPull = 1;  // [s], [m], [N]: twice the guard's limits
  const client::Seat& seat = *station.seat();
  SeatState::Frozen& was = seats_[i].frozen;
  const Time now = station.last_run();
  const AxisArray& ref = seat.tools().end(0).state().ref;
  const bool frozen = scene_->seats[i].kind == SeatKind::kMaster && seat.gate().active() &&
                      station.has_fault(Fault::Kind::kFrozen, now) && !station.invalid_reading();
  if (!frozen || !was.on) was = {now, ref, seat.effort(), frozen};
  if (!frozen || seconds(now - was.since) < kLong) return;
  double way = 0, pull = 0;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    way += (ref[a] - was.ref[a]) * (ref[a] - was.ref[a]) * scale_[a];
    pull += (seat.effort()[a] - was.effort[a]) * (seat.effort()[a] - was.effort[a]) / scale_[a];
  }
  if (way > kFar * kFar && pull > kPull * kPull) note("frozen_sensor", i);
}

void InvariantChecker::on_audit_event(const server::AuditEvent& e) {
  using What = server::AuditEvent::What;
  if (e.what == What::kAllBack) {
    const bool by_itself = e.seat >= scene_->seats.size();  // otherwise an instructor resumed without the missing seats
    if (recovering_ && by_itself && participant_missing_) violations_.add("gathering", "", t_, false);
    recovering_ = false;
  }
  transfers_.on_audit_event(e);
  if (e.seat >= scene_->seats.size()) return;
  const Role role = scene_->seats[e.seat].role;
  if ((e.what == What::kStop || e.what == What::kResume || e.what == What::kAllBack) && role != Role::kInstructor)
    note("role", e.seat);
  if (e.what == What::kPause && role != Role::kTrainee && role != Role::kEvaluator) note("role", e.seat);
  if (e.what == What::kAuthority && role != Role::kInstructor) {
    if (role != Role::kTrainee || e.after[e.seat] > e.before[e.seat] + 1e-9) note("role", e.seat);
    for (std::size_t k = 0; k < scene_->masters(); ++k)
      if (k != e.seat && scene_->seats[k].role != Role::kInstructor && std::abs(e.after[k] - e.before[k]) > 1e-9)
        note("role", e.seat);
  }
}

void InvariantChecker::check_effort(Time own, std::size_t i, const SimulatedClient& station) {
  const client::Seat& seat = *station.seat();
  const SeatState& s = seats_[i];
  const AxisArray& scale = seat.setup().axis_scale;
  if (!all_finite(seat.effort(), scene_->dof)) return note("effort_finite", i);
  if (!all_finite(seat.sample().port.x, scene_->dof) || !all_finite(seat.sample().port.v, scene_->dof))
    note("sample_finite", i);
  const double norm = tip_norm(seat.effort(), scale, scene_->dof);
  if (norm > share(i) * scene_->gate.force_max * (1 + 1e-9)) note("effort_limited", i);
  if (!seat.gate().active() || norm == 0) return;  // an immediate release is always allowed
  // After a pause longer than the validity of a command plus the device's fade, the motors have no force. The next
  // effort is then a step from zero, not from the effort that the program remembers.
  const double forgotten = std::clamp(kLifeTicks / scene_->tick_hz, kLifeMin, kLifeMax) + kFade;
  const bool stood_still = s.served != Time{} && seconds(own - s.served) > forgotten;
  AxisArray change{};
  for (std::size_t a = 0; a < scene_->dof; ++a) change[a] = seat.effort()[a] - (stood_still ? 0 : s.effort[a]);
  const double dt = s.served == Time{} ? 0 : std::clamp(seconds(own - s.served), 0.0, kGateStepMax);
  const double rate = seat.gate().phase() == control::GatePhase::kRampIn ? kSlewRampIn : kSlewActive;
  if (tip_norm(change, scale, scene_->dof) > rate * dt * (1 + 1e-6) + 1e-9) note("effort_slew", i);
}

void InvariantChecker::check_silence(Time own, std::size_t i, const SimulatedClient& station) {
  const Time now = station.last_run();
  const client::Seat& seat = *station.seat();
  SeatState& s = seats_[i];
  const transport::LinkTiming& fresh = seat.link().timing();
  if (fresh.heard() && fresh.arrived() != s.arrived) {
    s.arrived = fresh.arrived();
    s.silence_limit = 0;
    s.fresh = now;
    // A datagram that makes the gate release also restarts the sum, except one so old that it ended the link.
    if (seat.gate().active() || (s.was_active && seat.gate().trips() == s.trips)) s.given = 0;
  }
  const double half_tick = 0.5 / scene_->tick_hz;
  if (s.fresh != Time{}) {
    const double silence = seconds(now - s.fresh);
    const bool hand = scene_->seats[i].kind == SeatKind::kMaster;
    // The longest limit since the last fresh datagram applies. A client that loses authority or its server during a
    // silence releases from that moment.
    s.silence_limit = std::max(s.silence_limit,
                               hand ? silence_limits(scene_->gate, scene_->channel.law, seat.tools().authority()).most
                                    : scene_->gate.silence_limit);
    const double limit = s.silence_limit;
    if (seat.gate().active() && silence > limit + half_tick) note("silence_ramps", i);
    if (silence > limit + kRampOut + 3 * half_tick) {
      double power = 0;  // the remaining force may brake a hand and never push it
      for (std::size_t a = 0; a < scene_->dof; ++a) power += seat.effort()[a] * seat.sample().port.v[a];
      if (power > 1e-9) note("silence_brakes", i);
    }
  }
  const bool replica = scene_->channel.law == LawKind::kReplica && scene_->seats[i].kind == SeatKind::kMaster;
  const double patience = replica ? silence_limits(scene_->gate, LawKind::kReplica, seat.tools().authority()).most : 0;
  if (seat.gate().active() && seconds(fresh.loop_age(own)) > scene_->gate.loop_age_max + patience + 1e-9)
    note("loop_age", i);
}

/// Returns the share of force and tank that this hand may receive.
double InvariantChecker::share(std::size_t i) const noexcept {
  return scene_->seats[i].role == Role::kEvaluator ? kEvaluatorShare : 1;
}

/// Checks that the client disengages a hand faster than users move, and a hand whose device reports motors that are too
/// hot.
void InvariantChecker::check_speed(std::size_t i, const SimulatedClient& station) {
  const bool fast = station.seat()->gate().active() && !station.invalid_reading() &&
                    !station.has_fault(Fault::Kind::kFrozen, station.last_run()) &&
                    station.device().state().dx.norm() > kSpeedMax;
  seats_[i].fast = fast ? seats_[i].fast + 1 : 0;
  if (seats_[i].fast > kFastMax) note("over_speed", i);
  const bool hot = station.seat()->gate().active() && !station.invalid_reading() &&
                   station.has_fault(Fault::Kind::kHot, station.last_run());
  seats_[i].hot = hot ? seats_[i].hot + 1 : 0;
  if (seats_[i].hot > kFastMax) note("over_temperature", i);
}

/// Checks the energy that a motor delivers after the last fresh datagram: at most the tank of its gate. The check uses
/// the work of the motor, not the gate's own account.
void InvariantChecker::check_energy(std::size_t i, const SimulatedClient& station) {
  SeatState& s = seats_[i];
  const client::Seat* seat = station.seat();
  if (seat == nullptr || s.fresh == Time{}) return;
  if (seat->gate().active() && !s.was_active) s.given = 0;
  s.given += station.motor_work();
  // An effort acts until the program wakes up again; the gate cannot take it back earlier.
  s.late = s.awake ? 0 : s.late + 1 / scene_->tick_hz;
  s.awake = station.ran_in_tick();
  const double tank = share(i) * std::clamp(kTankPerKg * station.device().caps().mass.value_or(0), kTankMin, kTankMax);
  const double unseen = share(i) * scene_->gate.force_max * kUnseen;
  if (s.given > tank + kTankSlack + unseen + kLatePower * s.late) note("loss_energy", i);
}

void InvariantChecker::check_reading(std::size_t i, const SimulatedClient& station) {
  const client::Seat& seat = *station.seat();
  SeatState& s = seats_[i];
  s.invalid_readings = station.invalid_reading() ? s.invalid_readings + 1 : 0;
  if (s.invalid_readings <= kMisreadMax) return;
  if (seat.gate().phase() != control::GatePhase::kFault ||
      tip_norm(seat.effort(), seat.setup().axis_scale, scene_->dof) != 0)
    note("bad_reading_faults", i);
}

/// Checks that a datagram acts at most once and never backwards. No more datagrams act than arrived new, and their
/// ticks never decrease.
void InvariantChecker::check_once(std::size_t i, const SimulatedClient& station, const server::SeatEndpoint& port) {
  SeatState& s = seats_[i];
  if (port.generation() >= s.generation) {
    if (port.generation() - s.generation > s.server_heard) note("acts_once", i);
    if (port.last_state().seat_tick < s.seat_tick) note("never_backwards", i);
  }
  s.generation = port.generation();
  s.seat_tick = port.last_state().seat_tick;
  s.server_heard = 0;
  const client::Seat* seat = station.seat();
  if (seat == nullptr) return;
  const std::uint64_t accepted = seat->link().stats().accepted;
  if (accepted > s.accepted && accepted - s.accepted > station.new_datagrams()) note("acts_once", i);
  if (seat->force().session_tick < s.session_tick) note("never_backwards", i);
  s.accepted = accepted;
  s.session_tick = seat->force().session_tick;
}

void InvariantChecker::check_authority(std::uint32_t lived, const server::Session& session) {
  for (std::size_t i = 0; i < scene_->masters(); ++i)
    seats_[i].stopped_s = session.seat(i).taken() && session.seat(i).last_state().stop
                              ? seats_[i].stopped_s + lived / scene_->tick_hz
                              : 0;
  const double step = std::max(scene_->alpha_slew, kLossSlew) * lived / scene_->tick_hz + 1e-9;
  for (std::size_t j = 0; j < scene_->tools.size(); ++j) {
    const control::ToolAuthority& row = session.tool(j).authority;
    const bool stopped = lets_go(session.state());
    if (stopped && lived > 0 && !row.held()) violations_.add("stop_holds_tools", scene_->tools[j].name, t_, false);
    for (std::size_t i = 0; i < scene_->masters(); ++i) {
      const double alpha = row.alpha(i);
      const bool refused =
          session.seat(i).last_state().stop || session.seat(i).misbehaviour().quarantined(session.clock().last_tick());
      if (refused && lived == 1 && !held_[j] && alpha > alpha_[j][i] + 1e-9) note("refused_gains_weight", i);
      if (alpha > 0 && seats_[i].stopped_s > kStoppedMax) note("stop_takes_weight", i);
      const Role role = scene_->seats[i].role;
      if (alpha > 0 && (role == Role::kEvaluator || role == Role::kObserver)) note("authority_role", i);
      if (!row.held() && !held_[j] && std::abs(alpha - alpha_[j][i]) > step) note("authority_slew", i);
    }
    if (lived == 1 && !row.held()) check_felt_authority(j, session);
    for (std::size_t i = 0; i < scene_->masters(); ++i) alpha_[j][i] = row.alpha(i);
    held_[j] = row.held();
  }
}

/// Returns whether this seat's spring pulls at no other tool. Only then the motor's force limit bounds its elongation.
bool InvariantChecker::serves_only(std::size_t tool, std::size_t i, const server::Session& session) const noexcept {
  for (std::size_t j = 0; j < scene_->tools.size(); ++j)
    if (j != tool && (session.tool(j).authority.alpha(i) > 0 || scene_->follow[i][j] > 0)) return false;
  return true;
}

/// Checks the force step of a change of authority: every spring at the tool then pulls with another share of its force.
/// In this tick, no motor can pass more of that step to a hand. Tool and hand are separated by a mass and a spring.
void InvariantChecker::check_felt_authority(std::size_t j, const server::Session& session) {
  if (scene_->alpha_slew > kFeltSlewMax) return;  // the scene allows faster changes
  const server::Tool& tool = session.tool(j);
  AxisArray change{};
  for (std::size_t i = 0; i < scene_->masters(); ++i) {
    const double by = tool.authority.alpha(i) - alpha_[j][i];
    if (by == 0) continue;
    if (scene_->channel.law != LawKind::kReplica && !serves_only(j, i, session)) return;
    const control::EndState& spring = session.seat(i).end(j).state();
    for (std::size_t a = 0; a < scene_->dof; ++a)
      change[a] += by * spring.k[a] * (spring.ref[a] - (tool.x(a) - tool.port().moved[a]));
  }
  const double ms = 1e3 / scene_->tick_hz;
  if (tip_norm(change, scale_, scene_->dof) > kFeltMax * ms)
    violations_.add("authority_felt", scene_->tools[j].name, t_, false);
}

}  // namespace tandem::netsim
