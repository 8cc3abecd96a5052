#include "common/control/silence_tank.h"

#include <algorithm>
#include <cmath>

namespace tandem::control {

namespace {
constexpr double kPaceMemory = 1;  // [s] in which a long step is forgotten

double size_for(double mass) noexcept { return 1e-3 * std::min(100.0, std::max(20.0, 180.0 * mass)); }
}  // namespace

SilenceTank::SilenceTank(const Params& params) noexcept : p_(params), size_(params.share * size_for(params.mass)) {}

void SilenceTank::measure(const AxisArray& effort, const AxisArray& q, bool absorbed) noexcept {
  double given = 0;
  for (std::size_t a = 0; a < p_.dof; ++a) {
    if (!std::isfinite(q[a])) return;
    given += effort[a] * (q[a] - q_[a]);
  }
  if (!absorbed) given = std::max(0.0, given);
  if (std::isfinite(given)) given_ += given;
  for (std::size_t a = 0; a < p_.dof; ++a) moved_[a] = q[a] - q_[a];
  q_ = q;
}

void SilenceTank::set_pace(double step) noexcept { pace_ = std::max(step, pace_ - step * pace_ / kPaceMemory); }

void SilenceTank::note_loss() noexcept { given_max_ = std::max(given_max_, given_); }

/// Braking is free: effort against the motion takes energy out of the hand. A device's velocity lags: for a hand that
/// shakes at 12 Hz, effort along its motion looks like braking half of the time. Therefore the displacement of the last
/// tick must also show braking. The longest recent step is used for dt, because in an irregularly scheduled program an
/// effort may act for longer than the last step.
bool SilenceTank::allows(const AxisArray& f, const AxisArray& velocity) const noexcept {
  const double dt = std::max(1e-3, pace_);
  double force2 = 0, speed2 = 0, power = 0, work = 0;
  for (std::size_t a = 0; a < p_.dof; ++a) {
    const double v = std::isfinite(velocity[a]) ? velocity[a] : 0;
    force2 += f[a] * f[a] / p_.scale[a];
    speed2 += v * v * p_.scale[a];
    power += f[a] * v;
    work += f[a] * moved_[a];
  }
  const double force = std::sqrt(force2);
  const double next = force * (std::sqrt(speed2) + force * dt / p_.mass) * dt;
  const bool braking = power < 0 && work <= 0 && -power * dt >= force2 * dt * dt / p_.mass;
  return braking || !(next > size_ - given_);
}

}  // namespace tandem::control
