#include "server/session/shared_control.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "common/control/mix_minus.h"
#include "common/setup/channel_factory.h"

namespace tandem::server {

namespace {

control::EscHub::Params hub_params(const SceneSpec& scene) {
  return {.axes = scene.dof,
          .masters = scene.masters(),
          .tools = scene.tools.size(),
          .mfs = setup::flow_source_mode(scene.channel.mfs),
          .tank = scene.channel.tank,
          .eta = scene.channel.eta,
          .b_rel = scene.channel.b_rel,
          .dt = 1.0 / scene.tick_hz};
}

control::ReengageOffset offset_of(const SceneSpec& scene, const AxisArray& scale) {
  control::ReengageOffset::Params p{
      .axes = scene.dof, .hold = scene.gate.ramp_in, .v_app = scene.channel.v_app, .dt = 1.0 / scene.tick_hz};
  for (std::size_t a = 0; a < kAxesMax; ++a) p.root_scale[a] = std::sqrt(scale[a]);
  return control::ReengageOffset(p);
}

}  // namespace

SharedControl::SharedControl(const SceneSpec& scene, std::vector<std::unique_ptr<hal::SteppedDevice>> slaves,
                             const AxisArray& scale, std::span<SeatEndpoint> seats,
                             const std::array<bool, kSeatsMax>& present)
    : scene_(&scene),
      dt_(1.0 / scene.tick_hz),
      seats_(seats),
      present_(present),
      masters_(scene.masters()),
      replica_(scene.channel.law == LawKind::kReplica),
      coupling_(setup::hand_coupling(scene.channel.coupling)),
      coupling_params_{.axes = scene.dof,
                       .k = seat_setup(scene, 0).channel.k,
                       .saturation = scene.gate.force_max,
                       .v_app = scene.channel.v_app,
                       .dt = 1.0 / scene.tick_hz},
      hub_(hub_params(scene)) {
  for (std::size_t a = 0; a < kAxesMax; ++a) tip_gain_[a] = 1 / std::sqrt(scale[a]);
  offsets_.fill(offset_of(scene, scale));
  tools_.reserve(scene.tools.size());
  for (std::size_t j = 0; j < scene.tools.size(); ++j) {
    tools_.emplace_back(scene, j, std::move(slaves[j]));
    hub_.set_tool(j, tools_[j].port());
    for (std::size_t i = 0; i < masters_; ++i) hub_.set_follow(i, j, scene.follow[i][j]);
  }
  for (std::size_t i = 0; i < masters_; ++i)
    effort_max_[i] = scene.gate.force_max * share_of_force(scene.seats[i].role) / scene.seats[i].motion_scale;
  for (std::size_t i = masters_; i < scene.seats.size(); ++i) hub_.couple_slave(i, scene.seats[i].tool);
}

void SharedControl::rest_tool(std::size_t j, const AxisArray& x) noexcept {
  tools_[j].rest_at(x);
  hub_.set_tool(j, tools_[j].port());
}

std::uint64_t SharedControl::not_finite() const noexcept {
  std::uint64_t steps = 0;
  for (const Tool& tool : tools_) steps += tool.not_finite();
  return steps;
}

bool SharedControl::touching(Time now, std::size_t j) const noexcept {
  constexpr double kTouchN = 0.05;  // [N] noise level of a force sensor
  if (const hal::SteppedDevice* const slave = tools_[j].slave())
    return slave->state().penetration > 0 || slave->state().f_env.squaredNorm() > kTouchN * kTouchN;
  if (!scene_->tools[j].remote) return tools_[j].body() != nullptr && tools_[j].body()->penetration() > 0;
  const SeatEndpoint& seat = seats_[scene_->tools[j].seat];
  if (!seat.alive(now)) return false;
  const wire::Telemetry& heard = seat.telemetry();
  return heard.penetration_m > 0 || std::ranges::any_of(heard.f_env, [](double f) { return std::abs(f) > kTouchN; });
}

bool SharedControl::slave_present(std::size_t j) const noexcept {
  return !scene_->tools[j].remote || present_[scene_->tools[j].seat];
}

void SharedControl::step_authority(bool released) noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    const bool driven = !released && slave_present(j);
    std::array<bool, kMastersMax> present{};
    for (std::size_t i = 0; i < masters_; ++i) present[i] = driven && present_[i];
    double dissipated = 0;
    each_axis(scene_->dof, [&](std::size_t a) { dissipated += (1 - scene_->channel.eta) * tool.port().dissipated[a]; });
    if (tool.authority.settled(present)) {
      tool.authority.fill(dissipated);
      continue;
    }
    control::ToolAuthority::Input in{.dt = dt_, .present = present, .dissipated = dissipated, .pull = {}};
    double felt = 0;  // force of the most sensitive hand per force of the tool
    for (std::size_t i = 0; i < masters_; ++i)
      if (present[i]) felt = std::max(felt, scene_->seats[i].motion_scale);
    for (std::size_t i = 0; i < masters_; ++i) {
      const control::EndState& spring = seats_[i].end(j).state();
      in.stored[i] = spring.stored(tool.port().x, scene_->dof);
      each_axis(scene_->dof, [&](std::size_t a) {
        in.pull[i][a] = felt * tip_gain_[a] * spring.k[a] * (spring.ref[a] - tool.x(a));
      });
    }
    tool.authority.step(in);
    hub_.set_authority(j, tool.authority.weights(), tool.authority.held());
  }
}

