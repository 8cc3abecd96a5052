#include "client/seat/seat.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "client/seat/device_facts.h"
#include "common/base/command_lifetime.h"
#include "common/setup/device_stiffness.h"
#include "common/setup/send_pace.h"

namespace tandem::client {

namespace {

constexpr std::uint64_t kLearnSamples = 50;  // measured round trips before the seat reports ready

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

wire::GateState wire_state(control::GatePhase p) noexcept { return static_cast<wire::GateState>(p); }
static_assert(static_cast<int>(control::GatePhase::kFault) == static_cast<int>(wire::GateState::kFault));

}  // namespace

Seat::Seat(const SeatSetup& setup, const hal::DeviceCaps& caps, const transport::SecureChannel::Params& link)
    : setup_(setup::with_limited_stiffness(setup, device_facts(caps))),  // the client limits it, whatever it receives
      dt_(1.0 / setup.tick_hz),
      command_life_(command_lifetime(from_seconds(dt_))),
      channel_(link, wire::Codec{body_layout(setup)}),
      tools_(setup_),
      coupling_(make_coupling(setup_)),
      gate_(gate_params(setup, caps)),
      device_(setup.port, setup.dof, caps.joints),
      motion_scale_(setup.seat.motion_scale, setup.dof),
      separation_(setup, caps),
      guards_(setup, caps.joints),
      clock_(dt_, setup.clock_runs_while_stopped),
      telemetry_(setup.tick_hz),
      held_(setup::held_sample(setup)),
      requests_(setup) {
  if (!setup.send.is_on()) return;
  pace_.emplace(setup::send_pace(setup_, control::Side::kClient), 1 + setup_.further.size());
  wait_ = from_seconds(2 * (held_.limit() + dt_));
  telemetry_ = TelemetryPace(setup.tick_hz, 1);  // heartbeats come one tick before telemetry is due
}

Seat::Connection Seat::prepare(const transport::SecureChannel::Params& link) const {
  return {std::make_unique<transport::SecureChannel>(link), ToolChannels::make_ends(setup_)};
}

void Seat::reconnect(const transport::SecureChannel::Params& link) {
  Connection next = prepare(link);
  reconnect(next);
}

void Seat::reconnect(Connection& next) noexcept {
  channel_.swap_link(next.link);
  tools_.swap_ends(next.ends);
  rest();
  tools_.clear_received();
  clock_.on_reconnect();
  telemetry_.restart();
  if (pace_) pace_->restart();
  requests_.on_reconnect();
  close_out_.on_reconnect();
  state_.seat_tick = 0;
  fresh_ = false;
}

void Seat::on_datagram(Time arrived, std::span<const std::byte> bytes) noexcept {
  transport::SecureChannel& link = channel_.link();
  const auto opened = link.open(arrived, bytes);
  if (!opened) return;
  if (opened->type == wire::Type::kForce) {
    on_force(arrived, *opened);
  } else if (opened->type == wire::Type::kClose) {
    const auto decoded = channel_.codec().decode_close(opened->plaintext);
    if (!decoded) return link.drop_body();
    close_out_.on_close(decoded->message.reason);
  } else if (opened->type == wire::Type::kPathChallenge) {
    channel_.on_path_challenge(opened->plaintext);
  } else {
    link.drop_body();
  }
}

void Seat::on_force(Time arrived, const transport::SecureChannel::Opened& datagram) noexcept {
  transport::SecureChannel& link = channel_.link();
  const auto decoded = channel_.codec().decode_force(datagram.plaintext, tools_.further_next());
  if (!decoded) return link.drop_body();
  if (!datagram.newer) return;  // a datagram older than the newest one must not act
  link.accept(arrived, datagram, decoded->preamble);
  if (force().session == wire::SessionState::kWaiting && decoded->message.session == wire::SessionState::kRunning)
    link.restart_statistics(arrived);
  tools_.receive(decoded->message);
  held_.restart();
  fresh_ = true;
  for (std::size_t k = 0; k < tools_.size(); ++k)
    if (const LocalContactList& contacts = tools_.received(k).contacts; contacts.size > 0)
      coupling_->set_contacts(k, contacts.all());
  clock_.on_force(force(), link.timing().peer_sent());
  requests_.on_force(force());
}

hal::Command Seat::on_servo(Time now, const hal::State& device) noexcept {
  if (!first_tick_) first_tick_ = now;
  tick_ = static_cast<std::uint32_t>(std::llround(seconds(now - *first_tick_) / dt_));
  channel_.link().tick(now);
  if (tick_ % 256 == 0)
    age_p99_ms_ = 1e3 * seconds(Duration{link().stats().age.quantile(0.99)});  // iterates over bins: too slow per tick

  const bool was_active = gate_.active();
  control::ForceGate::Input in{.now = now,
                               .fresh = std::exchange(fresh_, false),
                               .loop_age = link().timing().loop_age(now) - wait_,
                               .rtt_p99 = link().timing().rtt_p99(),
                               .reset = requests_.take_gate_reset(),
                               .reading_valid = device_.update(device),
                               .q = device_.q(),
                               .v = device_.v()};
  motion_scale_.update(device_.q(), device_.v());
  if (separation_.on()) separation_.update(device_.reading(), motion_scale_);
  if (held_.on()) [[unlikely]]
    tools_.predict(held_, link().timing().silence(now));
  if (was_active) {
    in.wanted = motion_scale_.effort_at_hand(coupling_->step(coupling_input(sample_age(now))));
  } else {
    rest();
  }
  if (setup_.channel.law == LawKind::kReplica && setup_.seat.kind == SeatKind::kMaster) {
    const SilenceLimits limits = silence_limits(setup_.gate, LawKind::kReplica, tools_.authority());
    in.silence_allowance = link().timing().gaps().silence_limit(from_seconds(limits.least), from_seconds(limits.most));
  }
  if (in.reset) guards_.reset();
  guards_.update(now, device_.reading(), motion_scale_.position_at_hand(tools_.end(0).state().ref), effort_,
                 was_active);
  in.engage = may_engage();
  const control::ForceGate::Output out = gate_.step(in);
  effort_ = out.effort;
  if (was_active) coupling_->set_delivered(motion_scale_.effort_at_tool(effort_));
  if (was_active && gate_.phase() == control::GatePhase::kRampIn) coupling_->yield(out.held_back);
  if (was_active != gate_.active()) rest();

  fill_state(now, device.homed, in.wanted);
  if (!gate_.active() && gate_.phase() != control::GatePhase::kReleasing) close_out_.on_released();
  if (!pace_ || pace_->due(tick_, state_, tools_.further_samples())) [[likely]] {
    state_due_ = true;
    state_.with_telemetry = telemetry_.due(tick_, force().telemetry_every_tick);
  }

  return {.seq = ++command_seq_,
          .expires = now + command_life_,
          .kind = hal::CommandKind::kJointEffort,
          .effort = device_.joint_effort(effort_)};
}

bool Seat::may_engage() const noexcept {
  const wire::ForceMessage& f = force();
  const bool session = f.session == wire::SessionState::kWaiting || f.session == wire::SessionState::kRunning ||
                       f.session == wire::SessionState::kHeld;
  // The server never engages observers; the client checks the role independently.
  return f.engage && session && tools_.heard() && !close_out_.leaving() && !closed() && !requests_.locally_stopped() &&
         !guards_.inhibit() && setup_.seat.role != Role::kObserver;
}

Coupling::Input Seat::coupling_input(double age) const noexcept {
  return {.dt = dt_,
          .age = age,
          .q = motion_scale_.q(),
          .v = motion_scale_.v(),
          .tools = tools_.all(),
          .ghost = &force().ghost,
          .device_force = separation_.on() ? &separation_.force() : nullptr};
}

std::optional<hal::Vec3> offset_from_leader(const Seat& seat, Time now) noexcept {
  const wire::Ghost& ghost = seat.force().ghost;
  if (!seat.tools().heard() || ghost.leader == 0) return std::nullopt;
  const double age = seat.sample_age(now);
  hal::Vec3 offset = seat.device().reading().x;
  for (std::size_t k = 0; k < 3; ++k)
    offset[static_cast<Eigen::Index>(k)] -=
        control::Prediction::place_for_hand(ghost.x[k], ghost.v[k], age) / seat.motion_scale().value();
  return offset;
}

void Seat::rest() noexcept {
  const transport::LinkTiming& f = link().timing();
  coupling_->reset(coupling_input(f.heard() ? 0.5 * seconds(f.rtt_p50()) : 0), tools_.heard());
}

void Seat::fill_state(Time now, bool homed, const AxisArray& wanted) noexcept {
  const bool engaged = gate_.active();
  const Coupling::Input now_here = coupling_input(0);
  for (std::size_t k = 0; k < tools_.size(); ++k) {
    PortSample& sample = k == 0 ? state_.port : tools_.further_samples()[k - 1];
    coupling_->fill_sample(k, now_here, engaged, sample);
    sample.e_in = tools_.end(k).e_in();
  }
  wire::Telemetry& t = state_.telemetry;
  device_.fill(wanted, t);
  tools_.fill(t);
  const transport::SecureChannelStats& down = link().stats();
  t.down_loss_percent = down.loss_percent();
  t.down_longest_gap_ms = 1e3 * seconds(down.longest_gap);
  t.down_age_p99_ms = age_p99_ms_;
  t.dissipated_j = coupling_->dissipated();
  const control::GatePhase phase = gate_.phase();
  const bool guard_latched = guards_.latched() && phase == control::GatePhase::kZero;
  state_.gate = wire_state(guard_latched ? control::GatePhase::kLatched : phase);  // both wait for a reset of the gate
  t.gate_trips = gate_.trips();
  state_.engaged = engaged;
  state_.ready = homed && phase != control::GatePhase::kLatched && phase != control::GatePhase::kFault &&
                 !guards_.inhibit() && !close_out_.leaving() && !requests_.locally_stopped() &&
                 link().timing().rtt_samples() >= kLearnSamples;
  requests_.fill(state_);
  // The client receives a stop late, so its clock is ahead of the server's halted one. seat_tick then holds its value:
  // it never decreases.
  state_.seat_tick = std::max(
      state_.seat_tick, static_cast<std::uint32_t>(std::max(0.0, clock_.server_time(now).value_or(0)) / dt_ + 0.5));
}

std::optional<std::size_t> Seat::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  if (buffer.size() < transport::kHeaderSize) return std::nullopt;
  const auto seal = [&](wire::Type type, const auto& message) {
    return channel_.seal(now, tick_, type, message, buffer);
  };
  if (channel_.answer_due()) return channel_.seal_answer(now, tick_, buffer);
  if (state_due_ && !closed()) {
    state_due_ = false;
    const std::span<const PortSample> further = tools_.further_samples();
    return further.empty() ? seal(wire::Type::kState, state_)
                           : seal(wire::Type::kState, wire::StateWithTools{state_, further});
  }
  if (const auto authority = requests_.take_authority(now)) return seal(wire::Type::kAuthority, *authority);
  if (close_out_.take_close()) return seal(wire::Type::kClose, wire::CloseMessage{wire::CloseReason::kLeaving});
  return std::nullopt;
}

}  // namespace tandem::client
