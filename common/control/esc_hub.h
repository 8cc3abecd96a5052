#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <functional>

#include "common/base/axes.h"
#include "common/control/authority.h"
#include "common/control/channel.h"
#include "common/control/flow_sources.h"
#include "common/control/pull.h"
#include "common/control/virtual_tool.h"

namespace tandem::control {

/// Coupling of one seat to one tool during a tick. All values are in [0, 1].
struct Coupling {
  double alpha = 0;   ///< A_ji: authority. A SLAVE seat has 1 over its own tool
  double follow = 0;  ///< C_ji: share of the tool's motion in the seat's target
  double share = 0;   ///< max(alpha, follow): share of the seat's spring
};

/// Port of one tool at the hub, as of the tool's last step. Per axis of the port.
struct ToolPort {
  AxisArray x{};              ///< position [m or rad]
  AxisArray v{};              ///< flow v_rs [m/s or rad/s]
  AxisArray moved{};          ///< motion [m or rad]
  AxisArray dissipated{};     ///< dissipated energy [J]
  AxisArray surface_force{};  ///< force of the surfaces on the tool [N]; 0 where a device meets the surfaces

  /// Returns the target of a SLAVE seat's device on a spring of stiffness k: beyond the tool by the surface force over
  /// k. So the device presses with the force that the hands feel.
  [[nodiscard]] double slave_goal(std::size_t axis, double k) const noexcept {
    return x[axis] - (k > 0 ? surface_force[axis] / k : 0);
  }
};

/// Where the near end of a seat's spring is attached, per axis of the port.
struct NearEnd {
  bool engaged = false;    ///< false: the near end rests, with zero elongation
  AxisArray x{};           ///< position of the tool; a weighted mean where one end serves several tools
  AxisArray offset{};      ///< hand minus tool, subtracted from received positions
  AxisArray dissipated{};  ///< energy dissipated at the tools that this seat may spend [J]
  double weight = 0;       ///< number of such springs that a motion loads
  double heat_share = 1;   ///< share of the dissipated energy that is passed on to the client if it is not needed here
};

/// The hub of Energy Shared Control: the power-conserving interconnection of n masters and m tools, with the modulated
/// flow sources of each tool. Each session has one; `server::SharedControl` calls it. F_ri and v_ri are effort and flow
/// at the port of master i, F_rs,j and v_rs,j those at the port of tool j. Per axis:
///
///     F_rs,j = - sum_i A_ji F_ri          v_ri = sum_j [A_ji + g_ji (C_ji - A_ji)] v_rs,j
///     P_inj  = sum of all port powers = sum_ij g_ji (C_ji - A_ji) F_ri v_rs,j
///
/// For n = 2, m = 1 these are eq. 1-2 of [Licona et al., ICVARS 2019]. There every beta multiplies a term that alpha
/// already multiplies, and cancels. Eq. 3-4 give the observer E_p and the gate g (`FlowSources`).
///
/// F_ri is the effort of the seat's spring on its IPC. The springs act on the tool at the end of its step, therefore
/// F_rs,j is a `Pull` of springs A_ji k_i at p_i. Flows are positions wherever no gate cuts them, so that no target
/// drifts: y_i = sum_j C_ji x_j. The hub grants energy in place of power: it asks the flow sources for the part that
/// the authority of a seat does not pay for.
///
/// Seats below `masters` are masters, the others SLAVE seats. Indices are in range. Real-time safe.
class EscHub {
 public:
  /// Parameters of a hub.
  struct Params {
    std::size_t axes = 3;                        ///< of the port, 1 to kAxesMax
    std::size_t masters = 1;                     ///< 1 to kMastersMax
    std::size_t tools = 1;                       ///< 1 to kToolsMax
    FlowSourceMode mfs = FlowSourceMode::kOpen;  ///< modulation of the flow sources
    double tank = 0.05;                          ///< initial level of the flow sources' tank of each tool [J]
    double eta = 0.9;                            ///< share of the dissipated energy that may be spent [0, 1]
    double b_rel = 14;                           ///< damping relative to the hands' motion [N s/m at the tip]
    double dt = 0.001;                           ///< duration of a tick [s]
  };
  /// Efforts on a tool, per axis.
  using Efforts = std::array<Pull, kAxesMax>;

  /// Starts without authority. @param params  within their ranges
  explicit EscHub(const Params& params) noexcept;