void SharedControl::move_references(Time now) noexcept {
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (has_copies(i)) {
      move_predictions(now, i);
    } else {
      move_spring(now, i);
    }
  }
}

/// Moves the reference of a seat whose one end serves all its tools.
void SharedControl::move_spring(Time now, std::size_t i) noexcept {
  SeatEndpoint& seat = seats_[i];
  const bool master = i < masters_, present = present_[i];
  if (!master && !present && seat.alive(now)) rest_tool(scene_->seats[i].tool, seat.last_state().port.x);
  control::ChannelEnd& end = seat.end();
  control::NearEnd& near = near_ends_[0];
  hub_.find_near_end(i, end.state().k, near);
  const bool braked = master && hub_.meets_brake(i);
  near.engaged = present && !braked;
  step_offset(i, near.engaged);
  each_axis(scene_->dof, [&](std::size_t a) { near.offset[a] = offsets_[i][a]; });
  // No energy is paid or credited while the seat's authority moves to other seats.
  if (master && !present && !braked && hub_.has_authority(i)) return seat.hold(std::span{&near, 1});
  const AxisArray before = end.state().ref;
  seat.move(now, dt_, std::span{&near, 1});
  hub_.settle(i, before, offsets_[i].last_step(), end);
}

/// Moves the references under law `replica`, with one end per tool.
void SharedControl::move_predictions(Time now, std::size_t i) noexcept {
  SeatEndpoint& seat = seats_[i];
  const bool present = present_[i];
  for (std::size_t j = 0; j < seat.ends(); ++j) {
    near_ends_[j].engaged = present && hub_.coupling(i, j).share > 0 && !hub_.braked(j);
    for (std::size_t a = 0; a < scene_->dof; ++a) near_ends_[j].x[a] = hub_.tool(j).x[a];
  }
  const std::span<const control::NearEnd> all{near_ends_.data(), seat.ends()};
  if (!present && hub_.has_authority(i) && !hub_.meets_brake(i)) return seat.hold(all);
  seat.move(now, dt_, all);
}

void SharedControl::step_offset(std::size_t i, bool engaged) noexcept {
  const SeatEndpoint& seat = seats_[i];
  control::ReengageOffset& offset = offsets_[i];
  engaged_ticks_[i] = engaged ? engaged_ticks_[i] + 1 : 0;
  const double pace = offset.pace(engaged_ticks_[i] * dt_);
  each_axis(scene_->dof, [&](std::size_t a) {
    if (engaged) [[likely]] {
      offset.move(a, offset.decay(a, pace));
    } else {
      offset.set(a, seat.ever_heard() ? seat.last_state().port.x[a] - hub_.target(i)[a] : 0);
    }
  });
}

void SharedControl::step_tools(double time) noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    Tool& tool = tools_[j];
    each_axis(scene_->dof, [&](std::size_t a) { efforts_[a] = {}; });
    const control::VirtualTool* const body = replica_ ? tool.body() : nullptr;
    for (std::size_t i = 0; i < masters_; ++i) hub_.add_effort(i, j, seats_[i].end(j).state(), body, efforts_);
    const double share = scene_->tools[j].remote && slave_present(j) ? tool.slave_share() : 0;
    if (share > 0) hub_.add_slave_effort(share, seats_[scene_->tools[j].seat].end().state(), efforts_);
    if (tool.has_contact_source()) update_contacts(j, time);
    tool.step(dt_, efforts_, tool.authority.held());
    hub_.set_tool(j, tool.port());
    hub_.fill_tank(j);
  }
}

