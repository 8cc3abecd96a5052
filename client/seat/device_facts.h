#pragma once

#include "common/base/stiffness_limit.h"
#include "hal/core/device.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Returns the device properties that a client sends with a join request. SI units. Unknown
/// force, damping and mass are 0. An unknown latency is 0 for simulated devices and `kLatencyUnknown` for real ones.
[[nodiscard]] inline rpc::DeviceFacts device_facts(const hal::DeviceCaps& caps) noexcept {
  return {.joints = static_cast<std::uint32_t>(caps.joints),
          .tip_axes = static_cast<std::uint32_t>(caps.tip_axes),
          .simulated = caps.simulated,
          .prismatic = caps.prismatic,
          .force_peak_n = caps.axis[0].peak.value_or(0),
          .damping_n_s_m = caps.damping.value_or(0),
          .mass_kg = caps.mass.value_or(0),
          .latency_s = caps.latency.value_or(caps.simulated ? 0 : kLatencyUnknown)};
}

}  // namespace tandem::client
