#include "client/seat/seat.h"

#include <algorithm>
#include <cmath>
#include <ranges>
#include <utility>

#include "client/seat/device_facts.h"
#include "common/base/command_lifetime.h"
#include "common/setup/channel_factory.h"
#include "common/setup/device_stiffness.h"

namespace tandem::client {

namespace {

using namespace std::chrono_literals;

constexpr Duration kAuthorityRepeat = 20ms;
constexpr Duration kAuthorityTimeout = 1s;   // a request without effect by then is dropped
constexpr std::uint64_t kLearnSamples = 50;  // measured round trips before the seat reports ready
constexpr unsigned kBadReadingsHeld = 3;     // bad readings replaced by the last good one before the gate faults

control::GateParams gate_params(const SeatSetup& s, const hal::DeviceCaps& caps) {
  control::GateParams g;
  g.dof = s.dof;
  g.scale = s.axis_scale;
  g.force_max = s.gate.force_max;
  for (std::size_t a = 0; a < caps.tip_axes; ++a)
    if (caps.axis[a].peak) g.force_max = std::min(g.force_max, *caps.axis[a].peak);
  g.force_max *= share_of_force(s.seat.role);  // the client limits the force by role independently of the server
  g.tank_share = share_of_force(s.seat.role);
  g.mass = caps.mass.value_or(g.mass);
  g.silence_limit = from_seconds(s.gate.silence_limit);
  g.loop_age_max = from_seconds(s.gate.loop_age_max);
  g.ramp_in = from_seconds(s.gate.ramp_in);
  g.latch = s.gate.latch;
  g.command_lifetime = command_lifetime(from_seconds(1.0 / s.tick_hz));
  return g;
}

std::vector<std::unique_ptr<control::ChannelEnd>> make_ends(const SeatSetup& s) {
  std::vector<std::unique_ptr<control::ChannelEnd>> ends;
  for (std::size_t k = 0; k <= s.further.size(); ++k)
    ends.push_back(setup::make_channel(s.channel, control::Side::kClient, s.dof, s.axis_scale,
                                       s.gate.force_max * share_of_force(s.seat.role), s.coupling.k_c, !s.unsafe_gains,
                                       s.seat.kind == SeatKind::kSlave ? std::optional{s.k_s} : std::nullopt));
  return ends;
}

wire::GateState wire_state(control::GatePhase p) noexcept { return static_cast<wire::GateState>(p); }
static_assert(static_cast<int>(control::GatePhase::kFault) == static_cast<int>(wire::GateState::kFault));

/// Limits of a plausible reading: joints [rad or m] and [rad/s or m/s], tip [m] and [m/s], entries of J [m or 1].
constexpr double kJointMax = 100, kJointRateMax = 1000, kTipMax = 10, kTipSpeedMax = 100, kJacobianMax = 100;

/// True if all values are within the limits above. NaN is not plausible, because every comparison with NaN is false.
bool plausible(const hal::State& s, std::size_t joints) noexcept {
  for (std::size_t j = 0; j < joints; ++j)
    if (!(std::abs(s.q[j]) <= kJointMax) || !(std::abs(s.dq[j]) <= kJointRateMax)) return false;
  return (s.x.array().abs() <= kTipMax).all() && (s.dx.array().abs() <= kTipSpeedMax).all() &&
         (s.J.array().abs() <= kJacobianMax).all();
}

}  // namespace

Seat::Seat(const SeatSetup& setup, const hal::DeviceCaps& caps, const transport::SecureChannel::Params& link)
    : setup_(setup::with_limited_stiffness(setup, device_facts(caps))),  // the client limits it, whatever it receives
      map_(setup.port, setup.dof, caps.joints),
      joints_(caps.joints),
      dt_(1.0 / setup.tick_hz),
      command_life_(command_lifetime(from_seconds(dt_))),
      link_(std::make_unique<transport::SecureChannel>(link)),
      codec_(setup.dof, setup.port, setup.further.size()),
      ends_(make_ends(setup_)),
      coupling_(make_coupling(setup_)),
      gate_(gate_params(setup, caps)),
      further_rx_(setup.further.size()),
      further_next_(setup.further.size()),
      further_tx_(setup.further.size()),
      ties_(ends_.size()) {
  bind_ties();
}

void Seat::bind_ties() noexcept {
  for (std::size_t k = 0; k < ties_.size(); ++k) ties_[k] = {ends_[k].get(), k == 0 ? &rx_ : &further_rx_[k - 1]};
}

double Seat::authority() const noexcept {
  return std::ranges::max(ties_ | std::views::transform([](const Coupling::Tie& tie) { return tie.received->alpha; }));
}

Seat::Connection Seat::prepare(const transport::SecureChannel::Params& link) const {
  return {std::make_unique<transport::SecureChannel>(link), make_ends(setup_)};
}

void Seat::reconnect(const transport::SecureChannel::Params& link) {
  Connection next = prepare(link);
  reconnect(next);
}

void Seat::reconnect(Connection& next) noexcept {
  std::swap(link_, next.link);
  std::swap(ends_, next.ends);
  bind_ties();
  rest();
  closed_ = closed_ && leaving_;
  rx_ = {};
  std::ranges::fill(further_rx_, wire::ToolForce{});
  fresh_ = heard_force_ = false;
  session_start_.reset();
  tx_.seat_tick = 0;
  path_answer_.reset();
  authority_.reset();
  stops_at_request_.reset();
  resume_stop_ = 0;
}

void Seat::on_datagram(Time now, std::span<const std::byte> bytes) noexcept {
  const auto opened = link_->open(now, bytes);
  if (!opened) return;
  if (opened->type == wire::Type::kForce) {
    const auto decoded = codec_.decode_force(opened->plaintext, further_next_);
    if (!decoded) return link_->drop_body();
    if (!opened->newer) return;  // a datagram older than the newest one must not act
    link_->accept(now, *opened, decoded->preamble);
    if (rx_.session == wire::SessionState::kWaiting && decoded->message.session == wire::SessionState::kRunning)
      link_->restart_statistics(now);
    rx_ = decoded->message;
    std::ranges::copy(further_next_, further_rx_.begin());
    fresh_ = heard_force_ = true;
    if (rx_.contacts.size > 0) coupling_->set_contacts(0, rx_.contacts.all());
    for (std::size_t k = 0; k < further_rx_.size(); ++k)
      if (further_rx_[k].contacts.size > 0) coupling_->set_contacts(k + 1, further_rx_[k].contacts.all());
    set_session_clock(now);
    if (authority_ && rx_.authority_version != authority_->version) on_new_authority_version();
    clear_satisfied_requests();
  } else if (opened->type == wire::Type::kClose) {
    const auto decoded = codec_.decode_close(opened->plaintext);
    if (!decoded) return link_->drop_body();
    closed_ = true;
    close_reason_ = decoded->message.reason;
  } else if (opened->type == wire::Type::kPathChallenge) {
    const auto decoded = codec_.decode_path(opened->plaintext);
    if (!decoded) return link_->drop_body();
    link_->accept_other();
    path_answer_ = decoded->message;
  } else {
    link_->drop_body();
  }
}

/// Drops or renews the pending authority request after another authority decision. The user did not see that decision,
/// so the request may no longer be intended. Exception: if the decision granted this seat's previous request, the
/// pending one already builds on it and is sent against the new version.
void Seat::on_new_authority_version() noexcept {
  const bool own = rx_.authority_version == authority_->version + 1 &&
                   rx_.transfer != wire::TransferNotice::kCancelled && setup_.seat.kind == SeatKind::kMaster &&
                   rx_.transfer_parties.by == setup_.own_master + 1;
  if (!authority_follows_ || !own) return authority_.reset();
  authority_->version = rx_.authority_version;
  authority_sent_ = Time{};
  authority_follows_ = false;
}

/// Sets the session clock when the session begins and again after each stop. Only the server knows exactly how long the
/// clock was halted.
void Seat::set_session_clock(Time now) noexcept {
  if (clock_stopped()) return;
  const bool runs = rx_.session == wire::SessionState::kRunning;
  const bool anew =
      session_start_ && rx_.stops != stops_at_clock_ && !setup_.clock_runs_while_stopped &&
      (runs || rx_.session == wire::SessionState::kHeld || rx_.session == wire::SessionState::kOverloaded);
  if (!anew && (session_start_ || !runs)) return;
  const Time begin = now - link_->timing().age(now) - from_seconds(rx_.session_tick * dt_);
  if (anew) *first_session_start_ += begin - *session_start_;
  session_start_ = begin;
  stops_at_clock_ = rx_.stops;
  if (!first_session_start_) first_session_start_ = session_start_;
}

bool Seat::clock_stopped() const noexcept {
  return !setup_.clock_runs_while_stopped &&
         (rx_.session == wire::SessionState::kPaused || rx_.session == wire::SessionState::kStopped);
}

bool Seat::take_reading(const hal::State& device) noexcept {
  if (plausible(device, joints_) && !device.stale) {
    reading_ = device;
    bad_readings_ = 0;
  } else {
    ++bad_readings_;  // the last good reading replaces it, then the gate faults
    if (device.stale) reading_.tau_out = device.tau_out;
  }
  q_ = map_.position(reading_);
  v_ = map_.velocity(reading_);
  return bad_readings_ <= kBadReadingsHeld;
}

hal::Command Seat::on_servo(Time now, const hal::State& device) noexcept {
  if (!ticked_) {
    ticked_ = true;
    started_ = now;
  }
  tick_ = static_cast<std::uint32_t>(std::llround(seconds(now - started_) / dt_));
  link_->tick(now);
  if (tick_ % 256 == 0)
    age_p99_ms_ = 1e3 * seconds(Duration{link_->stats().age.quantile(0.99)});  // iterates over bins: too slow per tick
  const bool valid = take_reading(device);
  meter_.advance(joints_, reading_.q, reading_.tau_out);

  const bool was_active = gate_.active();
  AxisArray wanted{};
  if (was_active) {
    wanted = control(now);
  } else {
    rest();
  }

  control::ForceGate::Input in;
  in.now = now;
  in.fresh = fresh_;
  in.loop_age = link_->timing().loop_age(now);
  in.rtt_p99 = link_->timing().rtt_p99();
  if (setup_.channel.law == LawKind::kReplica && setup_.seat.kind == SeatKind::kMaster) {
    const SilenceLimits limits = silence_limits(setup_.gate, LawKind::kReplica, authority());
    in.silence_allowance = link_->timing().gaps().silence_limit(from_seconds(limits.least), from_seconds(limits.most));
  }
  if (setup_.seat.kind == SeatKind::kMaster)  // a slave in contact with a stiff object may rest without a stuck sensor
    stuck_sensor_.update(now, reading_.q, joints_, ends_[0]->state().ref, effort_, setup_.axis_scale, setup_.dof,
                         was_active);
  if (reset_) {
    overspeed_.reset();
    overtemperature_.reset();
  }
  overspeed_.update(now, reading_.dx.norm(), was_active);
  overtemperature_.update(reading_.heat, was_active);
  in.engage = may_engage();
  in.reset = reset_;
  in.reading_valid = valid;
  in.wanted = wanted;
  in.q = q_;
  in.v = v_;
  const auto out = gate_.step(in);
  fresh_ = reset_ = false;
  effort_ = out.effort;
  if (was_active) coupling_->set_delivered(effort_);
  if (was_active != gate_.active()) rest();  // the coupling restarts with zero elongation

  fill_sample(now, device, wanted);
  if (leaving_ && !gate_.active() && gate_.phase() != control::GatePhase::kReleasing && close_due_ == 0 && !closed_)
    close_due_ = 3;
  state_due_ = true;

  hal::Command command;
  command.seq = ++command_seq_;
  command.expires = now + command_life_;
  command.kind = hal::CommandKind::kJointEffort;
  command.effort = map_.joint_effort(reading_, effort_);
  return command;
}

bool Seat::may_engage() const noexcept {
  const bool session = rx_.session == wire::SessionState::kWaiting || rx_.session == wire::SessionState::kRunning ||
                       rx_.session == wire::SessionState::kHeld;
  // The server never engages observers; the client checks the role independently.
  return rx_.engage && session && heard_force_ && !leaving_ && !closed_ && !local_stop_ && !stuck_sensor_.stuck() &&
         !inhibited() && setup_.seat.role != Role::kObserver;
}

Coupling::Input Seat::coupling_input(double age) const noexcept {
  return {.dt = dt_, .age = age, .q = q_, .v = v_, .ties = ties_, .ghost = &rx_.ghost};
}

AxisArray Seat::control(Time now) noexcept {
  return coupling_->step(coupling_input(seconds(link_->timing().age(now))));
}

std::optional<hal::Vec3> Seat::offset_from_leader(Time now) const noexcept {
  const wire::Ghost& ghost = rx_.ghost;
  if (!heard_force_ || ghost.leader == 0) return std::nullopt;
  const double age = seconds(link_->timing().age(now));
  hal::Vec3 beside = reading_.x;
  for (std::size_t k = 0; k < 3; ++k)
    beside[static_cast<Eigen::Index>(k)] -= control::Prediction::place_for_hand(ghost.x[k], ghost.v[k], age);
  return beside;
}

void Seat::rest() noexcept {
  const auto& f = link_->timing();
  coupling_->reset(coupling_input(f.heard() ? std::max(0.0, 0.5 * seconds(f.rtt_p50()) - 0.5 * dt_) : 0), heard_force_);
}

void Seat::fill_sample(Time now, const hal::State& device, const AxisArray& wanted) noexcept {
  const bool engaged = gate_.active();
  const Coupling::Input now_here = coupling_input(0);
  for (std::size_t k = 0; k < ties_.size(); ++k) {
    PortSample& said = k == 0 ? tx_.port : further_tx_[k - 1];
    coupling_->fill_sample(k, now_here, engaged, said);
    said.e_in = ends_[k]->e_in();
  }
  const auto put = [](std::array<double, 3>& to, const hal::Vec3& from) {
    for (int i = 0; i < 3; ++i) to[static_cast<std::size_t>(i)] = from[i];
  };
  wire::Telemetry& t = tx_.telemetry;
  t.q = reading_.q;
  put(t.x, reading_.x);
  put(t.f_cmd, map_.tip_force(reading_, wanted));
  put(t.f_out, reading_.f_out);
  put(t.f_env, reading_.f_env);
  t.penetration_m = reading_.penetration;
  t.e_out = ends_[0]->e_out();
  const transport::SecureChannelStats& down = link_->stats();
  t.down_loss_percent = down.loss_percent();
  t.down_longest_gap_ms = 1e3 * seconds(down.longest_gap);
  t.down_age_p99_ms = age_p99_ms_;
  t.dissipated_j = coupling_->dissipated();
  t.refused_j = setup_.weight * ends_[0]->refused();
  t.delivered_j = meter_.total();
  t.margin_min_j = ends_[0]->margin_min();
  for (std::size_t k = 1; k < ends_.size(); ++k) {
    t.refused_j += setup_.further[k - 1].weight * ends_[k]->refused();
    t.margin_min_j = std::min(t.margin_min_j, ends_[k]->margin_min());
  }
  const bool guard_latched = latched() && gate_.phase() == control::GatePhase::kZero;
  tx_.gate =
      wire_state(guard_latched ? control::GatePhase::kLatched : gate_.phase());  // both wait for request_gate_reset
  tx_.engaged = engaged;
  const bool blocked =
      gate_.phase() == control::GatePhase::kLatched || gate_.phase() == control::GatePhase::kFault || inhibited();
  tx_.ready = device.homed && !blocked && !leaving_ && !local_stop_ && !stuck_sensor_.stuck() &&
              link_->timing().rtt_samples() >= kLearnSamples;
  tx_.stop = local_stop_;
  tx_.stop_all = stop_all_;
  tx_.resume_stop = resume_stop_;
  tx_.gate_trips = gate_.trips();
  // The client receives a stop late, so its clock is ahead of the server's halted one. seat_tick then holds its value:
  // it never decreases.
  tx_.seat_tick =
      std::max(tx_.seat_tick, static_cast<std::uint32_t>(std::max(0.0, server_time(now).value_or(0)) / dt_ + 0.5));
}

std::optional<std::size_t> Seat::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize) return std::nullopt;
  const auto body = buffer.subspan(transport::kHeaderSize);
  const auto seal = [&](wire::Type type, const auto& message) -> std::optional<std::size_t> {
    const std::size_t plain = codec_.encode(link_->preamble(now, tick_), message, body);
    const std::size_t size = plain == 0 ? 0 : link_->seal(now, type, buffer, plain);
    return size == 0 ? std::nullopt : std::optional{size};
  };
  if (path_answer_) return seal(wire::Type::kPathResponse, *std::exchange(path_answer_, std::nullopt));
  if (state_due_ && !closed_) {
    state_due_ = false;
    return further_tx_.empty() ? seal(wire::Type::kState, tx_)
                               : seal(wire::Type::kState, wire::StateWithTools{tx_, further_tx_});
  }
  if (authority_ && authority_sent_ != Time{} && now - authority_asked_ > kAuthorityTimeout) authority_.reset();
  if (authority_ && (authority_sent_ == Time{} || now - authority_sent_ >= kAuthorityRepeat)) {
    if (authority_sent_ == Time{}) authority_asked_ = now;
    authority_sent_ = now;
    return seal(wire::Type::kAuthority, *authority_);
  }
  if (close_due_ > 0) {
    if (--close_due_ == 0) {
      closed_ = true;
      close_reason_ = wire::CloseReason::kLeaving;
    }
    return seal(wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kLeaving});
  }
  return std::nullopt;
}