void SharedControl::update_contacts(std::size_t j, double time) noexcept {
  ToolView view;
  view.dt = dt_;
  view.time = time;
  if (scene_->tools[j].remote) {
    const SeatEndpoint& seat = seats_[scene_->tools[j].seat];
    const PortSample& heard = seat.last_state().port;
    view.slave = slave_present(j);
    view.fresh = std::exchange(slave_generation_[j], seat.generation()) != seat.generation();
    view.slave_x = heard.x;
    view.slave_v = heard.v;
    for (std::size_t a = 0; a < scene_->dof; ++a)
      view.slave_f[a] = heard.f[a] + seat.end().state().b[a] * view.slave_v[a];
  }
  tools_[j].update_contacts(view);
}

void SharedControl::step_targets(std::uint32_t tick, const LeadingHands& hands) noexcept {
  bool contacts = false, sources = false;
  for (std::size_t j = 0; j < tools_.size(); ++j) {
    contacts |= tools_[j].has_contact_source();
    if (hub_.alone(j)) continue;
    sources = true;
    observe_sources(j);
  }
  for (std::size_t i = 0; i < seats_.size(); ++i) {
    if (!has_copies(i)) {
      fill_tool_target(i);
      fill_account(i, 0, i < masters_ ? hub_.authority(i) : 0, seats_[i].tx);
      continue;
    }
    if (sources && present_[i]) grant_following(i);
    SeatEndpoint& seat = seats_[i];
    const std::span<const std::size_t> tools = seat.coupled_tools();
    for (std::size_t k = 0; k < tools.size(); ++k) {
      fill_hand_target(i, tools[k], hands, seat.coupling_force(k));
      fill_account(i, tools[k], hub_.coupling(i, tools[k]).alpha, seat.coupling_force(k));
    }
    if (contacts) fill_contacts(seat, tick);
    seat.tx.ghost = hands.ghost(i);
  }
}

/// Integrates the observer of a tool's flow sources.
void SharedControl::observe_sources(std::size_t j) noexcept {
  AxisArray injected{};
  for (std::size_t i = 0; i < masters_; ++i)
    if (present_[i]) hub_.add_injected(i, j, seats_[i].last_sample(j).f, injected);
  hub_.observe(j, injected);
}

void SharedControl::grant_following(std::size_t i) noexcept {
  for (std::size_t j = 0; j < tools_.size(); ++j)
    if (!hub_.alone(j)) hub_.grant_following(i, j, seats_[i].last_sample(j).x, effort_max_[i], seats_[i].end(j));
}

/// Share of the slave's spring that acts on this hand; 0 without one.
double SharedControl::slave_share(std::size_t i, std::size_t j) const noexcept {
  if (!scene_->tools[j].remote || !slave_present(j)) return 0;
  const double share = tools_[j].slave_share();
  if (share <= 0) return 0;
  return control::MixMinus::slave_share(share, seats_[i].end(j).schedule(),
                                        seats_[scene_->tools[j].seat].end().schedule(), scene_->channel.k_delay,
                                        seats_[i].end().state().k[0]);
}

void SharedControl::fill_hand_target(std::size_t i, std::size_t j, const LeadingHands& hands,
                                     wire::ToolForce& out) const noexcept {
  out.slave_pull = slave_share(i, j);
  for (std::size_t a = 0; a < scene_->dof; ++a) out.port.f[a] = hub_.tool(j).x[a];
  control::MixMinus mix(hub_, i, j, out.port.x, out.port.v);
  for (std::size_t h = 0; mix.led() && h < masters_; ++h) {
    const double part = mix.part(h);
    if (part == 0) continue;
    const SeatEndpoint& other = seats_[h];
    if (mix.shares() && present_[h]) {
      mix.add_measured(part, other.last_sample(j));
    } else {
      const control::LeadingHand& lead = hands[h];
      mix.add_predicted(part, other.end(j).state(), lead, scene_->seats[i].assist.force > 0 ? lead.steady_share() : 0,
                        present_[h]);
    }
  }
  if (!(out.slave_pull > 0)) return;
  const SeatEndpoint& slave = seats_[scene_->tools[j].seat];
  mix.add_slave(out.slave_pull, slave.end().state().ref, slave.last_state().port.v);
}

