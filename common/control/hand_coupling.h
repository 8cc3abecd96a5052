#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "common/base/axes.h"

/// Couplings between the hands of one tool, for comparison with Energy Shared Control. A coupling decides the target of
/// each hand's spring from what the server has heard of all hands, and of the tool. The tool is pulled by the hands'
/// springs, weighted with their authority, under every coupling.
namespace tandem::control {

/// The couplings that users select by name.
enum class HandCoupling : std::uint8_t {
  kEsc,              ///< Energy Shared Control [Licona et al., ICVARS 2019], computed by `EscHub`: the default
  kClc,              ///< complementary linear combination [Khademian & Hashtrudi-Zaad, T-Mech 17(2) 2012]
  kMcet,             ///< masters correspond with environment transfer [the same]
  kNudehi,           ///< disagreement scaled by authority [Nudehi, Mukherjee, Ghodoussi, T-CST 13(3) 2005]
  kNpdSaturated,     ///< nonlinear proportional, saturated, plus damping [after Zakerimanesh et al. 2017]
  kPdVariableDelay,  ///< P+d with dominance weights and bounded delay rate [after Ghorbanian et al. 2013]
  kPdPeer,           ///< PD between all pairs of hands, no authority
  kAveragePosition,  ///< all hands follow the average of all hands [Rakhsha & Constantinescu, ICRA 2007]
};
/// Number of couplings.
inline constexpr std::size_t kHandCouplings = 8;

/// A row of the list of couplings.
struct HandCouplingRow {
  std::string_view name;     ///< name that users type
  std::string_view summary;  ///< one line for help texts
  std::size_t hands_max;     ///< 2 where the equations are those of two hands
};
/// Returns the row of a coupling.
[[nodiscard]] const HandCouplingRow& row_of(HandCoupling coupling) noexcept;

/// One hand as the server has heard of it, or the tool. Per axis of the port.
struct CoupledBody {
  AxisArray x{};  ///< position [m or rad]
  AxisArray v{};  ///< velocity [m/s or rad/s]
  AxisArray
      f{};  ///< a hand: the effort with which it pulls its spring; the tool: that of its surroundings on it [N or N m]
  double alpha = 0;  ///< authority of a hand [0, 1]
};

/// Where the spring of a hand is led to, per axis.
struct CoupledTarget {
  AxisArray x{};  ///< [m or rad]
  AxisArray v{};  ///< [m/s or rad/s]
};

/// Numbers that a coupling needs beside the bodies.
struct HandCouplingParams {
  std::size_t axes = 3;    ///< of the port
  double k = 1000;         ///< stiffness of the hands' springs [N/m or N m/rad]
  double saturation = 10;  ///< N of `npd_saturated`: largest force of one of its springs [N or N m]
  double v_app = 0.1;      ///< `pd_variable_delay`: approach speed beside the motion of the bodies [m/s or rad/s]
  double dt = 0.001;       ///< duration of a tick [s]
};

/// Returns the target of hand i. With a = authority of hand 1, F_e = effort of the surroundings on the tool, F_h = a
/// hand's effort, s = the tool, P(e) = N tanh(k e / N), n hands:
///
///     clc                x_1d = 1/2 [a x_s + (1 - a) x_2] + 1/2 [x_1 + (a F_e + (1 - a) F_h2) / k]
///     mcet               x_1d = 1/2 x_2 + 1/2 [x_1 + F_e / k]
///     nudehi             x_1d = x_1 - (1 - a) (x_1 - x_2)
///     npd_saturated      x_1d = x_1 + [a P(x_s - x_1) + (1 - a) P(x_2 - x_1)] / k
///     pd_variable_delay  x_1d = a x_s + (1 - a) x_2, moved at most (1 + rho) times as fast as the bodies, rho = 0.5
///     pd_peer            x_id = sum over j != i of x_j / (n - 1), the spring n - 1 times as stiff
///     average_position   x_id = sum over all j of x_j / n
///
/// and the same for hand 2 with 1 <-> 2, a <-> 1 - a. `clc` and `mcet` have four channels, here halves of position and
/// force: in still contact both say the same, so a hand feels F_e once. The law of Ghorbanian et al. is not public; its
/// idea is used, dominance weights and a bound on the delay's rate.
/// @param coupling  not kEsc
/// @param hands     all present hands; two where the row says so: a missing second hand counts as the tool
/// @param i         index in `hands`
/// @param last      target of this hand one tick before
[[nodiscard]] CoupledTarget coupled_target(HandCoupling coupling, const HandCouplingParams& params,
                                           std::span<const CoupledBody> hands, std::size_t i, const CoupledBody& tool,
                                           const CoupledTarget& last) noexcept TANDEM_REALTIME;

}  // namespace tandem::control
