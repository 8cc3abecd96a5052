#include <algorithm>
#include <cmath>
#include <utility>

#include "server/session.h"

/// What a tick does to springs and tools (design notes, control 4), in the order of the functions.
namespace tandem::server {

namespace {
constexpr double kUpToSpeed = 0.3;  // [s] from rest to the approach speed
constexpr double kAgeRoom = 0.015;  // [s] of the tool's motion beyond what a follower's newest sample shows
constexpr double kNobody = 1e-9;    // authority of others below which the tool itself is what is followed
constexpr double kShares = 1e-3;    // authority from which on a hand's motion comes back to it by way of the others
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
      in.present[i] = present_[i] && slave_present(j) && state_ != wire::SessionState::kEnding && !lets_go();
      const control::EndState& end = seats_[i].end(j).state();
      for (std::size_t a = 0; a < scene_->dof; ++a) {
        const double e = end.ref[a] - tool.x(a);
        in.stored[i] += 0.5 * end.k[a] * e * e;
      }
    }
    for (std::size_t a = 0; a < scene_->dof; ++a) in.dissipated += (1 - scene_->channel.eta) * tool.dissipated()[a];
    tool.authority.step(in);
  }
}

void Session::tie_seats() noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i)
    for (std::size_t j = 0; j < tools_.size(); ++j) {
      const bool own = scene_->seats[i].kind == SeatKind::kSlave && scene_->seats[i].tool == j;
      Tie& tie = ties_[i][j];
      tie.alpha = i < masters_ ? tools_[j].authority.alpha(i) : own ? 1 : 0;
      tie.follow = i < masters_ ? scene_->follow[i][j] : tie.alpha;
      tie.share = std::max(tie.alpha, tie.follow);
    }
}

void Session::move_references(Time now) noexcept {
  const bool tank = scene_->channel.mfs == MfsMode::kTank;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (told_of_others(i)) {
      move_predictions(now, i);
      continue;
    }
    SeatPort::Near near;
    bool held = false, leaving = false;
    if (scene_->seats[i].kind == SeatKind::kSlave) {
      Tool& tool = tools_[scene_->seats[i].tool];
      if (!present_[i] && seats_[i].alive(now)) tool.rest_at(seats_[i].heard().port.x);
      for (std::size_t a = 0; a < scene_->dof; ++a) near.x[a] = tool.slave_goal(a, seats_[i].end().state().k[a]);
      near.weight = 1;
    } else {
      for (std::size_t j = 0; j < tools_.size(); ++j) {
        const Tie& tie = ties_[i][j];
        const double w = tie.share;
        near.weight += w;
        held |= w > 0 && tools_[j].authority.held();
        leaving |= tie.alpha > 0;
        // Each seat may count all of a tool's heat: it delivers alpha_i of what it spends, and the alphas sum to 1. With a tank
        // for the flow sources the heat is split and only alpha_i of it travels, so that nothing is spent twice.
        if (tank && tie.follow > 0) near.pass_on = tie.alpha;
        for (std::size_t a = 0; a < scene_->dof; ++a) {
          near.x[a] += w * tools_[j].x(a);
          near.dissipated[a] += (tank ? 0.5 : 1.0) * tie.follow * tools_[j].dissipated()[a];
        }
      }
      for (std::size_t a = 0; a < scene_->dof; ++a) near.x[a] /= near.weight > 0 ? near.weight : 1;
    }
    reference_before_[i] = seats_[i].end().state().ref;
    near.engaged = present_[i] && !held;
    step_offset(i, near.engaged);
    near.offset = offset_[i];
    if (leaving && !present_[i] && !held) {  // no energy is paid or credited while it waits for its weight to go
      seats_[i].hold(std::span{&near, 1});
      continue;
    }
    seats_[i].move(now, dt_, std::span{&near, 1});
    credit_seat(i);
  }
}

/// The hand as each of its tools is pulled by it.
void Session::move_predictions(Time now, std::size_t i) noexcept {
  bool held = false, leaving = false;
  for (std::size_t j = 0; j < seats_[i].ends(); ++j) {
    const Tie& tie = ties_[i][j];
    const bool tool_held = tools_[j].authority.held();
    near_[j].engaged = present_[i] && tie.share > 0 && !tool_held;
    held |= tie.share > 0 && tool_held;
    leaving |= tie.alpha > 0;
    for (std::size_t a = 0; a < scene_->dof; ++a) near_[j].x[a] = tools_[j].x(a);
  }
  const std::span<const SeatPort::Near> all{near_.data(), seats_[i].ends()};
  if (leaving && !present_[i] && !held) return seats_[i].hold(all);
  seats_[i].move(now, dt_, all);
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
    const double step = pace * scene_->channel.v_app / root_scale_[a] * dt_;
    offset_step_[i][a] = -std::clamp(o, -step, step);
    o += offset_step_[i][a];
  }
}