void SharedControl::fill_tool_target(std::size_t i) noexcept {
  SeatEndpoint& seat = seats_[i];
  const bool present = present_[i];
  const control::EndState& end = seat.end().state();
  const AxisArray flow = hub_.step_target(i, present, end.k);
  PortSample& out = seat.tx.port;
  const AxisArray& target = hub_.target(i);
  const AxisArray& heard = seat.last_state().port.v;
  const control::ReengageOffset& offset = offsets_[i];
  each_axis(scene_->dof, [&](std::size_t a) {
    out.x[a] = target[a] + offset[a];
    // Until the seat is present, the target moves with its own hand, so that nothing pulls.
    out.v[a] = present ? flow[a] + offset.last_step()[a] / dt_ : heard[a];
    out.f[a] = end.k[a] * (end.ref[a] - target[a]);
  });
  if (present) seat.end().replace_velocity(out.v);
  if (i < masters_ && coupling_ != control::HandCoupling::kEsc) fill_coupled_target(i, out);
}

/// The tool as the couplings see it.
control::CoupledBody SharedControl::coupled_tool() const noexcept {
  const control::ToolPort& port = hub_.tool(0);
  control::CoupledBody tool{.x = port.x, .v = port.v, .f = port.surface_force};
  if (const hal::SteppedDevice* const slave = tools_[0].slave())
    for (std::size_t a = 0; a < scene_->dof; ++a) tool.f[a] = slave->state().f_env[static_cast<Eigen::Index>(a)];
  return tool;
}

/// Replaces the target of a present hand by that of the coupling. Hands are compared at the tool: each without the
/// offset with which it engaged.
void SharedControl::fill_coupled_target(std::size_t i, PortSample& out) noexcept {
  std::array<control::CoupledBody, kMastersMax> bodies;
  std::size_t present = 0, own = 0;
  for (std::size_t h = 0; h < masters_; ++h) {
    if (!present_[h]) continue;
    if (h == i) own = present;
    const PortSample& heard = seats_[h].last_state().port;
    control::CoupledBody& body = bodies[present++];
    body = {.x = heard.x, .v = heard.v, .f = heard.f, .alpha = hub_.coupling(h, 0).alpha};
    for (std::size_t a = 0; a < scene_->dof; ++a) body.x[a] -= offsets_[h][a];
  }
  control::CoupledTarget& target = coupled_targets_[i];
  if (!present_[i]) {
    target = {.x = hub_.target(i), .v = {}};  // where the hand begins
    return;
  }
  target = control::coupled_target(coupling_, coupling_params_, std::span{bodies}.first(present), own, coupled_tool(),
                                   target);
  for (std::size_t a = 0; a < scene_->dof; ++a) {
    out.x[a] = target.x[a] + offsets_[i][a];
    out.v[a] = target.v[a] + offsets_[i].last_step()[a] / dt_;
  }
}

void SharedControl::fill_account(std::size_t i, std::size_t j, double alpha, wire::ToolForce& out) const noexcept {
  const control::ChannelEnd& end = seats_[i].end(j);
  each_axis(scene_->dof, [&](std::size_t a) { out.port.e_in[a] = end.ledger(a).in_nj(); });
  out.alpha = alpha;
}

/// If the surfaces near all tools do not fit into a datagram, the tools take turns. Each is sent again long before the
/// client drops its surfaces.
void SharedControl::fill_contacts(SeatEndpoint& seat, std::uint32_t tick) const noexcept {
  const std::span<const std::size_t> tools = seat.coupled_tools();
  std::size_t space = wire::contacts_room(scene_->dof, tools.size() - 1);
  const std::size_t first = tick % tools.size();
  for (std::size_t n = 0; n < tools.size(); ++n) {
    const std::size_t k = (first + n) % tools.size();
    LocalContactList& out = seat.coupling_force(k).contacts;
    const LocalContactList& surfaces = tools_[tools[k]].contacts();
    out.size = 0;
    if (surfaces.size == 0 || surfaces.size > space) continue;
    out = surfaces;
    space -= surfaces.size;
  }
}

}  // namespace tandem::server
