#include "hal/sim/integrated_plant.h"

#include <algorithm>
#include <cmath>

#include "hal/sim/plant_step.h"

namespace tandem::hal::sim {

static_assert(static_cast<int>(IntegratorKind::kExact) == static_cast<int>(control::Integrator::kExact));

template <class Dynamics>
void IntegratedPlant<Dynamics>::advance(const Vec3& tau, const HandPull& hand, double dt) noexcept {
  if (!(dt > 0)) return;
  constexpr double kMost = Dynamics::kPrismatic ? 1000.0 : 10.0;  // [N] or [N m]
  PlantDrive drive{.hand = hand, .length = std::min(dt, 1.0)};
  for (int i = 0; i < 3; ++i) drive.tau[i] = std::isfinite(tau[i]) ? std::clamp(tau[i], -kMost, kMost) : 0;
  environment_.setZero();
  hand_.setZero();
  if (numerics_.precision == PrecisionKind::kFloat) {
    advance_in<float>(drive);
  } else {
    advance_in<double>(drive);
  }
}

template <class Dynamics>
template <class S>
void IntegratedPlant<Dynamics>::advance_in(const PlantDrive& drive) noexcept {
  constexpr int kN = Dynamics::kJoints;
  using Vector = Eigen::Matrix<S, kN, 1>;
  const auto at = [&](const Vector& q, const Vector& v, S t) { return dynamics_.template forces<S>(q, v, drive, t); };
  const std::uint32_t n = std::max<std::uint32_t>(1, numerics_.substeps);
  const S h = static_cast<S>(drive.length / n);
  const auto how = static_cast<control::Integrator>(numerics_.integrator);
  const auto count = [&](const Forces<S, kN>& forces, double share) {
    environment_ += share * forces.environment.template cast<double>();
    hand_ += share * forces.hand.template cast<double>();
  };
  control::Motion<S, kN> motion{q_.template cast<S>(), v_.template cast<S>()};
  count(at(motion.x, motion.v, S(0)), 0.5 / n);
  for (std::uint32_t i = 0; i < n; ++i) {
    const control::Motion<S, kN> to = stepped<S, kN>(how, at, motion, static_cast<S>(i) * h, h);
    Q q = to.x.template cast<double>(), v = to.v.template cast<double>();
    if (!q.allFinite() || !v.allFinite()) {
      q = motion.x.template cast<double>();
      v.setZero();
    }
    dynamics_.limit(q, v);
    motion = {q.template cast<S>(), v.template cast<S>()};
    // The forces reported are means of the trapezoids between the ends of the steps.
    count(at(motion.x, motion.v, static_cast<S>(i + 1) * h), (i + 1 == n ? 0.5 : 1.0) / n);
  }
  q_ = motion.x.template cast<double>();
  v_ = motion.v.template cast<double>();
}

template class IntegratedPlant<LinearDynamics>;
template class IntegratedPlant<TouchDynamics>;

}  // namespace tandem::hal::sim