/// What the tool really paid becomes credit; what its authority does not pay for is asked from the flow sources (design notes, control 4).
void Session::credit_seat(std::size_t i) noexcept {
  control::ChannelEnd& end = seats_[i].end();
  const control::EndState& s = end.state();
  const std::size_t dof = scene_->dof, tools = tools_.size();
  if (scene_->seats[i].kind == SeatKind::kSlave) {
    for (std::size_t a = 0; a < dof; ++a) end.credit(a, s.absorbed[a]);
    return;
  }
  Tool& first = tools_[first_tool(i)];
  control::FlowSources& sources = first.sources;
  const double unpaid = 1 - first.authority.alpha(i);
  const bool passes_on = scene_->channel.mfs != MfsMode::kTank;
  for (std::size_t a = 0; a < dof; ++a) {
    double left = s.absorbed[a], paid = s.paid[a];
    for (std::size_t j = 0; j < tools; ++j) {
      const Tie& tie = ties_[i][j];
      const double before = reference_before_[i][a] - tools_[j].x(a), after = s.ref[a] - tools_[j].x(a);
      const double given = 0.5 * s.k[a] * tie.alpha * (before * before - after * after);
      const double real = std::clamp(given, 0.0, left);
      end.credit(a, real);
      left -= real;
      const double wanted = std::min(left, 0.5 * s.k[a] * (tie.share - tie.alpha) * std::max(0.0, before * before - after * after));
      end.credit(a, tools_[j].sources.grant(wanted));
      left -= wanted;
      tools_[j].sources.fill((1 - tie.alpha) * paid * (tie.share > 0 ? 1 : 0));
      paid = 0;
    }
    // The offset's way home moves the follower like a tool that moves: the share nobody has authority for is the sources'.
    const double work = -s.k[a] * (s.ref[a] - first.x(a)) * offset_step_[i][a];
    end.credit(a, sources.grant(std::max(0.0, unpaid * work)));
    if (passes_on) static_cast<void>(sources.grant(unpaid * s.passed[a]));  // already credited: booked
    end.credit(a, tools == 1 ? sources.grant(left) : 0);  // a falling stiffness gives back as well
  }
}

std::size_t Session::first_tool(std::size_t i) const noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j)
    if (scene_->follow[i][j] > 0) return j;
  return 0;
}

void Session::step_tools() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    std::array<control::Pull, kAxesMax> pull{};
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      for (std::size_t i = 0; i < masters_; ++i) {
        const double alpha = tool.authority.alpha(i);
        const control::EndState& end = seats_[i].end(j).state();
        if (alpha > 0) pull[a].spring(alpha * end.k[a], end.ref[a]);
        // The schedule's damping, shared like the springs: P+d wants it at both ends. Or a hand's own, relative to its motion.
        const double part = tool.body() != nullptr && replica_ ? tool.body()->relative_damping_share(a, scene_->channel.b_rel, 0, end.k[a], 0) : 1;
        pull[a].damper(part * alpha * end.b[a], end.rate[a]);
      }
      if (scene_->tools[j].remote) {
        const control::EndState& end = seats_[scene_->tools[j].seat].end().state();
        const double share = tool.slave_share();
        if (slave_present(j) && share > 0) {
          pull[a].spring(share * end.k[a], end.ref[a]);
          pull[a].damper(share * end.b[a], end.rate[a]);
        }
      }
    }
    if (tool.has_contact_source()) look_for_contacts(j);
    tool.step(dt_, pull, tool.authority.held());
    if (tool.sources.mode() == control::FlowSourceMode::kTank)
      for (std::size_t a = 0; a < scene_->dof; ++a) tool.sources.fill(0.5 * scene_->channel.eta * tool.dissipated()[a]);
  }
}

void Session::look_for_contacts(std::size_t j) noexcept {
  ToolView view;
  view.dt = dt_;
  view.time = time();
  if (scene_->tools[j].remote) {
    const SeatPort& seat = seats_[scene_->tools[j].seat];
    view.slave = slave_present(j) && elapsed_any_;
    view.fresh = std::exchange(slave_heard_[j], seat.generation()) != seat.generation();
    view.slave_x = seat.heard().port.x;
    view.slave_v = seat.heard().port.v;
    for (std::size_t a = 0; a < scene_->dof; ++a) view.slave_f[a] = seat.heard().port.f[a] + seat.end().state().b[a] * view.slave_v[a];
  }
  tools_[j].look_for_contacts(view);
}

