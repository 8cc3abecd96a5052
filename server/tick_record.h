#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "proto/wire.h"

namespace tandem::server {

using Triple = std::array<double, 3>;

/// Everything a trace or a report wants of one tick: plain data, fit for a queue to an ordinary thread.
struct SeatRecord {
  double alpha = 0;          ///< over the first tool it follows
  AxisArray q{};             ///< joints of the device [rad] or [m]
  Triple x{}, f_cmd{}, f_out{};  ///< tip [m]; commanded before the gate, delivered [N]
  EnergyArray e_in{}, e_out{};   ///< of the client's end [nJ]
  double dissipated_j = 0, refused_j = 0, margin_min_j = 0, delivered_j = 0;
  std::uint32_t leader = 0;  ///< number of the master that leads this hand, from 1; 0: none
  Triple ghost{};            ///< where that hand is by now, as the server believes [m]; 0 where none leads
  wire::GateState gate = wire::GateState::kOff;
  bool engaged = false;
  std::uint32_t sample_tick = 0;  ///< session tick at which x, q, f were sampled: earlier than the record's over a network
};
struct ToolRecord {
  AxisArray q{};             ///< joints of the slave device
  Triple x{};                ///< tip of the slave device [m]
  Triple x_tool{};           ///< virtual mass, first three port axes
  Triple f_cmd{}, f_env{};   ///< commanded to the slave; of the environment on the slave [N]
  double penetration = 0;    ///< [m]
  bool held = true;
  double mfs_j = 0;          ///< granted by the flow sources, cumulative [J]
  double e_p_j = 0;          ///< E_p of [Licona et al. 2019] eq. 3, all axes [J]
  std::array<double, 3> e_p_axis_j{};
  std::uint32_t sample_tick = 0;
};
struct TickRecord {
  std::uint32_t tick = 0;    ///< session tick
  bool running = false;
  std::uint64_t stood = 0;    ///< ticks so far for which the clock stood still, as people had stopped the session; not running then
  std::uint64_t slipped = 0;  ///< ticks given up so far: session time stood still while hands moved
  std::array<SeatRecord, kSeatsMax> seats{};
  std::array<ToolRecord, kToolsMax> tools{};
};

}  // namespace tandem::server
