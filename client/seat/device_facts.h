#pragma once

#include "common/base/stiffness_limit.h"
#include "hal/core/device.h"
#include "proto/rpc/rpc_messages.h"

namespace tandem::client {

/// Returns the device properties that a client sends with a join request. SI units. Unknown
/// force, damping and mass are 0. An unknown latency is 0 for simulated devices and `kLatencyUnknown` for real ones.
[[nodiscard]] inline rpc::DeviceFacts device_facts(const hal::DeviceCaps& caps) noexcept {
  rpc::DeviceFacts f;
  f.joints = static_cast<std::uint32_t>(caps.joints);
  f.tip_axes = static_cast<std::uint32_t>(caps.tip_axes);
  f.simulated = caps.simulated;
  f.prismatic = caps.prismatic;
  f.force_peak_n = caps.axis[0].peak.value_or(0);
  f.damping_n_s_m = caps.damping.value_or(0);
  f.mass_kg = caps.mass.value_or(0);
  f.latency_s = caps.latency.value_or(caps.simulated ? 0 : kLatencyUnknown);
  return f;
}

}  // namespace tandem::client
