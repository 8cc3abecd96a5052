#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <limits>

#include "common/control/integrator.h"
#include "hal/sim/plant_dynamics.h"

/// One step of a body with N coordinates by a chosen integrator:
///
///     M(q) v' = f(q, v, t),    q' = v
///
/// The equations are those of common/control/integrator.h. The implicit ones are solved by Newton's method, whose
/// matrix has the springs and dampers only; one round is exact for a linear body. With friction, whose damper is a
/// secant, it converges linearly, slowly near rest at steps of 10 ms. Every function is total: for a
/// singular or infinite body the result is not finite. No function uses the heap.
namespace tandem::hal::sim {

/// Rounds of Newton's method, at most. A body that touches and leaves a surface in turns does not converge; its step
/// ends with the last round.
inline constexpr int kNewtonRounds = 20;

namespace plant_step {

template <class S, int N>
using Vector = Eigen::Matrix<S, N, 1>;
template <class S, int N>
using Matrix = Eigen::Matrix<S, N, N>;

template <class S, int N>
[[nodiscard]] Vector<S, N> acceleration(const Forces<S, N>& forces) noexcept {
  return control::integrator::solved<S, N>(forces.m, forces.f);
}

/// Solves M (w - v) = part f(q + part w, w, t + part) for the velocity w.
template <class S, int N, class At>
[[nodiscard]] Vector<S, N> implicit_velocity(const At& at, const control::Motion<S, N>& from, S t, S part) noexcept {
  Vector<S, N> w = from.v;
  for (int round = 0; round < kNewtonRounds; ++round) {
    const Forces<S, N> now = at(Vector<S, N>(from.x + part * w), w, t + part);
    const Vector<S, N> residual = part * now.f - now.m * (w - from.v);
    const Vector<S, N> change =
        control::integrator::solved<S, N>(Matrix<S, N>(now.m + part * now.b + part * part * now.k), residual);
    w += change;
    const S scale = w.cwiseAbs().maxCoeff() + std::numeric_limits<S>::min();
    if (!(change.cwiseAbs().maxCoeff() > 4 * std::numeric_limits<S>::epsilon() * scale)) break;
  }
  return w;
}

template <class S, int N, class At>
[[nodiscard]] control::Motion<S, N> rk4(const At& at, const control::Motion<S, N>& from, S t, S h) noexcept {
  const S half = h / 2, sixth = h / 6;
  const auto rate = [&](const control::Motion<S, N>& state, S when) {
    return control::Motion<S, N>{state.v, acceleration<S, N>(at(state.x, state.v, when))};
  };
  const auto ahead = [&](const control::Motion<S, N>& slope, S step) {
    return control::Motion<S, N>{from.x + step * slope.x, from.v + step * slope.v};
  };
  const control::Motion<S, N> k1 = rate(from, t), k2 = rate(ahead(k1, half), t + half);
  const control::Motion<S, N> k3 = rate(ahead(k2, half), t + half), k4 = rate(ahead(k3, h), t + h);
  return {from.x + sixth * (k1.x + S(2) * (k2.x + k3.x) + k4.x), from.v + sixth * (k1.v + S(2) * (k2.v + k3.v) + k4.v)};
}

/// Advances the body as it is at the start, with the hand at the middle of the step, by the matrix exponential. With
/// M = L L^T the coordinates z = L^T (q - q0) have the inertia 1.
template <class S, int N, class At>
[[nodiscard]] control::Motion<S, N> exact(const At& at, const control::Motion<S, N>& from, S t, S h) noexcept {
  const Forces<S, N> now = at(from.x, from.v, t + h / 2);
  const Eigen::LLT<Matrix<S, N>> root(now.m);
  const auto lower = root.matrixL();
  const Matrix<S, N> half_k = lower.solve(now.k), half_b = lower.solve(now.b);
  control::LinearBody<S, N> body;
  body.m = 1;
  body.k = lower.solve(Matrix<S, N>(half_k.transpose()));
  body.b = lower.solve(Matrix<S, N>(half_b.transpose()));
  body.f = lower.solve(Vector<S, N>(now.f + now.b * from.v));
  control::Motion<S, N> z;
  z.v = root.matrixU() * from.v;
  const control::Motion<S, N> to = control::integrator::exact<S, N>(body, z, h);
  return {from.x + root.matrixU().solve(to.x), root.matrixU().solve(to.v)};
}

}  // namespace plant_step

/// Returns the motion after one step of length `h` [s] that begins at time `t` [s].
/// @param at  (q, v, t) -> Forces<S, N>
template <class S, int N, class At>
[[nodiscard]] control::Motion<S, N> stepped(control::Integrator how, const At& at, const control::Motion<S, N>& from,
                                            S t, S h) noexcept {
  control::Motion<S, N> to;
  switch (how) {
    case control::Integrator::kImplicitEuler:
      to.v = plant_step::implicit_velocity<S, N>(at, from, t, h);
      to.x = from.x + h * to.v;
      return to;
    case control::Integrator::kImplicitMidpoint: {
      const Eigen::Matrix<S, N, 1> middle = plant_step::implicit_velocity<S, N>(at, from, t, h / 2);
      to.v = S(2) * middle - from.v;
      to.x = from.x + h * middle;
      return to;
    }
    case control::Integrator::kSemiImplicitEuler:
      to.v = from.v + h * plant_step::acceleration<S, N>(at(from.x, from.v, t));
      to.x = from.x + h * to.v;
      return to;
    case control::Integrator::kRk4:
      return plant_step::rk4<S, N>(at, from, t, h);
    case control::Integrator::kExact:
      return plant_step::exact<S, N>(at, from, t, h);
  }
  return from;
}

}  // namespace tandem::hal::sim
