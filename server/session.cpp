#include "server/session.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "server/connection_id.h"
#include "server/session_record.h"

namespace tandem::server {

namespace {
constexpr std::uint32_t kCatchUpMax = 50;      // ticks lived through after a stall; more are given up
constexpr double kFarewell = 0.15;             // [s] gates ramp out before CLOSE
constexpr Duration kSilentOwner = std::chrono::seconds(2);  // then his seat is free
constexpr std::uint32_t kCloseRepeats = 20;    // CLOSE goes out this many ticks long: one may be lost
}  // namespace

Session::Session(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves, const AxisArray& scale)
    : scene_(&scene),
      dt_(1.0 / scene.tick_hz),
      tick_length_(from_seconds(dt_)),
      scale_(scale),
      masters_(scene.masters()),
      reception_(scene, scale),
      visitors_(scene.dof, scene.port) {
  seats_.reserve(scene.seats.size());
  for (std::size_t i = 0; i < scene.seats.size(); ++i) seats_.emplace_back(scene, i, scale);
  tools_.reserve(scene.tools.size());
  for (std::size_t j = 0; j < scene.tools.size(); ++j) tools_.emplace_back(scene, j, std::move(slaves[j]));
  for (const AuthorityRow& row : scene.authority) request_authority(row);
}

void Session::on_datagram(Time now, const Endpoint& from, std::span<const std::byte> bytes) noexcept {
  const auto header = link::read_header(bytes);
  if (!header) {
    ++stray_;
    return;
  }
  const std::size_t i = static_cast<std::size_t>(place_of(header->cid)) - 1;
  if (i >= seats_.size() || !seats_[i].taken() || seats_[i].link()->own_cid() != header->cid) {
    if (!visitors_.on_datagram(now, from, header->cid, bytes)) ++stray_;
    return;
  }
  const auto heard = seats_[i].on_datagram(now, from, bytes);
  if (heard.close) seats_[i].release();
  if (!heard.authority) return;
  const wire::AuthorityMessage& m = *heard.authority;
  if (scene_->seats[i].role != Role::kInstructor || m.version != authority_version_ || m.tool >= tools_.size() ||
      m.masters != masters_)
    return;
  for (std::size_t k = 0; k < masters_; ++k)  // the server, not the client, says who may never drive
    if (m.alpha[k] > 0 && (scene_->seats[k].role == Role::kEvaluator || scene_->seats[k].role == Role::kObserver)) return;
  if (tools_[m.tool].authority.request(m.alpha)) ++authority_version_;
}

JoinResult Session::may_admit(Time now, std::size_t i, bool same_owner) const noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  if (i >= seats_.size()) return JoinResult::kNoSuchSeat;
  if (seats_[i].taken() && !same_owner && seats_[i].silence(now) <= kSilentOwner) return JoinResult::kSeatTaken;
  return JoinResult::kAccepted;
}

JoinResult Session::admit(Time now, std::size_t i, Entry& entry, bool same_owner) noexcept {
  const JoinResult may = may_admit(now, i, same_owner);
  if (may == JoinResult::kAccepted) seats_[i].take(now, entry);
  return may;
}

JoinResult Session::admit_visitor(Time now, std::unique_ptr<link::Link>& link) noexcept {
  if (over_ || state_ == wire::SessionState::kEnding) return JoinResult::kSessionOver;
  return visitors_.admit(now, link) ? JoinResult::kAccepted : JoinResult::kSeatTaken;
}

void Session::request_authority(const AuthorityRow& row) noexcept {
  control::Weights w{};
  for (std::size_t i = 0; i < masters_; ++i) w[i] = row.alpha[i];
  if (tools_[row.tool].authority.request(w)) ++authority_version_;
}

void Session::on_tick(Time now, std::uint32_t missed) noexcept {
  if (over_) return;
  if (!ticked_) {
    ticked_ = true;
    started_ = now;
  }
  tick_ = static_cast<std::uint32_t>(std::llround(seconds(now - started_) / dt_));
  const std::uint32_t live = std::min(missed, kCatchUpMax);
  slipped_ += missed - live;
  for (std::uint32_t i = 0; i <= live && !over_; ++i) live_one_tick(now);
  fill_force_messages(now);
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (auto* l = seats_[i].link()) l->tick(now);
    send_due_[i] = seats_[i].reachable();
  }
  visitors_.on_tick(now);
}

