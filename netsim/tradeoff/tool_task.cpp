#include "netsim/tradeoff/tool_task.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "common/setup/channel_factory.h"

namespace tandem::netsim::tradeoff {
namespace {

constexpr double kDepth = 0.005;   ///< before and behind the surface [m]
constexpr double kAlong = 0.002;   ///< amplitude along the surface [m]
constexpr double kCircle = 0.020;  ///< radius in free space [m]

/// Minimum jerk from 0 to 1 over u in [0, 1], and its derivative.
template <class S>
std::array<S, 2> smooth(S u) noexcept {
  if (!(u > 0)) return {0, 0};
  if (u >= 1) return {1, 0};
  return {u * u * u * (10 + u * (-15 + 6 * u)), 30 * u * u * (1 - u) * (1 - u)};
}

template <class S>
HandPoint<S> point_at(const ToolTask& task, S t) noexcept {
  HandPoint<S> out;
  constexpr S kPi = std::numbers::pi_v<S>;
  if (task.contacts.size() == 0) {  // the radius grows within 0.25 s, so that the motion begins at rest
    const auto [part, rate] = smooth<S>(4 * t);
    const S w = 4 * kPi, radius = S(kCircle) * part, growth = S(kCircle) * 4 * rate;
    out.x[0] = radius * std::cos(w * t);
    out.v[0] = growth * std::cos(w * t) - radius * w * std::sin(w * t);
    if (task.axes > 1) {
      out.x[1] = radius * std::sin(w * t);
      out.v[1] = growth * std::sin(w * t) + radius * w * std::cos(w * t);
    }
    return out;
  }
  const control::Contact& surface = task.contacts[0];
  const auto [in, in_rate] = smooth<S>(4 * t);
  const auto [back, back_rate] = smooth<S>(4 * t - S(2.4));  // from 0.6 to 0.85 s
  const S depth = S(kDepth) * (2 * (in - back) - 1), rate = S(kDepth) * 8 * (in_rate - back_rate);
  const S swing = 10 * kPi, sine = std::sin(swing * t), cosine = std::cos(swing * t);
  std::size_t across = 0;
  while (across < 2 && surface.normal[across] != 0) ++across;
  for (std::size_t a = 0; a < task.axes; ++a) {
    out.x[a] = (static_cast<S>(surface.at) - depth) * static_cast<S>(surface.normal[a]);
    out.v[a] = -rate * static_cast<S>(surface.normal[a]);
  }
  if (across < task.axes) {
    out.x[across] += S(kAlong) * (1 - cosine);
    out.v[across] += S(kAlong) * swing * sine;
  }
  return out;
}

}  // namespace

ToolTask tool_task(const SceneSpec& scene) {
  const ToolSpec& tool = scene.tools[0];
  ToolTask task{.tool = {.m = tool.m_s, .b = tool.b_s},
                .axes = scene.dof,
                .contacts = {},
                .k_c = scene.coupling.k_c,
                .b_rel = scene.channel.b_rel};
  const control::ContactSet surfaces = setup::contacts(tool.environment);
  for (std::size_t c = 0; c < surfaces.size(); ++c) {
    control::Contact contact = surfaces[c];
    contact.mu = 0;
    task.contacts.add(contact);
  }
  return task;
}

HandPoint<double> hand_at(const ToolTask& task, double t) noexcept { return point_at<double>(task, t); }
HandPoint<long double> hand_at(const ToolTask& task, long double t) noexcept { return point_at<long double>(task, t); }

ToolSample sample_of(const ToolTask& task, const std::array<double, 3>& x, const std::array<double, 3>& v,
                     const std::array<double, 3>& q) noexcept {
  ToolSample out{.x = x, .v = v};
  for (std::size_t a = 0; a < task.axes; ++a) {
    out.force[a] = task.k_c * (x[a] - q[a]);
    out.energy += 0.5 * task.tool.m * v[a] * v[a] + 0.5 * task.k_c * (x[a] - q[a]) * (x[a] - q[a]);
  }
  for (std::size_t c = 0; c < task.contacts.size(); ++c) {
    const double d = std::max(0.0, task.contacts[c].penetration(x));
    out.energy += (0.5 * task.contacts[c].k + 0.25 * task.contacts[c].k3 * d * d) * d * d;
  }
  return out;
}

SteppedTool::SteppedTool(const ToolTask& task, double tick_hz, const control::Numerics& numerics, double from) noexcept
    : task_(task),
      tick_hz_(tick_hz),
      tool_(task.tool, task.axes, task.contacts, numerics),
      ticks_(static_cast<std::size_t>(from * tick_hz)),
      hand_(hand_at(task, from)) {
  AxisArray start{};
  for (std::size_t a = 0; a < task.axes; ++a) start[a] = hand_.x[a];
  tool_.rest_at(start);
}

void SteppedTool::prepare() noexcept {
  hand_ = hand_at(task_, static_cast<double>(++ticks_) / tick_hz_);
  pulls_ = {};
  for (std::size_t a = 0; a < task_.axes; ++a) {
    pulls_[a].spring(task_.k_c, hand_.x[a]);
    pulls_[a].damper(task_.b_rel, hand_.v[a]);
  }
}

ToolSample SteppedTool::sample() const noexcept {
  return sample_of(task_, {tool_.x(0), tool_.x(1), tool_.x(2)}, {tool_.v(0), tool_.v(1), tool_.v(2)}, hand_.x);
}

}  // namespace tandem::netsim::tradeoff
