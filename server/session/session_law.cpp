#include <algorithm>
#include <cmath>
#include <utility>

#include "server/session/session.h"

/// The control law of one tick: authority, springs, tools, targets (design notes, control 4). The functions are in
/// calling order.
namespace tandem::server {

namespace {
constexpr double kReengageRampTime = 0.3;  // [s] from rest to the approach speed
// [s] of tool motion added to a follower's newest sample, see grant_follower_energy.
constexpr double kAgeMargin = 0.015;
constexpr double kNoAuthority = 1e-9;  // sum of the others' authority below which the seat follows the tool itself
// Authority above which a hand's motion returns to it through the other hands.
constexpr double kSharedAuthorityMin = 1e-3;
}  // namespace

bool Session::slave_present(std::size_t j) const noexcept {
  return !scene_->tools[j].remote || present_[scene_->tools[j].seat];
}

void Session::step_authority() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    control::ToolAuthority::Input in;
    in.dt = dt_;
    for (std::size_t i = 0; i < masters_; ++i) {
      in.present[i] = present_[i] && slave_present(j) && !disengages_all();
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

void Session::update_couplings() noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i)
    for (std::size_t j = 0; j < tools_.size(); ++j) {
      const bool own = scene_->seats[i].kind == SeatKind::kSlave && scene_->seats[i].tool == j;
      Coupling& tie = couplings_[i][j];
      tie.alpha = i < masters_ ? tools_[j].authority.alpha(i) : own ? 1 : 0;
      tie.follow = i < masters_ ? scene_->follow[i][j] : tie.alpha;
      tie.share = std::max(tie.alpha, tie.follow);
    }
}

void Session::move_references(Time now) noexcept {
  const bool tank = scene_->channel.mfs == MfsMode::kTank;
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (uses_other_hands(i)) {
      move_predictions(now, i);
      continue;
    }
    SeatEndpoint::NearEnd near;
    bool held = false, leaving = false;
    if (scene_->seats[i].kind == SeatKind::kSlave) {
      Tool& tool = tools_[scene_->seats[i].tool];
      if (!present_[i] && seats_[i].alive(now)) tool.rest_at(seats_[i].last_state().port.x);
      for (std::size_t a = 0; a < scene_->dof; ++a) near.x[a] = tool.slave_goal(a, seats_[i].end().state().k[a]);
      near.weight = 1;
    } else {
      for (std::size_t j = 0; j < tools_.size(); ++j) {
        const Coupling& tie = couplings_[i][j];
        const double w = tie.share;
        near.weight += w;
        held |= w > 0 && tools_[j].authority.held();
        leaving |= tie.alpha > 0;
        // Each seat may count all energy dissipated at a tool: it delivers alpha_i of what it spends, and the alphas
        // sum to 1. With a tank for the flow sources that energy is split, and only alpha_i of it is passed on, so
        // that nothing is spent twice.
        if (tank && tie.follow > 0) near.heat_share = tie.alpha;
        for (std::size_t a = 0; a < scene_->dof; ++a) {
          near.x[a] += w * tools_[j].x(a);
          near.dissipated[a] += (tank ? 0.5 : 1.0) * tie.follow * tools_[j].dissipated()[a];
        }
      }
      for (std::size_t a = 0; a < scene_->dof; ++a) near.x[a] /= near.weight > 0 ? near.weight : 1;
    }
    reference_before_[i] = seats_[i].end().state().ref;
    near.engaged = present_[i] && !held;
    step_reengage_offset(i, near.engaged);
    near.offset = offset_[i];
    // No energy is paid or credited while the seat's authority moves to other seats.
    if (leaving && !present_[i] && !held) {
      seats_[i].hold(std::span{&near, 1});
      continue;
    }
    seats_[i].move(now, dt_, std::span{&near, 1});
    settle_energy(i);
  }
}

/// Moves the references under law `replica`, with one end per tool.
void Session::move_predictions(Time now, std::size_t i) noexcept {
  bool held = false, leaving = false;
  for (std::size_t j = 0; j < seats_[i].ends(); ++j) {
    const Coupling& tie = couplings_[i][j];
    const bool tool_held = tools_[j].authority.held();
    near_ends_[j].engaged = present_[i] && tie.share > 0 && !tool_held;
    held |= tie.share > 0 && tool_held;
    leaving |= tie.alpha > 0;
    for (std::size_t a = 0; a < scene_->dof; ++a) near_ends_[j].x[a] = tools_[j].x(a);
  }
  const std::span<const SeatEndpoint::NearEnd> all{near_ends_.data(), seats_[i].ends()};
  if (leaving && !present_[i] && !held) return seats_[i].hold(all);
  seats_[i].move(now, dt_, all);
}