void Session::live_one_tick(Time now) noexcept {
  for (auto& tool : tools_) tool.advance_slave(elapsed_any_ ? tick_length_ : Duration{0});
  elapsed_any_ = true;
  change_state(now);
  if (over_) return;
  follow_timeline();
  share_authority();
  move_references(now);
  step_tools();
  step_following();
  take_record(*this, record_);
}

void Session::change_state(Time now) noexcept {
  const auto all_required = [&](auto&& is) {
    for (std::size_t i = 0; i < seats_.size(); ++i)
      if (scene_->seats[i].required && !is(seats_[i])) return false;
    return true;
  };
  for (std::size_t i = 0; i < seats_.size(); ++i) present_[i] = seats_[i].present(now);

  switch (state_) {
    case wire::SessionState::kWaiting:
      engage_ = all_required([&](const SeatPort& s) { return s.ready(now); });
      if (engage_ && all_required([&](const SeatPort& s) { return s.present(now); })) {
        state_ = wire::SessionState::kRunning;
        session_tick_ = 0;
        for (auto& s : seats_)
          if (auto* l = s.link()) l->restart_statistics(now);
      }
      break;
    case wire::SessionState::kRunning:
    case wire::SessionState::kHeld: {
      ++session_tick_;
      const bool all_held = std::ranges::all_of(tools_, [](const Tool& t) { return t.authority.held(); });
      state_ = all_held ? wire::SessionState::kHeld : wire::SessionState::kRunning;
      if (time() >= scene_->duration) stop(wire::CloseReason::kDone);
      break;
    }
    case wire::SessionState::kEnding:
      ++session_tick_;
      if (farewell_ > 0) {
        --farewell_;
      } else {
        over_ = true;
      }
      break;
  }
}

void Session::stop(wire::CloseReason why) noexcept {
  if (state_ == wire::SessionState::kEnding) return;
  state_ = wire::SessionState::kEnding;
  close_reason_ = why;
  farewell_ = static_cast<std::uint32_t>(std::lround(kFarewell / dt_)) + kCloseRepeats;
}

void Session::follow_timeline() noexcept {
  if (state_ != wire::SessionState::kRunning && state_ != wire::SessionState::kHeld) return;
  while (next_event_ < scene_->timeline.size() && scene_->timeline[next_event_].at <= time() + 0.5 * dt_)
    request_authority(scene_->timeline[next_event_++].row);
}

bool Session::slave_present(std::size_t j) const noexcept {
  return !scene_->tools[j].remote || present_[scene_->tools[j].seat];
}

void Session::share_authority() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    control::AuthorityRow::Input in;
    in.dt = dt_;
    for (std::size_t i = 0; i < masters_; ++i) {
      in.present[i] = present_[i] && slave_present(j) && state_ != wire::SessionState::kEnding;
      const control::EndState& end = seats_[i].end().state();
      for (std::size_t a = 0; a < scene_->dof; ++a) {
        const double e = end.ref[a] - tool.x(a);
        in.stored[i] += 0.5 * end.k[a] * e * e;
      }
    }
    for (std::size_t a = 0; a < scene_->dof; ++a) in.dissipated += (1 - scene_->channel.eta) * tool.dissipated()[a];
    tool.authority.step(in);
  }
}

double Session::share(std::size_t j, std::size_t i) const noexcept {
  return std::max(tools_[j].authority.alpha(i), scene_->follow[i][j]);
}

void Session::move_references(Time now) noexcept {
  const bool tank = scene_->channel.mfs == MfsMode::kTank;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    SeatPort::Near near;
    bool held = false;
    if (scene_->seats[i].kind == SeatKind::kSlave) {
      Tool& tool = tools_[scene_->seats[i].tool];
      if (!present_[i] && seats_[i].alive(now)) tool.rest_at(seats_[i].heard().port.x);
      near.x = tool.position();
      near.weight = 1;
    } else {
      for (std::size_t j = 0; j < tools_.size(); ++j) {
        const double w = share(j, i);
        near.weight += w;
        held |= w > 0 && tools_[j].authority.held();
        // Each seat may count all of a tool's heat: it delivers alpha_i of what it spends, and the alphas sum to 1. With a tank
        // for the flow sources the heat is split and only alpha_i of it travels, so that nothing is spent twice.
        if (tank && scene_->follow[i][j] > 0) near.pass_on = tools_[j].authority.alpha(i);
        for (std::size_t a = 0; a < scene_->dof; ++a) {
          near.x[a] += w * tools_[j].x(a);
          near.dissipated[a] += (tank ? 0.5 : 1.0) * scene_->follow[i][j] * tools_[j].dissipated()[a];
        }
      }
      for (std::size_t a = 0; a < scene_->dof; ++a) near.x[a] /= near.weight > 0 ? near.weight : 1;
    }
    reference_before_[i] = seats_[i].end().state().ref;
    const bool engaged = present_[i] && !held;
    step_offset(i, engaged);
    near.offset = offset_[i];
    seats_[i].move(now, dt_, engaged, near);
    for (std::size_t a = 0; a < scene_->dof; ++a) credit_seat(i, a);
  }
}

