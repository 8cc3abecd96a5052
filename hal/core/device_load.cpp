#include "hal/core/device_load.h"

#include <cmath>

namespace tandem::hal {
namespace {

constexpr double kSmoothing = 0.015;  // tip speed over which the sign of friction is smoothed [m/s]

}  // namespace

AxisArray weight_effort(const DeviceLoad& load, const State& state, std::size_t joints) noexcept {
  AxisArray tau{};
  for (std::size_t j = 0; j < joints; ++j) tau[j] = load.weight[j] * state.J(2, static_cast<Eigen::Index>(j));
  return tau;
}

AxisArray friction_effort(const DeviceLoad& load, const State& state, std::size_t joints) noexcept {
  AxisArray tau{};
  for (std::size_t j = 0; j < joints; ++j) {
    const double v = state.J.col(static_cast<Eigen::Index>(j)).norm() * state.dq[j];
    tau[j] = load.friction[j] * v / std::sqrt(v * v + kSmoothing * kSmoothing);
  }
  return tau;
}

}  // namespace tandem::hal
