#include "server/console/tool_velocities.h"

namespace tandem::console {

const std::array<ToolVelocities::Velocity, kToolsMax>& ToolVelocities::update(const wire::SessionTelemetry& newest,
                                                                              double tick_hz) {
  const double span = known_ && newest.session_tick > tick_ ? (newest.session_tick - tick_) / tick_hz : 0;
  if (span > 0 && span < kSpanMin) return v_;  // a difference over a few ticks is mostly noise
  const bool good = span >= kSpanMin && span <= kSpanMax;
  for (std::size_t j = 0; j < kToolsMax; ++j) {
    const auto& x = newest.tools[j].x;
    for (std::size_t k = 0; k < 3; ++k) v_[j][k] = good ? (x[k] - x_[j][k]) / span : wire::kUnknown;
    x_[j] = x;
  }
  tick_ = newest.session_tick;
  known_ = true;
  return v_;
}

}  // namespace tandem::console
