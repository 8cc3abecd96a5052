#include "netsim/tradeoff/reference.h"

#include <algorithm>
#include <cmath>

namespace tandem::netsim::tradeoff {
namespace {

using Real = long double;
using Triple = std::array<Real, 3>;

struct State {
  Triple x{}, v{};
};

State plus(const State& at, const State& rate, Real h) noexcept {
  State out = at;
  for (std::size_t a = 0; a < 3; ++a) {
    out.x[a] += h * rate.x[a];
    out.v[a] += h * rate.v[a];
  }
  return out;
}

/// Derivative of position and velocity: springs, dampers, and surfaces that push.
State rate_of(const ToolTask& task, const State& at, const HandPoint<Real>& hand) noexcept {
  State out;
  Triple force{};
  for (std::size_t a = 0; a < task.axes; ++a) {
    out.x[a] = at.v[a];
    force[a] =
        Real(task.k_c) * (hand.x[a] - at.x[a]) + Real(task.b_rel) * (hand.v[a] - at.v[a]) - Real(task.tool.b) * at.v[a];
  }
  for (std::size_t c = 0; c < task.contacts.size(); ++c) {
    const control::Contact& surface = task.contacts[c];
    Real depth = surface.at, approach = 0;
    for (std::size_t a = 0; a < task.axes; ++a) {
      depth -= Real(surface.normal[a]) * at.x[a];
      approach -= Real(surface.normal[a]) * at.v[a];
    }
    if (!(depth > 0)) continue;
    const Real push =
        std::max(Real(0), depth * (Real(surface.k) + Real(surface.k3) * depth * depth) + Real(surface.b) * approach);
    for (std::size_t a = 0; a < task.axes; ++a) force[a] += push * Real(surface.normal[a]);
  }
  for (std::size_t a = 0; a < task.axes; ++a) out.v[a] = force[a] / Real(task.tool.m);
  return out;
}

}  // namespace

std::vector<ToolSample> reference(const ToolTask& task, double tick_hz, HandInput input) {
  const auto ticks = static_cast<std::size_t>(std::floor(ToolTask::kDuration * tick_hz));
  const auto parts = static_cast<std::size_t>(std::max(kReferencePerTick, std::ceil(kReferencePerSecond / tick_hz)));
  const Real tick = 1 / Real(tick_hz), h = tick / Real(parts);
  State at;
  at.x = hand_at(task, Real(0)).x;
  std::vector<ToolSample> out;
  out.reserve(ticks);
  for (std::size_t k = 1; k <= ticks; ++k) {
    const HandPoint<Real> last = hand_at(task, Real(k) * tick);
    HandPoint<Real> now = input == HandInput::kHeld ? last : hand_at(task, Real(k - 1) * tick);
    for (std::size_t i = 0; i < parts; ++i) {
      const Real t = Real(k - 1) * tick + Real(i) * h;
      const bool held = input == HandInput::kHeld;
      const HandPoint<Real> middle = held ? last : hand_at(task, t + h / 2), next = held ? last : hand_at(task, t + h);
      const State k1 = rate_of(task, at, now), k2 = rate_of(task, plus(at, k1, h / 2), middle);
      const State k3 = rate_of(task, plus(at, k2, h / 2), middle), k4 = rate_of(task, plus(at, k3, h), next);
      at = plus(plus(plus(plus(at, k1, h / 6), k2, h / 3), k3, h / 3), k4, h / 6);
      now = next;
    }
    ToolSample& sample = out.emplace_back();
    std::array<double, 3> x{}, v{}, q{};
    for (std::size_t a = 0; a < 3; ++a) {
      x[a] = static_cast<double>(at.x[a]);
      v[a] = static_cast<double>(at.v[a]);
      q[a] = static_cast<double>(last.x[a]);
    }
    sample = sample_of(task, x, v, q);
  }
  return out;
}

}  // namespace tandem::netsim::tradeoff