/// The loop of this spring is closed over both networks, so it is as soft as P+d asks for both delays [Nuno et al., IJRR 28(7) 2009].
double Session::slave_pull(std::size_t i, std::size_t j) const noexcept {
  const double share = tools_[j].slave_share();
  if (!scene_->tools[j].remote || !slave_present(j) || share <= 0) return 0;
  const control::ChannelEnd& slave = seats_[scene_->tools[j].seat].end();
  const double delay = seats_[i].end(j).schedule().delay() + slave.schedule().delay();
  const double most = delay > 0 ? scene_->channel.k_delay / delay : slave.schedule().stiffness();
  const double k_c = seats_[i].end().state().k[0];  // the seat's own, which its device may have made softer than the scene's
  return share * std::min(1.0, std::min(slave.schedule().stiffness(), most) / k_c);
}

void Session::step_following() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    AxisArray injected{};  // F_ri is the effort on the IPC, the client sends its opposite
    for (std::size_t i = 0; i < masters_; ++i) {
      if (!present_[i]) continue;
      const double unpaid = ties_[i][j].follow - ties_[i][j].alpha;
      const AxisArray& f = seats_[i].heard_of(j).f;
      for (std::size_t a = 0; a < scene_->dof; ++a) injected[a] -= unpaid * f[a] * tools_[j].moved()[a];
    }
    for (std::size_t a = 0; a < scene_->dof; ++a) tools_[j].sources.observe(a, injected[a] / dt_, dt_);
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (told_of_others(i)) {
      grant_following(i);
      follow_others(i);
    } else {
      follow_tools(i);
    }
  }
}

/// What the others' motion gives a hand beyond its own authority is the flow sources': at most the strongest force along the tool's path.
/// How far the hand is behind is known here by its newest sample and there by the age of news, which two clocks that part (200 ppm, and 10 s
/// until the client learns anew) and a hand's filters make longer: without room for it a follower's account ran dry at 1000 ppm within 5 s.
void Session::grant_following(std::size_t i) noexcept {
  if (!present_[i]) return;
  const double strongest = scene_->gate.force_max * share_of_force(scene_->seats[i].role);
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const Tie& tie = ties_[i][j];
    if (!(tie.follow > 0)) continue;
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      const double room = tools_[j].sources.mode() == control::FlowSourceMode::kOpen ? kAgeRoom * tools_[j].moved()[a] / dt_ : 0;
      control::ChannelEnd& end = seats_[i].end(j);
      const double pull = std::clamp(end.state().k[a] * (tools_[j].x(a) + room - seats_[i].heard_of(j).x[a]), -strongest, strongest);
      // The hand has that share of what its copy of this tool gives and takes; the account is the copy's.
      end.credit(a, tools_[j].sources.grant(tie.follow * (1 - tie.alpha) * pull * tools_[j].moved()[a]) / tie.follow);
    }
  }
}

/// Mix-minus, as in a telephone conference: where the others pull at the tool, and never this hand's own echo. A hand that shares hears of them
/// as they were; one that only follows, as they are by now.
void Session::follow_others(std::size_t i, std::size_t j, wire::TieForce& told) const noexcept {
  const Tie& tie = ties_[i][j];
  double others = 0;
  const double alone = 1 - tie.alpha, slave = slave_pull(i, j);
  const control::EndState* const device = slave > 0 ? &seats_[scene_->tools[j].seat].end().state() : nullptr;
  told.slave_pull = slave;
  for (std::size_t h = 0; h < masters_; ++h) others += h == i ? 0 : tools_[j].authority.alpha(h);
  AxisArray& places = told.port.x;
  AxisArray& speeds = told.port.v;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    told.port.f[a] = tools_[j].x(a);
    places[a] = others > kNobody ? 0 : told.port.f[a];
    speeds[a] = others > kNobody ? 0 : tools_[j].v(a);
  }
  for (std::size_t h = 0; others > kNobody && h < masters_; ++h) {
    const double part = h == i ? 0 : tools_[j].authority.alpha(h) / others;
    if (part == 0) continue;
    const control::EndState& by_now = seats_[h].end(j).state();
    const PortSample& hand = seats_[h].heard_of(j);
    const bool shares = tie.alpha >= kShares && present_[h];
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      const double steady = scene_->seats[i].assist.force > 0 ? leading_[h].steady_share() : 0, rate = present_[h] ? by_now.led[a] : 0;
      places[a] += part * (shares ? hand.x[a] : by_now.ref[a] + steady * (leading_[h].steady_x(a) - by_now.ref[a]));
      speeds[a] += part * (shares ? hand.v[a] : rate + steady * (leading_[h].steady_v(a) - rate));
    }
  }
  if (device == nullptr) return;
  for (std::size_t a = 0; a < scene_->dof; ++a) {  // two springs of stiffness alone and slave, as one between them
    places[a] = (alone * places[a] + slave * device->ref[a]) / (alone + slave);
    speeds[a] = (alone * speeds[a] + slave * seats_[scene_->tools[j].seat].heard().port.v[a]) / (alone + slave);
  }
}

