#include "common/control/esc_hub.h"

namespace tandem::control {

EscHub::EscHub(const Params& params) noexcept : p_(params) { sources_.fill(FlowSources(params.mfs, params.tank)); }

void EscHub::set_follow(std::size_t master, std::size_t tool, double follow) noexcept {
  couplings_[master][tool].follow = couplings_[master][tool].share = follow;
  find_first_tool(master);
}

void EscHub::couple_slave(std::size_t seat, std::size_t tool) noexcept {
  couplings_[seat][tool] = {1, 1, 1};
  find_first_tool(seat);
}

void EscHub::find_first_tool(std::size_t seat) noexcept {
  first_tools_[seat] = 0;
  for (std::size_t j = p_.tools; j-- > 0;)
    if (couplings_[seat][j].follow > 0) first_tools_[seat] = j;
}

double EscHub::authority(std::size_t master) const noexcept {
  for (std::size_t j = 0; j < p_.tools; ++j)
    if (couplings_[master][j].follow > 0 && couplings_[master][j].alpha != 0) return couplings_[master][j].alpha;
  return 0;
}

bool EscHub::coupled_to_brake(std::size_t master) const noexcept {
  bool braked = false;
  for (std::size_t j = 0; j < p_.tools; ++j) braked |= couplings_[master][j].share > 0 && braked_[j];
  return braked;
}

bool EscHub::has_authority(std::size_t master) const noexcept {
  bool leads = false;
  for (std::size_t j = 0; j < p_.tools; ++j) leads |= couplings_[master][j].alpha > 0;
  return leads;
}

void EscHub::find_near_end(std::size_t seat, const AxisArray& k, NearEnd& near) const noexcept {
  near.heat_share = 1;
  if (seat >= p_.masters) {
    const ToolPort& own = tools_[first_tool(seat)];
    each_axis(p_.axes, [&](std::size_t a) { near.x[a] = own.slave_goal(a, k[a]); });
    each_axis(p_.axes, [&](std::size_t a) { near.dissipated[a] = 0; });
    near.weight = 1;
    return;
  }
  near.weight = 0;
  each_axis(p_.axes, [&](std::size_t a) { near.x[a] = near.dissipated[a] = 0; });
  const bool tank = p_.mfs == FlowSourceMode::kTank;
  for (std::size_t j = 0; j < p_.tools; ++j) {
    const Coupling& c = couplings_[seat][j];
    near.weight += c.share;
    // Each seat may count all energy dissipated at a tool: it delivers alpha_i of what it spends, and the alphas sum to
    // 1. With a tank for the flow sources that energy is split, and only alpha_i of it is passed on, so that nothing is
    // spent twice.
    if (tank && c.follow > 0) near.heat_share = c.alpha;
    const double spendable = (tank ? 0.5 : 1.0) * c.follow;
    each_axis(p_.axes, [&](std::size_t a) {
      near.x[a] += c.share * tools_[j].x[a];
      near.dissipated[a] += spendable * tools_[j].dissipated[a];
    });
  }
  const double weight = near.weight > 0 ? near.weight : 1;
  each_axis(p_.axes, [&](std::size_t a) { near.x[a] /= weight; });
}

void EscHub::settle(std::size_t seat, const AxisArray& before, const AxisArray& offset_step, ChannelEnd& end) noexcept {
  const EndState& s = end.state();
  if (seat >= p_.masters) {
    each_axis(p_.axes, [&](std::size_t a) { end.credit(a, s.absorbed[a]); });
    return;
  }
  const std::size_t first = first_tool(seat);
  FlowSources& sources = sources_[first];
  const double unpaid = 1 - couplings_[seat][first].alpha;
  const bool tank = p_.mfs == FlowSourceMode::kTank, one_tool = p_.tools == 1;
  for (std::size_t a = 0; a < p_.axes; ++a) {
    double left = s.absorbed[a], paid = s.paid[a];
    for (std::size_t j = 0; j < p_.tools; ++j) {
      const Coupling& c = couplings_[seat][j];
      const double was = before[a] - tools_[j].x[a], is = s.ref[a] - tools_[j].x[a];
      const double released = was * was - is * is;
      const double real = std::clamp(0.5 * s.k[a] * c.alpha * released, 0.0, left);
      end.credit(a, real);
      left -= real;
      const double wanted = std::min(left, 0.5 * s.k[a] * (c.share - c.alpha) * std::max(0.0, released));
      end.credit(a, sources_[j].grant(wanted));
      left -= wanted;
      // Each part of the spring stored its own energy. With one tool that is all, also the cost of a rising stiffness.
      const double stored = one_tool ? paid : std::min(paid, 0.5 * s.k[a] * c.share * std::max(0.0, -released));
      if (tank && c.share > 0) sources_[j].fill((1 - c.alpha / c.share) * stored);
      paid -= stored;
    }
    // The decay of the offset moves the follower as a moving tool would. The flow sources pay the share without
    // authority.
    const double work = -s.k[a] * (s.ref[a] - tools_[first].x[a]) * offset_step[a];
    end.credit(a, sources.grant(std::max(0.0, unpaid * work)));
    if (!tank) static_cast<void>(sources.grant(unpaid * s.passed[a]));  // booked only: it is credited already
    end.credit(a, one_tool ? sources.grant(left) : 0);                  // a falling stiffness also releases energy
  }
}

void EscHub::add_effort(std::size_t master, std::size_t tool, const EndState& end, const VirtualTool* body,
                        Efforts& out) const noexcept {
  const double alpha = couplings_[master][tool].alpha;
  if (!(alpha > 0)) return;
  each_axis(p_.axes, [&](std::size_t a) {
    out[a].spring(alpha * end.k[a], end.ref[a]);
    // The schedule's damping is shared like the springs, because P+d needs it at both ends. A virtual tool has the
    // damping relative to the hand's motion.
    const double part = body != nullptr ? body->relative_damping_share(a, p_.b_rel, 0, end.k[a], 0) : 1;
    out[a].damper(part * alpha * end.b[a], end.rate[a]);
  });
}

void EscHub::grant_following(std::size_t master, std::size_t tool, const AxisArray& hand, double effort_max,
                             ChannelEnd& end) noexcept {
  const Coupling& c = couplings_[master][tool];
  if (!(c.follow > 0)) return;
  const ToolPort& port = tools_[tool];
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double ahead = p_.mfs == FlowSourceMode::kOpen ? kAgeMargin * port.moved[a] / p_.dt : 0;
    const double pull = std::clamp(end.state().k[a] * (port.x[a] + ahead - hand[a]), -effort_max, effort_max);
    // The hand has this share of the energy of its copy of the tool; the account is the copy's.
    end.credit(a, sources_[tool].grant(c.follow * (1 - c.alpha) * pull * port.moved[a]) / c.follow);
  }
}

AxisArray EscHub::step_target(std::size_t seat, bool present, const AxisArray& k) noexcept {
  const bool master = seat < p_.masters;
  AxisArray absolute{}, flow{};
  for (std::size_t j = 0; j < p_.tools; ++j) {
    const double follow = couplings_[seat][j].follow;
    each_axis(p_.axes, [&](std::size_t a) {
      absolute[a] += follow * (master ? tools_[j].x[a] : tools_[j].slave_goal(a, k[a]));
      flow[a] += follow * tools_[j].v[a];
    });
  }
  if (master && sources_[0].gates_velocity()) {
    AxisArray moved{};
    flow = {};
    for (std::size_t j = 0; j < p_.tools; ++j) {
      const Coupling& c = couplings_[seat][j];
      for (std::size_t a = 0; a < p_.axes; ++a) {
        const double part = c.alpha + sources_[j].gate(a) * (c.follow - c.alpha);
        moved[a] += part * tools_[j].moved[a];
        flow[a] += part * tools_[j].v[a];
      }
    }
    if (present)
      for (std::size_t a = 0; a < p_.axes; ++a) absolute[a] = targets_[seat][a] + moved[a];
  }
  targets_[seat] = absolute;
  return flow;
}

}  // namespace tandem::control