bool Seat::request_authority(std::uint32_t tool, std::span<const double> alpha) noexcept {
  const bool may = setup_.seat.role == Role::kInstructor ||
                   setup_.seat.role == Role::kTrainee;  // trainees may only return their own authority
  if (!may || alpha.size() > kMastersMax) return false;
  wire::AuthorityMessage m;
  m.version = rx_.authority_version;
  authority_follows_ = authority_ && (authority_follows_ || authority_sent_ != Time{});
  m.tool = tool;
  m.masters = static_cast<std::uint32_t>(alpha.size());
  std::copy(alpha.begin(), alpha.end(), m.alpha.begin());
  authority_ = m;
  authority_sent_ = Time{};
  return true;
}

bool Seat::request_stop_all() noexcept {
  if (setup_.seat.role == Role::kObserver || setup_.seat.kind == SeatKind::kSlave) return false;
  if (!stop_all_) stops_at_request_ = heard_force_ ? std::optional{rx_.stops} : std::nullopt;
  stop_all_ = true;
  return true;
}

void Seat::request_resume() noexcept {
  local_stop_ = false;
  const bool leads = setup_.seat.role == Role::kInstructor && setup_.seat.kind == SeatKind::kMaster;
  if (leads || (setup_.may_end_pauses && rx_.session == wire::SessionState::kPaused)) resume_stop_ = rx_.stops;
  clear_satisfied_requests();
}

/// Clears stop and resume requests as soon as the server's FORCE shows their effect; until then they are repeated.
void Seat::clear_satisfied_requests() noexcept {
  if (stop_all_ && !stops_at_request_) {  // requested before the first FORCE of this server
    stop_all_ = rx_.session != wire::SessionState::kStopped;
    stops_at_request_ = rx_.stops;
  }
  if (stop_all_ && rx_.stops != stops_at_request_) stop_all_ = false;
  const bool goes_on = rx_.session == wire::SessionState::kRunning || rx_.session == wire::SessionState::kHeld;
  if (resume_stop_ != rx_.stops || goes_on) resume_stop_ = 0;
}

std::optional<double> Seat::session_time(Time now) const noexcept {
  if (!first_session_start_ || (clock_stopped() && !session_start_)) return std::nullopt;
  if (clock_stopped()) return rx_.session_tick * dt_ + seconds(*session_start_ - *first_session_start_);
  return seconds(now - *first_session_start_);
}

std::optional<double> Seat::server_time(Time now) const noexcept {
  if (!session_start_) return std::nullopt;
  return clock_stopped() ? rx_.session_tick * dt_ : seconds(now - *session_start_);
}

}  // namespace tandem::client