void Session::follow_others(std::size_t i) noexcept {
  const std::span<const std::size_t> tools = seats_[i].tied_tools();
  for (std::size_t k = 0; k < tools.size(); ++k) follow_others(i, tools[k], seats_[i].told(k));
}

/// What else each tie is told. Where the surfaces near all tools do not fit into a datagram, the tools take turns: each is named
/// again long before its surfaces are forgotten.
void Session::tell_ties(std::size_t i) noexcept {
  seats_[i].tx.ghost = ghost_[i];
  const std::span<const std::size_t> tools = seats_[i].tied_tools();
  std::size_t room = wire::contacts_room(scene_->dof, tools.size() - 1);
  const std::size_t first = tick_ % tools.size();
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const std::size_t k = (first + n) % tools.size(), j = tools[k];
    wire::TieForce& told = seats_[i].told(k);
    for (std::size_t a = 0; a < scene_->dof; ++a) told.port.e_in[a] = seats_[i].end(j).ledger(a).in_nj();
    told.alpha = ties_[i][j].alpha;
    told.contacts.size = 0;
    const LocalContactList& surfaces = tools_[j].contacts();
    if (surfaces.size == 0 || surfaces.size > room) continue;
    told.contacts = surfaces;
    room -= surfaces.size;
  }
}

/// To a seat of a law without copies, of its tools as one.
void Session::tell_tools(std::size_t i) noexcept {
  wire::TieForce& told = seats_[i].tx;
  const control::ChannelEnd& end = seats_[i].end();
  for (std::size_t a = 0; a < scene_->dof; ++a) told.port.e_in[a] = end.ledger(a).in_nj();
  told.alpha = 0;
  for (std::size_t j = 0; i < masters_ && j < tools_.size() && told.alpha == 0; ++j)
    if (ties_[i][j].follow > 0) told.alpha = ties_[i][j].alpha;
}

/// Where the seat's target goes. Velocity gates act on it as increments; ungated, it is absolute and cannot drift.
void Session::follow_tools(std::size_t i) noexcept {
  bool gated = false;
  for (const Tool& tool : tools_) gated |= i < masters_ && tool.sources.gates_velocity();
  const std::size_t dof = scene_->dof, tools = tools_.size();
  AxisArray absolute{}, velocities{};
  for (std::size_t j = 0; j < tools; ++j) {
    const double follow = ties_[i][j].follow;
    for (std::size_t a = 0; a < dof; ++a) {
      absolute[a] += follow * (i < masters_ ? tools_[j].x(a) : tools_[j].slave_goal(a, seats_[i].end().state().k[a]));
      velocities[a] += follow * tools_[j].v(a);
    }
  }
  if (gated) {
    velocities = {};
    AxisArray moved{};
    for (std::size_t j = 0; j < tools; ++j)
      for (std::size_t a = 0; a < dof; ++a) {
        const double part = control::following_share(ties_[i][j].alpha, ties_[i][j].follow, tools_[j].sources.gate(a));
        moved[a] += part * tools_[j].moved()[a];
        velocities[a] += part * tools_[j].v(a);
      }
    if (present_[i])
      for (std::size_t a = 0; a < dof; ++a) absolute[a] = absolute_[i][a] + moved[a];
  }
  const control::EndState& end = seats_[i].end().state();
  PortSample& told = seats_[i].tx.port;
  for (std::size_t a = 0; a < dof; ++a) {
    absolute_[i][a] = absolute[a];
    told.x[a] = absolute[a] + offset_[i][a];
    // Until it is engaged its own motion: nothing pulls before.
    told.v[a] = present_[i] ? velocities[a] + offset_step_[i][a] / dt_ : seats_[i].heard().port.v[a];
    told.f[a] = end.k[a] * (end.ref[a] - told.x[a]);
  }
}

}  // namespace tandem::server
