#include "common/control/send_pace.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

SendPace::SendPace(const Params& params, std::size_t tools) : params_(params), sent_(tools) {
  params_.interval = std::max(params_.interval, 1U);
  params_.heartbeat = std::max(params_.heartbeat, params_.interval);
}

bool SendPace::noticeable(std::uint32_t tick, std::size_t tool, const PortSample& sample, double force,
                          bool acts) const noexcept {
  PortSample last = sent_[tool];
  HeldSample::predict(last, params_.dof, std::min(tick - last_, params_.heartbeat) * params_.dt, params_.order);
  double x_error = 0, v_error = 0, f_error = 0, speed = 0, effort = 0;
  for (std::size_t a = 0; a < params_.dof; ++a) {
    if (sample.e_in[a] - last.e_in[a] > params_.energy) return true;  // an account that restarted wraps: sent as well
    const double dx = sample.x[a] - last.x[a], dv = sample.v[a] - last.v[a], df = sample.f[a] - last.f[a];
    x_error += dx * dx;
    v_error += dv * dv;
    f_error += df * df;
    speed += sample.v[a] * sample.v[a];
    effort += sample.f[a] * sample.f[a];
  }
  const double least = params_.force_floor * params_.force_floor, weber2 = params_.weber * params_.weber;
  const double pull = std::max({force * force, params_.force_is_place ? 0 : effort, least});
  if (!std::isfinite(x_error + v_error) || (params_.force_acts && !std::isfinite(f_error))) return true;
  if (params_.force_acts && f_error > weber2 * std::max(effort, least)) return true;
  if (!acts) return false;
  const double slow = params_.velocity_floor * params_.velocity_floor, stiff = params_.stiffness * params_.stiffness;
  return v_error > weber2 * std::max(speed, slow) || stiff * x_error > weber2 * pull;
}

}  // namespace tandem::control
