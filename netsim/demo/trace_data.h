#pragma once

#include <array>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

/// The trace of one run, as columns of numbers. Pure functions: text in, numbers out.
namespace tandem::netsim::demo {

using Column = std::vector<double>;
using Column3 = std::array<Column, 3>;

/// The columns that the server's trace and a client's own samples have of a hand.
struct HandColumns {
  Column3 q;      ///< joints [rad]
  Column3 x;      ///< tip, HAL frame: x right, y away, z up [m]
  Column3 f_cmd;  ///< commanded force on the hand [N]
  Column3 f_out;  ///< delivered force on the hand [N]
};
/// The hand of one user.
struct SeatTrace : HandColumns {
  Column alpha;    ///< [1]
  Column3 torque;  ///< J^T f_cmd [N m]; filled by app/joint_torques.h
};
/// The slave and the tool it carries.
struct ToolTrace {
  Column3 q;       ///< joints [rad]
  Column3 x;       ///< tip [m]
  Column3 f_cmd;   ///< commanded force of the slave device [N]
  Column3 f_env;   ///< force of the environment on the slave [N]
  Column3 e_p;     ///< E_p of [Licona et al. 2019] eq. 3, per axis of the port [J]
  Column3 torque;  ///< J^T f_cmd [N m]; filled by app/joint_torques.h
};
/// Samples that a client recorded of its own hand, one row per servo tick, without loss or delay.
struct SeatSamples : HandColumns {
  Column t;  ///< session time [s], as the client estimates it
};
struct TraceData {
  Column t;  ///< since the session began [s]
  SeatTrace trainer, trainee;
  ToolTrace tool;
  SeatSamples trainer_own, trainee_own;  ///< empty in virtual time, where the trace has no delay
  [[nodiscard]] std::size_t rows() const noexcept { return t.size(); }
};

/// Reads a trace of server/report/trace_csv.h with the seats `trainer` and `trainee`, the tool `tool` and three axes.
/// Other columns are ignored; a cell that is not a finite number becomes NaN.
/// @return the columns; or the error: no rows, a missing column, a row of another length
[[nodiscard]] std::expected<TraceData, std::string> read_trace(std::string_view text);

/// Reads a trace of `tandem-client join --trace`; rows before the session begins are left out.
/// @return the samples, or the error
[[nodiscard]] std::expected<SeatSamples, std::string> read_samples(std::string_view text);

/// Replaces the server's samples of a seat by the client's own, interpolated to the rows of the trace. Hands and slave
/// then show the same moment on every network. Rows outside the samples become NaN.
void put_samples(const Column& t, const SeatSamples& own, SeatTrace& seat);

}  // namespace tandem::netsim::demo
