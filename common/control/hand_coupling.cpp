#include "common/control/hand_coupling.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace tandem::control {

namespace {

constexpr std::size_t kAnyNumber = kMastersMax;
constexpr std::array<HandCouplingRow, kHandCouplings> kCouplings{{
    {"esc", "Energy Shared Control", kAnyNumber},
    {"clc", "complementary linear combination of the other hand and the tool", 2},
    {"mcet", "hands follow each other and feel the tool's surroundings", 2},
    {"nudehi", "each hand feels the disagreement, scaled by the other's authority", 2},
    {"npd_saturated", "saturated springs to the tool and the other hand", 2},
    {"pd_variable_delay", "springs to the tool and the other hand, bounded delay rate", 2},
    {"pd_peer", "one spring between each pair of hands", kAnyNumber},
    {"average_position", "all hands follow the average of all hands", kAnyNumber},
}};

constexpr double kDelayRate = 0.5;  ///< rho: bound of |dd/dt|

double saturated(double k, double limit, double e) noexcept { return limit * std::tanh(k * e / limit); }

}  // namespace

const HandCouplingRow& row_of(HandCoupling coupling) noexcept { return kCouplings[static_cast<std::size_t>(coupling)]; }

CoupledTarget coupled_target(HandCoupling coupling, const HandCouplingParams& p, std::span<const CoupledBody> hands,
                             std::size_t i, const CoupledBody& tool, const CoupledTarget& last) noexcept {
  const CoupledBody& own = hands[i];
  const CoupledBody& other = hands.size() < 2 ? tool : hands[i == 0 ? 1 : 0];
  const double a = own.alpha, n = static_cast<double>(hands.size());
  CoupledTarget target;
  for (std::size_t k = 0; k < p.axes; ++k) {
    const double x_mix = a * tool.x[k] + (1 - a) * other.x[k], v_mix = a * tool.v[k] + (1 - a) * other.v[k];
    double& x = target.x[k];
    double& v = target.v[k];
    switch (coupling) {
      case HandCoupling::kEsc:
        x = tool.x[k];
        v = tool.v[k];
        break;
      case HandCoupling::kClc:
        x = 0.5 * (x_mix + own.x[k] + (a * tool.f[k] + (1 - a) * other.f[k]) / p.k);
        v = v_mix;
        break;
      case HandCoupling::kMcet:
        x = 0.5 * (other.x[k] + own.x[k] + tool.f[k] / p.k);
        v = other.v[k];
        break;
      case HandCoupling::kNudehi:
        x = a * own.x[k] + (1 - a) * other.x[k];
        v = a * own.v[k] + (1 - a) * other.v[k];
        break;
      case HandCoupling::kNpdSaturated:
        x = own.x[k] + (a * saturated(p.k, p.saturation, tool.x[k] - own.x[k]) +
                        (1 - a) * saturated(p.k, p.saturation, other.x[k] - own.x[k])) /
                           p.k;
        v = v_mix;
        break;
      case HandCoupling::kPdVariableDelay: {
        const double speed = a * std::abs(tool.v[k]) + (1 - a) * std::abs(other.v[k]);
        const double step = ((1 + kDelayRate) * speed + p.v_app) * p.dt;
        x = std::clamp(x_mix, last.x[k] - step, last.x[k] + step);
        v = v_mix;
        break;
      }
      case HandCoupling::kPdPeer:
      case HandCoupling::kAveragePosition: {
        double x_sum = 0, v_sum = 0;
        for (const CoupledBody& hand : hands) {
          x_sum += hand.x[k];
          v_sum += hand.v[k];
        }
        if (coupling == HandCoupling::kAveragePosition) {
          x = x_sum / n;
          v = v_sum / n;
        } else if (hands.size() < 2) {
          x = own.x[k];  // alone: no spring pulls
          v = own.v[k];
        } else {
          x = (x_sum - own.x[k]) / (n - 1);
          v = (v_sum - own.v[k]) / (n - 1);
        }
        break;
      }
    }
  }
  return target;
}

}  // namespace tandem::control
