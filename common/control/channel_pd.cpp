#include "common/control/channel_pd.h"

#include <algorithm>

namespace tandem::control {

const EndState& PdEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // half a tick is sampling
  const double stiffness = schedule_.stiffness();
  const double damping = kMargin * stiffness * schedule_.delay();
  for (std::size_t a = 0; a < params_.dof; ++a) {
    state_.b[a] = damping * params_.scale[a];
    follow_unpaid(in, a, stiffness * params_.scale[a]);
  }
  return state_;
}

}  // namespace tandem::control