/// Steps the offset between hand and tool, which may be apart when a seat engages or re-engages after an outage. Both
/// springs start without elongation about this offset. The offset stays until the gate has ramped in, because a hand
/// that holds still must not be pulled by a growing spring. The offset then decays at the approach speed. That speed
/// is ramped up over 0.3 s, because a step would start with 40 N/s.
void Session::step_reengage_offset(std::size_t i, bool engaged) noexcept {
  engaged_for_[i] = engaged ? engaged_for_[i] + 1 : 0;
  const double pace = std::clamp((engaged_for_[i] * dt_ - scene_->gate.ramp_in) / kReengageRampTime, 0.0, 1.0);
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    double& o = offset_[i][a];
    offset_step_[i][a] = 0;
    if (!engaged) {
      o = seats_[i].ever_heard() ? seats_[i].last_state().port.x[a] - seat_targets_[i][a] : 0;
      continue;
    }
    const double step = pace * scene_->channel.v_app / root_scale_[a] * dt_;
    offset_step_[i][a] = -std::clamp(o, -step, step);
    o += offset_step_[i][a];
  }
}

/// Credits the energy that the tools really paid. The flow sources are asked for the part that the seat's authority
/// does not pay for (design notes, control 4).
void Session::settle_energy(std::size_t i) noexcept {
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
      const Coupling& tie = couplings_[i][j];
      const double before = reference_before_[i][a] - tools_[j].x(a), after = s.ref[a] - tools_[j].x(a);
      const double given = 0.5 * s.k[a] * tie.alpha * (before * before - after * after);
      const double real = std::clamp(given, 0.0, left);
      end.credit(a, real);
      left -= real;
      const double wanted =
          std::min(left, 0.5 * s.k[a] * (tie.share - tie.alpha) * std::max(0.0, before * before - after * after));
      end.credit(a, tools_[j].sources.grant(wanted));
      left -= wanted;
      tools_[j].sources.fill((1 - tie.alpha) * paid * (tie.share > 0 ? 1 : 0));
      paid = 0;
    }
    // The decay of the offset moves the follower as a moving tool would. The flow sources pay the share without
    // authority.
    const double work = -s.k[a] * (s.ref[a] - first.x(a)) * offset_step_[i][a];
    end.credit(a, sources.grant(std::max(0.0, unpaid * work)));
    if (passes_on) static_cast<void>(sources.grant(unpaid * s.passed[a]));  // booked only: it is credited already
    end.credit(a, tools == 1 ? sources.grant(left) : 0);                    // a falling stiffness also releases energy
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
        // The schedule's damping is shared like the springs, because P+d needs it at both ends. A virtual tool has the
        // damping relative to the hand's motion.
        const double part = tool.body() != nullptr && replica_
                                ? tool.body()->relative_damping_share(a, scene_->channel.b_rel, 0, end.k[a], 0)
                                : 1;
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
    if (tool.has_contact_source()) update_contacts(j);
    tool.step(dt_, pull, tool.authority.held());
    if (tool.sources.mode() == control::FlowSourceMode::kTank)
      for (std::size_t a = 0; a < scene_->dof; ++a) tool.sources.fill(0.5 * scene_->channel.eta * tool.dissipated()[a]);
  }
}

void Session::update_contacts(std::size_t j) noexcept {
  ToolView view;
  view.dt = dt_;
  view.time = clock_.time();
  if (scene_->tools[j].remote) {
    const SeatEndpoint& seat = seats_[scene_->tools[j].seat];
    view.slave = slave_present(j) && elapsed_any_;
    view.fresh = std::exchange(slave_heard_[j], seat.generation()) != seat.generation();
    view.slave_x = seat.last_state().port.x;
    view.slave_v = seat.last_state().port.v;
    for (std::size_t a = 0; a < scene_->dof; ++a)
      view.slave_f[a] = seat.last_state().port.f[a] + seat.end().state().b[a] * view.slave_v[a];
  }
  tools_[j].update_contacts(view);
}

