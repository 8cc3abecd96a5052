#include <algorithm>
#include <cmath>

#include "server/session.h"

/// What a tick does to springs and tools (design notes, control 4), in the order of the functions.
namespace tandem::server {

namespace {
constexpr double kUpToSpeed = 0.3;  // [s] from rest to the approach speed
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
      in.present[i] = present_[i] && slave_present(j) && state_ != wire::SessionState::kEnding && !stop_lane_.on();
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
    bool held = false, leaving = false;
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
        leaving |= tools_[j].authority.alpha(i) > 0;
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
    if (leaving && !present_[i] && !held) {  // no energy moves while it waits for its weight to go
      seats_[i].hold();
      continue;
    }
    seats_[i].move(now, dt_, engaged, near);
    for (std::size_t a = 0; a < scene_->dof; ++a) credit_seat(i, a);
  }
}

/// Hand and tool need not be at one place when a seat engages, or engages again after an outage: both springs begin without
/// elongation about this offset, which stays until the gate has ramped in: a hand that holds still is pulled nowhere by a spring that
/// only grows. Then it goes home, getting up to the approach speed by and by: at once at that speed the force would begin with 40 N/s.
void Session::step_offset(std::size_t i, bool engaged) noexcept {
  engaged_for_[i] = engaged ? engaged_for_[i] + 1 : 0;
  const double pace = std::clamp((engaged_for_[i] * dt_ - scene_->gate.ramp_in) / kUpToSpeed, 0.0, 1.0);
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    double& o = offset_[i][a];
    offset_step_[i][a] = 0;
    if (!engaged) {
      o = seats_[i].alive_once() ? seats_[i].heard().port.x[a] - absolute_[i][a] : 0;
      continue;
    }
    const double step = pace * scene_->channel.v_app / std::sqrt(scale_[a]) * dt_;
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
        velocity += part * tools_[j].v(a);
        gated |= !slave && tools_[j].sources.gates_velocity();
      }
      // Velocity gates act on a position target as increments; ungated, the target is absolute and cannot drift.
      absolute_[i][a] = gated && present_[i] ? absolute_[i][a] + moved : absolute;
      following_[i][a] = absolute_[i][a] + offset_[i][a];
      following_v_[i][a] = gated || slave ? velocity : 0;
      if (!gated && !slave)
        for (std::size_t j = 0; j < tools_.size(); ++j) following_v_[i][a] += scene_->follow[i][j] * tools_[j].v(a);
      following_v_[i][a] += offset_step_[i][a] / dt_;
      if (!present_[i]) following_v_[i][a] = seats_[i].heard().port.v[a];  // its own motion: nothing pulls before it is engaged
    }
  }
}

}  // namespace tandem::server
