#include "common/control/tool_copy.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {
Assist::Params assist_of(const ToolCopy::Params& p) noexcept {
  Assist::Params own = p.assist;
  own.axes = p.axes;
  own.k_c = p.k_c;
  own.dt = p.dt;
  return own;
}
}  // namespace

ToolCopy::ToolCopy(const Params& params) noexcept
    : p_(params),
      tool_(params.tool, params.axes, params.contacts, params.numerics),
      received_contacts_({params.axes, params.v_app, params.k_c, params.dt}),
      assist_(assist_of(params)),
      offset_({.axes = params.axes, .hold = params.offset_hold, .v_app = params.v_app, .dt = params.dt}) {
  hand_.fill(HandVelocity(params.dt));
  anchor_.fill(HandMotionFilter(params.dt));
}

void ToolCopy::rest_at(const AxisArray& tool, const AxisArray& hand) noexcept {
  tool_.rest_at(tool);
  received_contacts_.clear();
  tool_.set_received_contacts(received_contacts_.surfaces());
  for (std::size_t a = 0; a < p_.axes; ++a) {
    shown_[a] = tool[a];
    offset_.set(a, hand[a] - tool[a]);
    hand_[a].rest_at(hand[a]);
    anchor_[a].rest_at(tool[a]);
    wanted_[a] = dissipated_[a] = lag_[a] = 0;
  }
  share_ = pull_ = engaged_for_ = 0;
  assist_.rest();
}

void ToolCopy::set_leader(const AxisArray& x, const AxisArray& velocity, bool touching) noexcept {
  leader_.led = true;
  leader_.touching = touching;
  leader_.ahead = x;
  leader_.velocity = velocity;
}

const AxisArray& ToolCopy::step(const AxisArray& hand, double authority, ChannelEnd& end) noexcept {
  engaged_for_ += p_.dt;
  grow_offset(hand);
  decay_offset(hand, end);
  apply_assist(hand, authority, end);
  apply_received_contacts(end);
  const EndState& reference = end.state();
  const double own = unit_share(authority, 1), alone = 1 - own;
  VirtualTool::Pulls pulls{}, without_dampers{};
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double q = place(hand, a);
    // Of the place to which the spring is attached. With the hand's own velocity the damper would hold back a tool that
    // returns to the hand: 2 N at 0.1 m/s in two axes.
    const double velocity = hand_[a].step(hand[a]) - offset_.last_step()[a] / p_.dt;
    pulls[a].spring(own * pull_ * p_.k_c, q - lag_[a]);  // with the force that the hand feels
    pulls[a].spring(reference.k[a], reference.ref[a]);
    without_dampers[a] = pulls[a];
    const double part = tool_.relative_damping_share(a, p_.b_rel, alone * p_.b_rel, p_.k_c, reference.k[a]);
    pulls[a].damper(part * own * pull_ * p_.b_rel, velocity);
    pulls[a].damper(part * reference.b[a], reference.rate[a]);
  }
  const VirtualTool before = tool_;
  VirtualTool::Parts parts;
  if (tool_.in_parts()) [[unlikely]] {
    parts = advance_in_parts(pulls, without_dampers, before, end);
  } else {
    tool_.step(p_.dt, pulls);
    if (!pay_for_dampers(pulls, before, end)) {
      tool_ = before;
      tool_.step(p_.dt, without_dampers);
    }
  }
  // Share of the copy's motion that does not come from this hand. It includes, as a share, the force that the hand
  // feels and the copy does not.
  const double others = pull_ == share_ ? alone : 1 - own * pull_ / share_;
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double v = tool_.v(a);
    dissipated_[a] = (p_.tool.b + 0.5 * reference.k[a] * p_.dt) * v * v * p_.dt;
    show(a, place(hand, a), others * (tool_.x(a) - before.x(a)), end);
  }
  if (tool_.in_parts()) [[unlikely]]
    for (std::size_t a = 0; a < p_.axes; ++a) dissipated_[a] = tool_.heat(parts, a, p_.tool.b, reference.k[a], p_.dt);
  return wanted_;
}