/// Share of the slave's spring that acts on this hand. The loop of this spring is closed over both networks. P+d
/// therefore limits its stiffness by the sum of both delays [Nuno et al., IJRR 28(7) 2009].
double Session::slave_spring_share(std::size_t i, std::size_t j) const noexcept {
  const double share = tools_[j].slave_share();
  if (!scene_->tools[j].remote || !slave_present(j) || share <= 0) return 0;
  const control::ChannelEnd& slave = seats_[scene_->tools[j].seat].end();
  const double delay = seats_[i].end(j).schedule().delay() + slave.schedule().delay();
  const double most = delay > 0 ? scene_->channel.k_delay / delay : slave.schedule().stiffness();
  // The seat's own stiffness, which its device may have lowered below the scene's.
  const double k_c = seats_[i].end().state().k[0];
  return share * std::min(1.0, std::min(slave.schedule().stiffness(), most) / k_c);
}

void Session::step_targets() noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    AxisArray injected{};  // F_ri is the effort on the IPC; the client sends its negative
    for (std::size_t i = 0; i < masters_; ++i) {
      if (!present_[i]) continue;
      const double unpaid = couplings_[i][j].follow - couplings_[i][j].alpha;
      const AxisArray& f = seats_[i].last_sample(j).f;
      for (std::size_t a = 0; a < scene_->dof; ++a) injected[a] -= unpaid * f[a] * tools_[j].moved()[a];
    }
    for (std::size_t a = 0; a < scene_->dof; ++a) tools_[j].sources.observe(a, injected[a] / dt_, dt_);
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (uses_other_hands(i)) {
      grant_follower_energy(i);
      update_targets_from_hands(i);
    } else {
      update_targets(i);
    }
  }
}

/// Asks the flow sources for the energy that other hands' motion adds beyond this hand's own authority. The pull is
/// limited to the maximum force, along the tool's path. The server knows the hand's lag from its newest sample, the
/// client knows it from the age of its data. Clock drift (200 ppm, and 10 s until the client corrects it) and the
/// hand's filters make the client's value larger. `kAgeMargin` covers that: without it a follower's account ran dry
/// within 5 s at 1000 ppm.
void Session::grant_follower_energy(std::size_t i) noexcept {
  if (!present_[i]) return;
  const double strongest = scene_->gate.force_max * share_of_force(scene_->seats[i].role);
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    const Coupling& tie = couplings_[i][j];
    if (!(tie.follow > 0)) continue;
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      const double room =
          tools_[j].sources.mode() == control::FlowSourceMode::kOpen ? kAgeMargin * tools_[j].moved()[a] / dt_ : 0;
      control::ChannelEnd& end = seats_[i].end(j);
      const double pull =
          std::clamp(end.state().k[a] * (tools_[j].x(a) + room - seats_[i].last_sample(j).x[a]), -strongest, strongest);
      // The hand has this share of the energy of its copy of the tool; the account is the copy's.
      end.credit(a, tools_[j].sources.grant(tie.follow * (1 - tie.alpha) * pull * tools_[j].moved()[a]) / tie.follow);
    }
  }
}

/// Mix-minus, as in a telephone conference: the target is where the other hands pull at the tool, without this hand's
/// own echo. A hand that shares the tool receives their samples as measured; a hand that only follows receives the
/// prediction for now.
void Session::update_targets_from_hands(std::size_t i, std::size_t j, wire::ToolForce& told) const noexcept {
  const Coupling& tie = couplings_[i][j];
  double others = 0;
  const double alone = 1 - tie.alpha, slave = slave_spring_share(i, j);
  const control::EndState* const device = slave > 0 ? &seats_[scene_->tools[j].seat].end().state() : nullptr;
  told.slave_pull = slave;
  for (std::size_t h = 0; h < masters_; ++h) others += h == i ? 0 : tools_[j].authority.alpha(h);
  AxisArray& places = told.port.x;
  AxisArray& speeds = told.port.v;
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    told.port.f[a] = tools_[j].x(a);
    places[a] = others > kNoAuthority ? 0 : told.port.f[a];
    speeds[a] = others > kNoAuthority ? 0 : tools_[j].v(a);
  }
  for (std::size_t h = 0; others > kNoAuthority && h < masters_; ++h) {
    const double part = h == i ? 0 : tools_[j].authority.alpha(h) / others;
    if (part == 0) continue;
    const control::EndState& by_now = seats_[h].end(j).state();
    const PortSample& hand = seats_[h].last_sample(j);
    const bool shares = tie.alpha >= kSharedAuthorityMin && present_[h];
    for (std::size_t a = 0; a < scene_->dof; ++a) {
      const double steady = scene_->seats[i].assist.force > 0 ? leading_hands_[h].steady_share() : 0,
                   rate = present_[h] ? by_now.led[a] : 0;
      places[a] +=
          part * (shares ? hand.x[a] : by_now.ref[a] + steady * (leading_hands_[h].steady_x(a) - by_now.ref[a]));
      speeds[a] += part * (shares ? hand.v[a] : rate + steady * (leading_hands_[h].steady_v(a) - rate));
    }
  }
  if (device == nullptr) return;
  // One spring in place of two with the stiffnesses `alone` and `slave`.
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    places[a] = (alone * places[a] + slave * device->ref[a]) / (alone + slave);
    speeds[a] = (alone * speeds[a] + slave * seats_[scene_->tools[j].seat].last_state().port.v[a]) / (alone + slave);
  }
}