/// Hand and tool need not be at one place when a seat engages, or engages again after an outage: both springs begin without
/// elongation about this offset, which then goes home at the approach speed.
void Session::step_offset(std::size_t i, bool engaged) noexcept {
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    double& o = offset_[i][a];
    offset_step_[i][a] = 0;
    if (!engaged) {
      o = seats_[i].alive_once() ? seats_[i].heard().port.x[a] - absolute_[i][a] : 0;
      continue;
    }
    const double step = scene_->channel.v_app / std::sqrt(scale_[a]) * dt_;
    offset_step_[i][a] = -std::clamp(o, -step, step);
    o += offset_step_[i][a];
  }
}

/// What the tool really paid becomes credit; what its authority does not pay for is asked from the flow sources (design notes, control 4).
void Session::credit_seat(std::size_t i, std::size_t a) noexcept {
  control::ChannelEnd& end = seats_[i].end();
  const control::EndState& s = end.state();
  if (scene_->seats[i].kind == SeatKind::kSlave) return end.credit(a, s.absorbed[a]);
  double left = s.absorbed[a], paid = s.paid[a];
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const double before = reference_before_[i][a] - tools_[j].x(a), after = s.ref[a] - tools_[j].x(a);
    const double alpha = tools_[j].authority.alpha(i);
    const double given = 0.5 * s.k[a] * alpha * (before * before - after * after);
    const double real = std::clamp(given, 0.0, left);
    end.credit(a, real);
    left -= real;
    const double wanted = std::min(left, 0.5 * s.k[a] * (share(j, i) - alpha) * std::max(0.0, before * before - after * after));
    end.credit(a, tools_[j].sources.grant(wanted));
    left -= wanted;
    tools_[j].sources.fill((1 - alpha) * paid * (share(j, i) > 0 ? 1 : 0));
    paid = 0;
  }
  // The offset's way home moves the follower like a tool that moves: the share nobody has authority for is the sources'.
  const std::size_t first = first_tool(i);
  const double work = -s.k[a] * (s.ref[a] - tools_[first].x(a)) * offset_step_[i][a];
  const double unpaid = 1 - tools_[first].authority.alpha(i);
  end.credit(a, tools_[first].sources.grant(std::max(0.0, unpaid * work)));
  if (scene_->channel.mfs != MfsMode::kTank) static_cast<void>(tools_[first].sources.grant(unpaid * s.passed[a]));  // already credited: booked
  end.credit(a, tools_.size() == 1 ? tools_[0].sources.grant(left) : 0);  // a falling stiffness gives back as well
}

std::size_t Session::first_tool(std::size_t i) const noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j)
    if (scene_->follow[i][j] > 0) return j;
  return 0;
}

void Session::step_tools() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    std::array<control::ToolIpc::Pull, kAxesMax> pull{};
    AxisArray damping{};  // the schedule's, shared like the springs: P+d wants it at both ends
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      for (std::size_t i = 0; i < masters_; ++i) {
        const double alpha = tool.authority.alpha(i);
        const control::EndState& end = seats_[i].end().state();
        if (alpha > 0) pull[a].add(alpha * end.k[a], end.ref[a]);
        damping[a] += alpha * end.b[a];
      }
      if (scene_->tools[j].remote) {
        const control::EndState& end = seats_[scene_->tools[j].seat].end().state();
        if (slave_present(j)) {
          pull[a].add(end.k[a], end.ref[a]);
          damping[a] += end.b[a];
        }
      }
    }
    tool.step(dt_, pull, damping, tool.authority.held());
    if (tool.sources.mode() == control::FlowSourceMode::kTank)
      for (std::size_t a = 0; a < scene_->dof; ++a) tool.sources.fill(0.5 * scene_->channel.eta * tool.dissipated()[a]);
  }
}

