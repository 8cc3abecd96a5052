#include "hal/sim/environment.h"

namespace tandem::hal::sim {

Environment::Environment(const EnvironmentSpec& spec) noexcept {
  if (spec.wall) {
    const auto& w = *spec.wall;
    surfaces_[size_++] = {std::clamp(w.axis, 0, 2), w.from_below ? -1.0 : 1.0, w.at, w.k, 0.0, w.b};
  }
  if (spec.tissue) {
    const auto& t = *spec.tissue;
    surfaces_[size_++] = {std::clamp(t.axis, 0, 2), t.from_below ? -1.0 : 1.0, t.at, t.k, t.k3, t.b};
  }
}

double Environment::penetration(const Vec3& tip) const noexcept {
  double deepest = 0.0;
  for (std::size_t i = 0; i < size_; ++i) deepest = std::max(deepest, surfaces_[i].penetration(tip));
  return deepest;
}

}  // namespace tandem::hal::sim
