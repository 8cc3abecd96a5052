#pragma once

#include <array>
#include <cstdint>

#include "common/base/axes.h"
#include "proto/wire/wire_messages.h"

namespace tandem::server {

using Triple = std::array<double, 3>;

/// All values of one tick that traces and reports use: plain data, suitable for a queue to another thread.
struct SeatRecord {
  double alpha = 0;              ///< authority over the first tool that it follows
  AxisArray q{};                 ///< joints of the device [rad] or [m]
  Triple x{}, f_cmd{}, f_out{};  ///< tip [m]; force commanded before the gate, and delivered [N]; as the tool sees them
  Triple v{};  ///< velocity of the tip as the tool sees it [m/s]; NaN in scenes with port JOINT, where it is not known
  EnergyArray e_in{}, e_out{};  ///< energy at the client's end [nJ]
  double dissipated_j = 0, refused_j = 0, margin_min_j = 0, delivered_j = 0;
  std::uint32_t leader = 0;  ///< number of the master that leads this seat, from 1; 0: none
  Triple ghost{};            ///< predicted present position of that master's tip [m]; 0 if none leads
  wire::GateState gate = wire::GateState::kOff;
  bool engaged = false;
  std::uint32_t sample_tick = 0;  ///< session tick of the sample x, q, f; earlier than the record's over a network
};
struct ToolRecord {
  AxisArray q{};            ///< joints of the slave device
  Triple x{};               ///< tip of the slave device [m]
  Triple x_tool{};          ///< virtual mass, first three port axes
  Triple f_cmd{}, f_env{};  ///< force commanded to the slave; force of the environment on the slave [N]
  double penetration = 0;   ///< [m]
  bool held = true;
  double mfs_j = 0;  ///< energy granted by the flow sources, cumulative [J]
  double e_p_j = 0;  ///< E_p of [Licona et al. 2019] eq. 3, all axes [J]
  std::array<double, 3> e_p_axis_j{};
  std::uint32_t sample_tick = 0;
  std::array<double, kMastersMax> alpha{};  ///< authority of each master in force [0, 1]
};
struct TickRecord {
  std::uint32_t tick = 0;    ///< session tick
  std::int64_t time_ns = 0;  ///< server's monotonic clock at this tick, since its first tick [ns]
  bool running = false;
  bool every_tick = true;  ///< a trace or recording wants each tick; false: the records before and after may be missing
  bool unleased = false;   ///< the directory of the service did not answer in time, so no hand was engaged
  std::uint64_t stopped_ticks = 0;  ///< ticks so far in which the session was stopped and its clock did not advance
  std::uint64_t dropped_ticks = 0;  ///< dropped ticks so far: session time did not advance while hands moved
  std::array<SeatRecord, kSeatsMax> seats{};
  std::array<ToolRecord, kToolsMax> tools{};
};

}  // namespace tandem::server
