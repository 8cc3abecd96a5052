#include "common/control/channel_raw.h"

#include <algorithm>

namespace tandem::control {

const EndState& RawEnd::move(const EndInput& in) noexcept {
  schedule_.step(std::max(0.0, in.age - 0.5 * in.dt), in.dt);  // for the report; this law does not use it
  for (std::size_t a = 0; a < params_.dof; ++a) {
    state_.b[a] = 0;
    follow_unpaid(in, a, params_.schedule.k * params_.scale[a]);
  }
  return state_;
}

}  // namespace tandem::control
