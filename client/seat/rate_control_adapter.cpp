#include "client/seat/rate_control_adapter.h"

#include <algorithm>

namespace tandem::client {
namespace {

constexpr double kReach = 0.1;  ///< half edge of the box if the device declares no workspace [m]
/// Longest integrated time step [s], so that a pause of the thread does not move the point.
constexpr double kStepMax = 0.005;

}  // namespace

RateControlAdapter::RateControlAdapter(const hal::DeviceCaps& caps) noexcept {
  for (int i = 0; i < 3; ++i) {
    const auto a = static_cast<std::size_t>(i);
    const bool known = caps.workspace_max[a] > caps.workspace_min[a];
    low_[i] = known ? caps.workspace_min[a] : -kReach;
    high_[i] = known ? caps.workspace_max[a] : kReach;
  }
}

hal::DeviceCaps RateControlAdapter::adapted_caps(const hal::DeviceCaps& device) {
  hal::DeviceCaps caps = device;
  caps.joints = caps.tip_axes = 3;
  caps.prismatic = true;
  caps.input = hal::InputKind::kPose;
  for (hal::AxisLimit& axis : caps.axis) axis = {};
  return caps;
}

hal::State RateControlAdapter::integrate(const hal::State& state) noexcept {
  const double dt = begun_ ? std::clamp(seconds(state.sampled_at - before_), 0.0, kStepMax) : 0.0;
  begun_ = true;
  before_ = state.sampled_at;
  const hal::Vec3 wanted = state.dx.allFinite() ? state.dx : hal::Vec3::Zero();
  const hal::Vec3 from = x_;
  x_ = (x_ + dt * wanted).cwiseMax(low_).cwiseMin(high_);

  hal::State seen = state;
  seen.stale = false;  // the device's velocity decays to zero by itself, and a point at rest is a valid reading
  seen.x = x_;
  seen.dx = dt > 0 ? hal::Vec3{(x_ - from) / dt} : hal::Vec3{hal::Vec3::Zero()};
  seen.J.setZero();
  seen.J.leftCols<3>().setIdentity();
  for (int i = 0; i < 3; ++i) {
    seen.q[static_cast<std::size_t>(i)] = seen.x[i];
    seen.dq[static_cast<std::size_t>(i)] = seen.dx[i];
  }
  seen.tau_out = {};
  seen.f_out.setZero();
  return seen;
}

}  // namespace tandem::client
