#include "common/control/tool_copy.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {
constexpr double kUpToSpeed = 0.3;  // [s] from rest to the speed at which an offset goes home
}

ToolCopy::ToolCopy(const Params& params) noexcept : p_(params), tool_(params.tool, params.axes, params.contacts), told_({params.axes, params.v_app, params.k_c, params.dt}) {
  hand_.fill(HandMotionFilter(params.dt));
  anchor_.fill(HandMotionFilter(params.dt));
}

void ToolCopy::rest_at(const AxisArray& tool, const AxisArray& hand) noexcept {
  tool_.rest_at(tool);
  told_.clear();
  tool_.stream(told_.surfaces());
  for (std::size_t a = 0; a < p_.axes; ++a) {
    shown_[a] = tool[a];
    offset_[a] = hand[a] - tool[a];
    hand_[a].rest_at(hand[a]);
    anchor_[a].rest_at(tool[a]);
    wanted_[a] = dissipated_[a] = lag_[a] = 0;
  }
  share_ = engaged_for_ = 0;
}

const AxisArray& ToolCopy::step(const AxisArray& hand, double authority, ChannelEnd& end) noexcept {
  engaged_for_ += p_.dt;
  let_offset_grow(hand);
  bring_offset_home(end);
  meet_told(end);
  const EndState& reference = end.state();
  const double own = std::clamp(authority, 0.0, 1.0), alone = 1 - own;
  VirtualTool::Pulls pulls{}, without_dampers{};
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double q = hand[a] - offset_[a];
    const double velocity = HandMotionFilter::velocity_by_now(hand_[a].step(hand[a]));
    pulls[a].spring(own * share_ * p_.k_c, q - lag_[a]);  // by the force that the hand feels
    pulls[a].spring(reference.k[a], reference.ref[a]);
    without_dampers[a] = pulls[a];
    const double part = tool_.relative_damping_share(a, p_.b_rel, alone * p_.b_rel, p_.k_c, reference.k[a]);
    pulls[a].damper(part * own * share_ * p_.b_rel, velocity);
    pulls[a].damper(part * reference.b[a], reference.rate[a]);
  }
  const VirtualTool before = tool_;
  tool_.step(p_.dt, pulls);
  if (!pay_for_dampers(pulls, before, end)) {
    tool_ = before;
    tool_.step(p_.dt, without_dampers);
  }
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double v = tool_.v(a);
    dissipated_[a] = (p_.tool.b + 0.5 * reference.k[a] * p_.dt) * v * v * p_.dt;
    show(a, hand[a] - offset_[a], alone * (tool_.x(a) - before.x(a)), end);
  }
  return wanted_;
}

/// While the gate ramps in, a tool that moves on winds up the spring of a hand that is hardly pulled yet; let go at full force, a relaxed hand
/// flew at 0.9 m/s. So the offset takes what the motor could not give anyway. What the spring loses so is lost: nothing is credited.
void ToolCopy::let_offset_grow(const AxisArray& hand) noexcept {
  if (engaged_for_ >= p_.offset_rests) return;
  const double reach = p_.force_max / p_.k_c;
  AxisArray wound{};
  double square = 0;
  for (std::size_t a = 0; a < p_.axes; ++a) {
    wound[a] = shown_[a] - (hand[a] - offset_[a]);
    square += wound[a] * wound[a];
  }
  if (!(square > reach * reach)) return;
  const double beyond = 1 - reach / std::sqrt(square);
  for (std::size_t a = 0; a < p_.axes; ++a) offset_[a] -= beyond * wound[a];
}

void ToolCopy::meet_told(ChannelEnd& end) noexcept {
  const AxisArray x{tool_.x(0), tool_.x(1), tool_.x(2)};
  if (told_.step(x, &end)) tool_.stream(told_.surfaces());
}

/// A hand that holds still is pulled nowhere by a spring that only grows, so an offset stays until the gate has ramped in, and then
/// gets up to its speed by and by.
void ToolCopy::bring_offset_home(ChannelEnd& end) noexcept {
  const double pace = std::clamp((engaged_for_ - p_.offset_rests) / kUpToSpeed, 0.0, 1.0);
  const double most = pace * p_.v_app * p_.dt;
  for (std::size_t a = 0; a < p_.axes; ++a) {
    const double step = -std::clamp(offset_[a], -most, most);
    if (step != 0 && end.pay(a, share_ * wanted_[a] * step)) offset_[a] += step;
  }
}

bool ToolCopy::pay_for_dampers(const VirtualTool::Pulls& pulls, const VirtualTool& before, ChannelEnd& end) noexcept {
  AxisArray cost{};
  for (std::size_t a = 0; a < p_.axes; ++a) {
    cost[a] = (pulls[a].b_velocity - pulls[a].b * tool_.v(a)) * (tool_.x(a) - before.x(a));
    if (cost[a] > 0 && !(cost[a] < end.ledger(a).margin())) {
      end.note_refused(cost[a]);
      return false;
    }
  }
  for (std::size_t a = 0; a < p_.axes; ++a) static_cast<void>(end.pay(a, cost[a]));
  return true;
}

/// The hand feels the copy as far as is paid. The copy moved by dx and gave the spring a F dx, which moves the spring's end by a dx; its way
/// beyond that, k (y' - q)(y' - y - a dx), is paid.
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

/// The gate gives nothing, as the energy of a silence is spent: hand and copy part without a force that anybody pays for. If the spring kept that
/// way, it would come back with the next word as a step of force, and with energy that nobody paid. So the offset takes it.
void ToolCopy::let_spring_go() noexcept {
  for (std::size_t a = 0; a < p_.axes; ++a) {
    offset_[a] -= wanted_[a] / p_.k_c - lag_[a];  // also of what the hand was not shown
    shown_[a] = tool_.x(a);
    wanted_[a] = lag_[a] = 0;
  }
}

void ToolCopy::delivered(const AxisArray& effort) noexcept {
  double given = 0, wanted = 0;
  for (std::size_t a = 0; a < p_.axes; ++a) {
    given += effort[a] * wanted_[a];
    wanted += wanted_[a] * wanted_[a];
  }
  constexpr double kLeast = 1e-12;  // [N^2] below it a ratio says nothing
  if (wanted > kLeast) share_ = std::clamp(given / wanted, 0.0, 1.0);
  if (std::ranges::all_of(effort, [](double f) { return f == 0; })) let_spring_go();
  for (std::size_t a = 0; a < p_.axes; ++a) anchor_[a].step(tool_.x(a) - share_ * wanted_[a] / p_.k_c);
}

}  // namespace tandem::control
