#include "netsim/system/silence_energy.h"

#include <algorithm>

namespace tandem::netsim {
namespace {

constexpr double kTankSlack = 1e-3;   // [J] that a hand pulling along overdraws within one step
constexpr double kStepMemory = 1;     // [s] in which the gate forgets a long step
constexpr double kLongerStep = 1.01;  // steps that differ by less count as equal, because clocks drift and round

}  // namespace

bool SilenceEnergy::wake_up(double step, const Bound& bound) noexcept {
  if (restarted_ || step > kLongerStep * longest_) unlimited_ = std::max(unlimited_, given_);
  restarted_ = false;
  const double acted = std::min(step, bound.step_max);
  longest_ = std::max(acted, longest_ - acted * longest_ / kStepMemory);
  return given_ <= std::max(bound.tank, unlimited_) + kTankSlack;
}

void SilenceEnergy::restart() noexcept {
  given_ = unlimited_ = 0;
  restarted_ = true;
}

}  // namespace tandem::netsim