/// Moves into the offset the elongation for which the motor had no force during the ramp of the gate. A tool that moves
/// on would wind up the spring of a hand that is hardly pulled yet. Released at full force, a relaxed hand reached 0.9
/// m/s. Energy that the spring loses here is dropped and never credited.
void ToolCopy::grow_offset(const AxisArray& hand) noexcept {
  if (!offset_.stays(engaged_for_)) return;
  AxisArray wound{};
  for (std::size_t a = 0; a < p_.axes; ++a) wound[a] = shown_[a] - place(hand, a);
  offset_.absorb(wound, p_.force_max / p_.k_c);
}

void ToolCopy::apply_received_contacts(ChannelEnd& end) noexcept {
  const AxisArray x{tool_.x(0), tool_.x(1), tool_.x(2)};
  if (received_contacts_.step(x, &end)) tool_.set_received_contacts(received_contacts_.surfaces());
}

/// Each step is paid at the force of the spring after it, which is never less than its work. The force of the last tick
/// lacks what the hand has moved since: 0.1 mJ per tick at 1 m/s.
void ToolCopy::decay_offset(const AxisArray& hand, ChannelEnd& end) noexcept {
  const double pace = offset_.pace(engaged_for_);
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double step = offset_.decay(a, pace);
    const double force = share_ * p_.k_c * (shown_[a] - place(hand, a) + step);
    offset_.move(a, step != 0 && end.pay(a, force * step) ? step : 0);
  }
}

/// Applies the assist once the offset decays, because what the offset leaves between the hands is not an error of this
/// hand. The step is paid at the spring's new force, which is never less than its work. All axes pay or none does, so
/// that the pull stays within its bound.
void ToolCopy::apply_assist(const AxisArray& hand, double authority, ChannelEnd& end) noexcept {
  if (!assist_.on()) return;
  leader_.led = leader_.led && !offset_.stays(engaged_for_);
  leader_.authority = authority;
  leader_.touching |= tool_.penetration() > 0;
  for (std::size_t a = 0; a < p_.axes; ++a) leader_.ahead[a] -= hand[a] - offset_[a];
  const AxisArray& step = assist_.step(leader_);
  leader_.led = leader_.touching = false;
  AxisArray cost{};
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double work = p_.k_c * (shown_[a] - place(hand, a) + step[a]) * step[a];
    // Charged for the whole force, which will be given; refunded only for the given share.
    cost[a] = work > 0 ? work : share_ * work;
    if (cost[a] > 0 && !(cost[a] < end.ledger(a).margin())) return end.note_refused(cost[a]);
  }
  for (std::size_t a = 0; a < p_.axes; ++a)
    if (end.pay(a, cost[a])) assist_.move(a, step[a]);
}

/// Takes the tick by the numerics of the tool. The work of the dampers is that of all parts.
VirtualTool::Parts ToolCopy::advance_in_parts(const VirtualTool::Pulls& pulls,
                                              const VirtualTool::Pulls& without_dampers, const VirtualTool& before,
                                              ChannelEnd& end) noexcept {
  const VirtualTool::Parts parts = tool_.step_in_parts(p_.dt, pulls);
  AxisArray cost{};
  for (std::size_t a = 0; a < p_.axes; ++a)
    cost[a] = pulls[a].b_velocity * (tool_.x(a) - before.x(a)) - pulls[a].b * parts.squares[a];
  if (pay_in_all_axes(cost, end)) return parts;
  tool_ = before;
  return tool_.step_in_parts(p_.dt, without_dampers);
}

bool ToolCopy::pay_for_dampers(const VirtualTool::Pulls& pulls, const VirtualTool& before, ChannelEnd& end) noexcept {
  AxisArray cost{};
  for (std::size_t a = 0; a < p_.axes; ++a)
    cost[a] = (pulls[a].b_velocity - pulls[a].b * tool_.v(a)) * (tool_.x(a) - before.x(a));
  return pay_in_all_axes(cost, end);
}

