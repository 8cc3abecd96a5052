#pragma once

#include "common/base/device_stiffness.h"
#include "hal/device.h"
#include "proto/control_messages.h"

namespace tandem::client {

/// What a device tells of itself when it asks for a seat.
[[nodiscard]] inline control::DeviceFacts device_facts(const hal::DeviceCaps& caps) noexcept {
  control::DeviceFacts f;
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
