#pragma once

#include <array>
#include <cstddef>

#include "common/base/axes.h"

/// Dirac structure of Energy Shared Control for n masters and m slaves, one axis (design notes, control 2):
///
///     F_rs,j = - sum_i A_ji F_ri          v_ri = sum_j [A_ji + g_ji (C_ji - A_ji)] v_rs,j
///     P_inj  = sum of all port powers = sum_ij g_ji (C_ji - A_ji) F_ri v_rs,j
///
/// For n = 2, m = 1 these are eq. 1-2 of [Licona et al., ICVARS 2019]. There every beta multiplies a term that alpha
/// already multiplies, and cancels.
namespace tandem::control {

/// Returns the share of tool j's flow that master i's reference follows. With the flow source cut (g = 0) it is the
/// authority alone; with the source open (g = 1) it is the full following share.
[[nodiscard]] constexpr double following_share(double authority, double following, double gate) noexcept {
  return authority + gate * (following - authority);
}

/// Efforts and flows that the hub computes for one axis.
template <std::size_t Masters, std::size_t Tools>
struct HubPorts {
  std::array<double, Masters> flow{};  ///< v_ri, from the hub to master i
  std::array<double, Tools> effort{};  ///< F_rs,j on tool j
  double injected = 0;                 ///< power of the modulated flow sources [W]
};

/// Reference formula of the hub.
/// @param A, C, g  authority, following share and gate, indexed [tool][master]. @param v_rs  flow of each tool. @param
/// F_r  effort of each master's spring on its IPC.
template <std::size_t Masters, std::size_t Tools>
[[nodiscard]] constexpr HubPorts<Masters, Tools> hub(const std::array<std::array<double, Masters>, Tools>& A,
                                                     const std::array<std::array<double, Masters>, Tools>& C,
                                                     const std::array<std::array<double, Masters>, Tools>& g,
                                                     const std::array<double, Tools>& v_rs,
                                                     const std::array<double, Masters>& F_r) noexcept {
  HubPorts<Masters, Tools> out;
  for (std::size_t j = 0; j < Tools; ++j) {
    for (std::size_t i = 0; i < Masters; ++i) {
      out.effort[j] -= A[j][i] * F_r[i];
      out.flow[i] += following_share(A[j][i], C[j][i], g[j][i]) * v_rs[j];
      out.injected += g[j][i] * (C[j][i] - A[j][i]) * F_r[i] * v_rs[j];
    }
  }
  return out;
}

}  // namespace tandem::control
