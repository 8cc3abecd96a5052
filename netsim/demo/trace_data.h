#pragma once

#include <array>
#include <expected>
#include <string>
#include <string_view>
#include <vector>

/// The trace of one run, as columns of numbers. Pure: text in, numbers out.
namespace tandem::netsim::demo {

using Column = std::vector<double>;
using Column3 = std::array<Column, 3>;

/// One person's hand.
struct SeatTrace {
  Column alpha;    ///< [1]
  Column3 q;       ///< joints [rad]
  Column3 x;       ///< tip, HAL frame: x right, y away, z up [m]
  Column3 f_cmd;   ///< force asked of the device, on the hand [N]
  Column3 f_out;   ///< force the device gave, on the hand [N]
  Column3 torque;  ///< J^T f_cmd [N m]; filled by app/joint_torques.h
};
/// The slave and the tool it carries.
struct ToolTrace {
  Column3 q;       ///< joints [rad]
  Column3 x;       ///< tip [m]
  Column3 f_cmd;   ///< force asked of the slave device [N]
  Column3 f_env;   ///< force of the environment on the slave [N]
  Column3 e_p;     ///< E_p of [Licona et al. 2019] eq. 3, per axis of the port [J]
  Column3 torque;  ///< J^T f_cmd [N m]; filled by app/joint_torques.h
};
/// What a workstation itself wrote of its hand, one row per servo tick: nothing lost, nothing late.
struct SeatSamples {
  Column t;                    ///< session time [s], as the workstation knows it
  Column3 q, x, f_cmd, f_out;  ///< as in SeatTrace
};
struct TraceData {
  Column t;  ///< since the session began [s]
  SeatTrace trainer, trainee;
  ToolTrace tool;
  SeatSamples trainer_own, trainee_own;  ///< empty in virtual time, where the trace is as good
  [[nodiscard]] std::size_t rows() const noexcept { return t.size(); }
};

/// Reads a trace of server/trace_csv.h with the seats `trainer` and `trainee`, the tool `tool` and three axes. Columns
/// the demo has no use for are not looked at; a cell that is no finite number becomes NaN.
/// @return the columns; or what is wrong: no rows, a column missing, a row of another length
[[nodiscard]] std::expected<TraceData, std::string> read_trace(std::string_view text);

/// Reads a trace of `tandem-client join --trace`; rows before the session began are left out.
/// @return the samples, or what is wrong
[[nodiscard]] std::expected<SeatSamples, std::string> read_samples(std::string_view text);

/// Puts a workstation's own samples in the place of what the server heard of that seat: interpolated to the rows of the
/// trace, so that hands and slave show the same moment whatever the network did. Rows beyond the samples become NaN.
void put_samples(const Column& t, const SeatSamples& own, SeatTrace& seat);

}  // namespace tandem::netsim::demo