void Session::update_targets_from_hands(std::size_t i) noexcept {
  const std::span<const std::size_t> tools = seats_[i].coupled_tools();
  for (std::size_t k = 0; k < tools.size(); ++k) update_targets_from_hands(i, tools[k], seats_[i].coupling_force(k));
}

/// Fills the rest of each coupling's message. If the surfaces near all tools do not fit into a datagram, the tools
/// take turns. Each is sent again long before the client drops its surfaces.
void Session::fill_coupling_messages(std::size_t i) noexcept {
  seats_[i].tx.ghost = leading_hands_.ghost(i);
  const std::span<const std::size_t> tools = seats_[i].coupled_tools();
  std::size_t room = wire::contacts_room(scene_->dof, tools.size() - 1);
  const std::size_t first = clock_.tick() % tools.size();
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const std::size_t k = (first + n) % tools.size(), j = tools[k];
    wire::ToolForce& told = seats_[i].coupling_force(k);
    for (std::size_t a = 0; a < scene_->dof; ++a) told.port.e_in[a] = seats_[i].end(j).ledger(a).in_nj();
    told.alpha = couplings_[i][j].alpha;
    told.contacts.size = 0;
    const LocalContactList& surfaces = tools_[j].contacts();
    if (surfaces.size == 0 || surfaces.size > room) continue;
    told.contacts = surfaces;
    room -= surfaces.size;
  }
}

/// Fills the message of a seat under laws without copies of tools, where one end serves all tools.
void Session::fill_tool_message(std::size_t i) noexcept {
  wire::ToolForce& told = seats_[i].tx;
  const control::ChannelEnd& end = seats_[i].end();
  for (std::size_t a = 0; a < scene_->dof; ++a) told.port.e_in[a] = end.ledger(a).in_nj();
  told.alpha = 0;
  for (std::size_t j = 0; i < masters_ && j < tools_.size() && told.alpha == 0; ++j)
    if (couplings_[i][j].follow > 0) told.alpha = couplings_[i][j].alpha;
}

/// Updates the seat's target. Velocity gates act on it as increments; without a gate it is absolute and cannot drift.
void Session::update_targets(std::size_t i) noexcept {
  bool gated = false;
  for (const Tool& tool : tools_) gated |= i < masters_ && tool.sources.gates_velocity();
  const std::size_t dof = scene_->dof, tools = tools_.size();
  AxisArray absolute{}, velocities{};
  for (std::size_t j = 0; j < tools; ++j) {
    const double follow = couplings_[i][j].follow;
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
        const double part =
            control::following_share(couplings_[i][j].alpha, couplings_[i][j].follow, tools_[j].sources.gate(a));
        moved[a] += part * tools_[j].moved()[a];
        velocities[a] += part * tools_[j].v(a);
      }
    if (present_[i])
      for (std::size_t a = 0; a < dof; ++a) absolute[a] = seat_targets_[i][a] + moved[a];
  }
  const control::EndState& end = seats_[i].end().state();
  PortSample& told = seats_[i].tx.port;
  for (std::size_t a = 0; a < dof; ++a) {
    seat_targets_[i][a] = absolute[a];
    told.x[a] = absolute[a] + offset_[i][a];
    // Until the seat is present, the target moves with its own hand, so that nothing pulls.
    told.v[a] = present_[i] ? velocities[a] + offset_step_[i][a] / dt_ : seats_[i].last_state().port.v[a];
    told.f[a] = end.k[a] * (end.ref[a] - told.x[a]);
  }
}

}  // namespace tandem::server