void Session::step_following() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j)
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      double injected = 0;  // F_ri is the effort on the IPC, the client sends its opposite
      for (std::size_t i = 0; i < masters_; ++i)
        if (present_[i])
          injected -= (scene_->follow[i][j] - tools_[j].authority.alpha(i)) * seats_[i].heard().port.f[a] * tools_[j].moved()[a];
      tools_[j].sources.observe(a, injected / dt_, dt_);
    }
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    const bool slave = scene_->seats[i].kind == SeatKind::kSlave;
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      double absolute = 0, moved = 0, velocity = 0;
      bool gated = false;
      for (std::size_t j = 0; j < tools_.size(); ++j) {
        const double c = slave ? (scene_->seats[i].tool == j ? 1.0 : 0.0) : scene_->follow[i][j];
        const double g = slave ? 1.0 : tools_[j].sources.gate(a);
        const double part = control::following_share(slave ? 1.0 : tools_[j].authority.alpha(i), c, g);
        absolute += c * tools_[j].x(a);
        moved += part * tools_[j].moved()[a];
        velocity += part * tools_[j].velocity()[a];
        gated |= !slave && tools_[j].sources.gates_velocity();
      }
      // Velocity gates act on a position target as increments; ungated, the target is absolute and cannot drift.
      absolute_[i][a] = gated && present_[i] ? absolute_[i][a] + moved : absolute;
      following_[i][a] = absolute_[i][a] + offset_[i][a];
      following_v_[i][a] = gated || slave ? velocity : 0;
      if (!gated && !slave)
        for (std::size_t j = 0; j < tools_.size(); ++j) following_v_[i][a] += scene_->follow[i][j] * tools_[j].velocity()[a];
      following_v_[i][a] += offset_step_[i][a] / dt_;
      if (!present_[i]) following_v_[i][a] = seats_[i].heard().port.v[a];  // its own motion: nothing pulls before it is engaged
    }
  }
}

void Session::fill_force_messages(Time now) noexcept {
  std::array<bool, kToolsMax> entitled{};
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const bool slave_ready = !scene_->tools[j].remote || seats_[scene_->tools[j].seat].ready(now);
    for (std::size_t i = 0; i < masters_; ++i)
      entitled[j] |= slave_ready && tools_[j].authority.requested()[i] > 0 && seats_[i].ready(now);
  }
  std::uint32_t missing_now = 0;
  for (std::size_t i = 0; i < seats_.size(); ++i) missing_now += scene_->seats[i].required && !seats_[i].ready(now) ? 1 : 0;

  for (std::size_t i = 0; i < seats_.size(); ++i) {
    wire::ForceMessage& m = seats_[i].tx;
    const control::EndState& end = seats_[i].end().state();
    m.port.x = following_[i];
    m.port.v = following_v_[i];
    for (std::size_t a = 0; a < scene_->dof; ++a) m.port.f[a] = end.k[a] * (end.ref[a] - following_[i][a]);
    m.port.e_in = seats_[i].end().e_in();
    m.session = state_;
    bool wanted = engage_ && state_ != wire::SessionState::kEnding;
    m.alpha = 0;
    for (std::size_t j = 0; j < tools_.size(); ++j) {
      const bool slave = scene_->seats[i].kind == SeatKind::kSlave;
      const bool serves = slave ? scene_->seats[i].tool == j : share(j, i) > 0;
      wanted = wanted && (!serves || entitled[j]);
      if (!slave && scene_->follow[i][j] > 0 && m.alpha == 0) m.alpha = tools_[j].authority.alpha(i);
    }
    m.engage = wanted;
    m.session_tick = session_tick_;
    m.authority_version = authority_version_;
    m.missing = missing_now;
  }
}

std::optional<Transmit> Session::poll_transmit(Time now, std::span<std::byte> buffer) noexcept {
  const bool closing = over_ || (state_ == wire::SessionState::kEnding && farewell_ < kCloseRepeats);
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (const auto challenge = seats_[i].transmit_challenge(now, tick_, buffer)) return challenge;
    if (!send_due_[i]) continue;
    send_due_[i] = false;
    const Transmit out =
        closing ? seats_[i].transmit_close(now, tick_, close_reason_, buffer) : seats_[i].transmit(now, tick_, buffer);
    if (out.size > 0) return out;
  }
  return visitors_.poll_transmit(now, tick_, closing ? std::optional{close_reason_} : std::nullopt, buffer);
}

std::vector<std::size_t> Session::missing(Time now) const {
  std::vector<std::size_t> out;
  for (std::size_t i = 0; i < seats_.size(); ++i)
    if (scene_->seats[i].required && !seats_[i].ready(now)) out.push_back(i);
  return out;
}

}  // namespace tandem::server