bool ToolCopy::pay_in_all_axes(const AxisArray& cost, ChannelEnd& end) noexcept {
  for (std::size_t a = 0; a < p_.axes; ++a) {
    if (cost[a] > 0 && !(cost[a] < end.ledger(a).margin())) {
      end.note_refused(cost[a]);
      return false;
    }
  }
  for (std::size_t a = 0; a < p_.axes; ++a) static_cast<void>(end.pay(a, cost[a]));
  return true;
}

/// Shows the hand the motion of the copy as far as it is paid. The copy moved by dx and gave the spring a F dx, which
/// moves the spring's end by a dx. The rest of its path, k (y' - q)(y' - y - a dx), is paid.
/// @param others  (1 - a) dx [m]
void ToolCopy::show(std::size_t axis, double hand, double others, ChannelEnd& end) noexcept {
  const double k = share_ * p_.k_c;
  const double to = tool_.x(axis) - hand, from = to + lag_[axis] - others;
  const double cost = k * to * (to - from);
  double shown = to;
  if (!end.pay(axis, cost)) {
    const double budget = std::max(0.0, end.ledger(axis).margin() - 1e-9);
    const double root = std::sqrt(from * from + 4 * budget / k);
    shown = 0.5 * (from + (to > from ? root : -root));
    shown = std::clamp(shown, std::min(from, to), std::max(from, to));
    const double affordable = k * shown * (shown - from);
    end.note_refused(cost - affordable);
    if (!end.pay(axis, affordable)) shown = from;
  }
  shown_[axis] = hand + shown;
  lag_[axis] = shown - to;
  wanted_[axis] = p_.k_c * shown;
}

/// Moves the elongation of the spring into the offset while the gate passes no effort because the energy of a silence
/// is spent. Hand and copy then separate without any force that an account pays for. A spring that kept the elongation
/// would return it with the next datagram as a step of force with unpaid energy.
void ToolCopy::release_spring() noexcept {
  for (std::size_t a = 0; a < p_.axes; ++a) {
    offset_.set(a, offset_[a] - (wanted_[a] / p_.k_c - lag_[a]));  // also of what the hand was not shown
    shown_[a] = tool_.x(a);
    wanted_[a] = lag_[a] = 0;
  }
}

/// The force of the ramp changes by 10 N/s, that of a following hand by more. A spring that waited for its force would
/// swing against the hand, and what it had wound up would come at 1 N per ms when the ramp ends. Energy that the spring
/// loses here is dropped and never credited.
void ToolCopy::yield(const AxisArray& part) noexcept {
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double given_up = unit_share(part[a], 0) * wanted_[a];
    offset_.set(a, offset_[a] - given_up / p_.k_c);
    wanted_[a] -= given_up;
  }
}

std::optional<double> ToolCopy::share_of(const AxisArray& given, const AxisArray& wanted, std::size_t axes) noexcept {
  double part = 0, whole = 0;
  for (std::size_t a = 0; a < axes; ++a) {
    part += given[a] * wanted[a];
    whole += wanted[a] * wanted[a];
  }
  constexpr double kLeast = 1e-12;  // [N^2]
  return whole > kLeast ? std::optional{std::clamp(part / whole, 0.0, 1.0)} : std::nullopt;
}

void ToolCopy::delivered(const AxisArray& effort) noexcept {
  share_ = share_of(effort, wanted_, p_.axes).value_or(share_);
  pull_ = share_;
  if (p_.of_several) {  // Two tools that separate pull a hand in opposite directions: the motor gives only the
                        // difference, and each pull is limited to its force.
    double square = 0;
    for (std::size_t a = 0; a < p_.axes; ++a) square += wanted_[a] * wanted_[a];
    if (share_ * share_ * square > p_.force_max * p_.force_max) pull_ = p_.force_max / std::sqrt(square);
  }
  if (std::ranges::all_of(effort, [](double f) { return f == 0; })) release_spring();
  for (std::size_t a = 0; a < p_.axes; ++a) anchor_[a].step(tool_.x(a) - pull_ * wanted_[a] / p_.k_c);
}

}  // namespace tandem::control
