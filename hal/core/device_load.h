#pragma once

#include <cstddef>

#include "hal/core/device.h"

namespace tandem::hal {

/// Returns the joint effort with which a device's weight pulls at this pose [N m] or [N]: tau_g,j = w_j J_zj. Motors
/// that balance it give the same effort.
[[nodiscard]] AxisArray weight_effort(const DeviceLoad& load, const State& state,
                                      std::size_t joints) noexcept TANDEM_REALTIME;

/// Returns the joint effort that moves a device against its Coulomb friction [N m] or [N]:
/// c_j v / sqrt(v^2 + v_s^2), v the speed of the tip by joint j alone, v_s = 15 mm/s. Its power is never negative, and
/// at most that of the friction.
[[nodiscard]] AxisArray friction_effort(const DeviceLoad& load, const State& state,
                                        std::size_t joints) noexcept TANDEM_REALTIME;

}  // namespace tandem::hal