  /// Sets C_ji of a master.
  void set_follow(std::size_t master, std::size_t tool, double follow) noexcept;
  /// Couples a SLAVE seat fully to its own tool.
  void couple_slave(std::size_t seat, std::size_t tool) noexcept;
  /// Takes over A_ji of all masters over a tool; called once per tick.
  /// @param tool    number of the tool
  /// @param alpha   authority of each master [0, 1]
  /// @param braked  no present seat has authority over the tool
  void set_authority(std::size_t tool, const MasterArray& alpha, bool braked) noexcept TANDEM_REALTIME {
    braked_[tool] = braked;
    any_braked_ = std::ranges::any_of(braked_, std::identity{});
    alone_[tool] = true;
    for (std::size_t i = 0; i < p_.masters; ++i) {
      Coupling& c = couplings_[i][tool];
      c.alpha = alpha[i];
      c.share = std::max(c.alpha, c.follow);
      alone_[tool] &= c.follow == c.alpha && (c.alpha == 0 || c.alpha >= 1);
    }
  }
  /// Takes over the port of a tool, after each of its steps and when it is placed.
  void set_tool(std::size_t tool, const ToolPort& port) noexcept TANDEM_REALTIME {
    ToolPort& own = tools_[tool];
    each_axis(p_.axes, [&](std::size_t a) {
      own.x[a] = port.x[a];
      own.v[a] = port.v[a];
      own.moved[a] = port.moved[a];
      own.dissipated[a] = port.dissipated[a];
      own.surface_force[a] = port.surface_force[a];
    });
  }

  /// Returns the weights of a seat at a tool.
  [[nodiscard]] const Coupling& coupling(std::size_t seat, std::size_t tool) const noexcept {
    return couplings_[seat][tool];
  }
  /// Returns the port of a tool.
  [[nodiscard]] const ToolPort& tool(std::size_t j) const noexcept { return tools_[j]; }
  /// Returns the flow sources of a tool.
  [[nodiscard]] const FlowSources& sources(std::size_t tool) const noexcept { return sources_[tool]; }
  /// Returns the parameters.
  [[nodiscard]] const Params& params() const noexcept { return p_; }
  /// Target y_i of a seat: the position that its reference follows. @pre `step_target` was called for the seat
  [[nodiscard]] const AxisArray& target(std::size_t seat) const noexcept { return targets_[seat]; }
  /// First tool that the seat follows; 0 if it follows none.
  [[nodiscard]] std::size_t first_tool(std::size_t seat) const noexcept { return first_tools_[seat]; }
  /// Authority of a master over the first tool that it follows with authority above 0; 0 if there is none.
  [[nodiscard]] double authority(std::size_t master) const noexcept;
  /// No present seat has authority over this tool.
  [[nodiscard]] bool braked(std::size_t tool) const noexcept { return braked_[tool]; }
  /// A tool to which this master is coupled is braked.
  [[nodiscard]] bool meets_brake(std::size_t master) const noexcept { return any_braked_ && coupled_to_brake(master); }
  /// The master has authority over at least one tool.
  [[nodiscard]] bool has_authority(std::size_t master) const noexcept;

  /// Finds the near end of the spring of a seat whose one spring serves all its tools.
  /// @param seat  number of the seat
  /// @param k     stiffness of the spring
  /// @param near  result, for the axes in use; `engaged` and `offset` stay as they are
  void find_near_end(std::size_t seat, const AxisArray& k, NearEnd& near) const noexcept TANDEM_REALTIME;
  /// Credits the energy that the tools really paid when the seat's spring moved, as alpha_i dE. The hub asks the flow
  /// sources for the rest.
  /// @param seat         number of the seat
  /// @param before       reference before the move
  /// @param offset_step  change of the seat's re-engage offset in this tick
  /// @param end          the seat's end, already moved
  void settle(std::size_t seat, const AxisArray& before, const AxisArray& offset_step,
              ChannelEnd& end) noexcept TANDEM_REALTIME;

