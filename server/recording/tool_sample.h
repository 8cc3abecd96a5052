#pragma once

#include "proto/recording/tick_messages.h"
#include "server/report/tick_record.h"

namespace tandem::server {

/// The message of a tool's record.
[[nodiscard]] inline rec::ToolSample sample_of(const ToolRecord& r) noexcept {
  return {.measured_cp = r.x,
          .setpoint_cp = r.x_tool,
          .measured_cf = r.f_env,
          .servo_cf = r.f_cmd,
          .measured_jp = r.q,
          .sample_tick = r.sample_tick,
          .penetration = r.penetration,
          .braked = r.held,
          .energy = {r.mfs_j, r.e_p_j, r.e_p_axis_j}};
}

/// Sets the values of a record that the message has: all but the authority.
inline void set_sample(const rec::ToolSample& sample, ToolRecord& r) noexcept {
  r.x = sample.measured_cp;
  r.x_tool = sample.setpoint_cp;
  r.f_env = sample.measured_cf;
  r.f_cmd = sample.servo_cf;
  r.q = sample.measured_jp;
  r.sample_tick = sample.sample_tick;
  r.penetration = sample.penetration;
  r.held = sample.braked;
  r.mfs_j = sample.energy.mfs_j;
  r.e_p_j = sample.energy.e_p_j;
  r.e_p_axis_j = sample.energy.e_p_axis_j;
}

}  // namespace tandem::server
