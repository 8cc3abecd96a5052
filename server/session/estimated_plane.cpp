#include "server/session/estimated_plane.h"

#include <algorithm>

namespace tandem::server {

void EstimatedPlane::find_contacts(const ToolView& tool, LocalContactList& out) noexcept {
  using State = control::PlaneEstimator::State;
  waited_ += tool.dt;
  if (!tool.slave) {
    estimator_.reset();
    waited_ = 0;
    confidence_ = 1;
    return;
  }
  if (tool.fresh) {
    control::PlaneEstimator::Sample sample;
    for (std::size_t a = 0; a < tool.axes; ++a) {
      sample.x[a] = tool.slave_x[a];
      sample.v[a] = tool.slave_v[a];
      sample.f[a] = tool.slave_f[a];
    }
    estimator_.step(waited_, sample);
    waited_ = 0;
  }
  const double wanted = estimator_.state() == State::kTouching ? 0 : 1, step = kConfidenceRate * tool.dt;
  confidence_ += std::clamp(wanted - confidence_, -step, step);
  if (estimator_.state() != State::kKnown) return;
  LocalContact plane{
      .id = estimator_.touches(), .k = static_cast<float>(estimator_.stiffness()), .b = static_cast<float>(kDamping)};
  const auto point = estimator_.point();
  for (std::size_t a = 0; a < tool.axes; ++a) {
    plane.point[a] = static_cast<float>(point[a]);
    plane.normal[a] = static_cast<float>(estimator_.normal()[a]);
  }
  out.add(plane);
}

}  // namespace tandem::server