  /// Eq. 1: adds the effort of a master on a tool.
  /// @param master  number of the master
  /// @param tool    number of the tool
  /// @param end     the master's end at this tool, already moved
  /// @param body    limits the relative damping at surfaces; null: it acts in full
  /// @param out     sum of efforts on the tool
  void add_effort(std::size_t master, std::size_t tool, const EndState& end, const VirtualTool* body,
                  Efforts& out) const noexcept TANDEM_REALTIME;
  /// Adds the given share of the spring of a SLAVE seat.
  void add_slave_effort(double share, const EndState& end, Efforts& out) const noexcept TANDEM_REALTIME {
    for (std::size_t a = 0; a < p_.axes; ++a) {
      out[a].spring(share * end.k[a], end.ref[a]);
      out[a].damper(share * end.b[a], end.rate[a]);
    }
  }
  /// The sources of a tool keep half of its dissipated energy, within `eta`; mode kTank only.
  void fill_tank(std::size_t tool) noexcept TANDEM_REALTIME {
    if (p_.mfs != FlowSourceMode::kTank) return;
    for (std::size_t a = 0; a < p_.axes; ++a) sources_[tool].fill(0.5 * p_.eta * tools_[tool].dissipated[a]);
  }

  /// At most one hand follows this tool, and it has full authority: the flow sources of the tool give nothing.
  [[nodiscard]] bool alone(std::size_t tool) const noexcept { return alone_[tool]; }
  /// Eq. 3: adds the energy that the sources of a tool gave to a master during the tool's last step, per axis [J].
  /// @param master    number of the master
  /// @param tool      number of the tool
  /// @param effort    -F_ri, as the client sends it
  /// @param injected  sum over the masters so far
  void add_injected(std::size_t master, std::size_t tool, const AxisArray& effort,
                    AxisArray& injected) const noexcept TANDEM_REALTIME {
    const Coupling& c = couplings_[master][tool];
    const double unpaid = c.follow - c.alpha;
    each_axis(p_.axes, [&](std::size_t a) { injected[a] -= unpaid * effort[a] * tools_[tool].moved[a]; });
  }
  /// Eq. 3: integrates the observer of a tool.
  /// @param tool      number of the tool
  /// @param injected  sum of `add_injected` over the present masters
  void observe(std::size_t tool, const AxisArray& injected) noexcept TANDEM_REALTIME {
    each_axis(p_.axes, [&](std::size_t a) { sources_[tool].observe(a, injected[a] / p_.dt, p_.dt); });
  }
  /// Law `replica`: asks the flow sources for the energy that the other hands' motion adds beyond this hand's own
  /// authority, along the tool's path.
  /// @param master      number of the master
  /// @param tool        number of the tool
  /// @param hand        newest position of the hand at this tool
  /// @param effort_max  largest pull of the seat's motor [N]
  /// @param end         the seat's end at this tool
  void grant_following(std::size_t master, std::size_t tool, const AxisArray& hand, double effort_max,
                       ChannelEnd& end) noexcept TANDEM_REALTIME;
  /// Eq. 2 and 4: moves the target y_i of a seat. Gates act on it as increments g v_rs dt; without a gate the target is
  /// absolute and cannot drift.
  /// @param seat     number of the seat
  /// @param present  false: the target is absolute, whatever the gates
  /// @param k        stiffness of the seat's spring
  /// @return flow v_ri
  AxisArray step_target(std::size_t seat, bool present, const AxisArray& k) noexcept TANDEM_REALTIME;

  /// Tool motion [s] added to a follower's newest sample (`grant_following`). The server knows the hand's lag from that
  /// sample, the client from the age of its data. Clock drift (200 ppm, and 10 s until the client corrects it) and the
  /// hand's filters make the client's value larger. Without this margin a follower's account ran dry within 5 s at
  /// 1000 ppm.
  static constexpr double kAgeMargin = 0.015;

 private:
  void find_first_tool(std::size_t seat) noexcept;
  [[nodiscard]] bool coupled_to_brake(std::size_t master) const noexcept;

  Params p_;
  std::array<std::array<Coupling, kToolsMax>, kSeatsMax> couplings_{};
  std::array<FlowSources, kToolsMax> sources_;
  std::array<ToolPort, kToolsMax> tools_{};
  std::array<bool, kToolsMax> braked_{};
  bool any_braked_ = false;
  std::array<bool, kToolsMax> alone_{};  ///< as of the last `set_authority`
  std::array<AxisArray, kSeatsMax> targets_{};
  std::array<std::size_t, kSeatsMax> first_tools_{};  ///< as of the last `set_follow` or `couple_slave`
};

}  // namespace tandem::control
