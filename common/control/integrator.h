#pragma once

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <cmath>
#include <limits>
#include <unsupported/Eigen/MatrixFunctions>

#include "common/control/numerics.h"

/// One step of a mass on springs and dampers:
///
///     m v' = f - K x - B v,    x' = v
///
/// f, K and B are constant within the step; N is the number of axes, S the type of all numbers. With h the length of
/// the step:
///
/// | integrator | step | order |
/// |---|---|---|
/// | implicit Euler | (m + h B + h^2 K) v+ = m v + h (f - K x), x+ = x + h v+ | 1 |
/// | implicit midpoint | (m + h B / 2 + h^2 K / 4) w = m v + h (f - K x) / 2, v+ = 2 w - v, x+ = x + h w | 2 |
/// | semi-implicit Euler | m v+ = m v + h (f - K x - B v), x+ = x + h v+ | 1 |
/// | RK4 | the classical method of four stages | 4 |
/// | exact | matrix exponential of the step, the force held (zero-order hold) | - |
///
/// Sources: Hairer, Lubich, Wanner, "Geometric Numerical Integration", 2006, I.1 and VI.3; Van Loan, IEEE TAC 23(3)
/// 1978, for the augmented matrix of the zero-order hold. No function uses the heap. For input that is not finite the
/// result is not finite.
namespace tandem::control {

/// A mass with its springs and dampers.
template <class S, int N>
struct LinearBody {
  using Vector = Eigen::Matrix<S, N, 1>;
  using Matrix = Eigen::Matrix<S, N, N>;
  S m = 1;                    ///< [kg], above 0
  Matrix k = Matrix::Zero();  ///< [N/m], symmetric, not negative
  Matrix b = Matrix::Zero();  ///< [N s/m], symmetric, not negative
  Vector f = Vector::Zero();  ///< force at x = 0 and v = 0 [N]
};
/// Position [m] and velocity [m/s].
template <class S, int N>
struct Motion {
  Eigen::Matrix<S, N, 1> x = Eigen::Matrix<S, N, 1>::Zero();
  Eigen::Matrix<S, N, 1> v = Eigen::Matrix<S, N, 1>::Zero();
};

namespace integrator {

/// Returns the solution of a symmetric, positive definite system.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> solved(const Eigen::Matrix<S, N, N>& matrix,
                                            const Eigen::Matrix<S, N, 1>& rhs) noexcept {
  if constexpr (N == 1) {
    return rhs / matrix(0, 0);
  } else {
    return matrix.llt().solve(rhs);
  }
}

/// Returns m + h1 B + h2 K.
template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, N> inertia(const LinearBody<S, N>& body, S h1, S h2) noexcept {
  Eigen::Matrix<S, N, N> sum = h1 * body.b + h2 * body.k;
  sum.diagonal().array() += body.m;
  return sum;
}

template <class S, int N>
[[nodiscard]] Motion<S, N> implicit_euler(const LinearBody<S, N>& body, const Motion<S, N>& at, S h) noexcept {
  Motion<S, N> to;
  to.v = solved<S, N>(inertia<S, N>(body, h, h * h), body.m * at.v + h * (body.f - body.k * at.x));
  to.x = at.x + h * to.v;
  return to;
}

template <class S, int N>
[[nodiscard]] Motion<S, N> implicit_midpoint(const LinearBody<S, N>& body, const Motion<S, N>& at, S h) noexcept {
  const S half = h / 2;
  const Eigen::Matrix<S, N, 1> middle =
      solved<S, N>(inertia<S, N>(body, half, half * half), body.m * at.v + half * (body.f - body.k * at.x));
  return {at.x + h * middle, S(2) * middle - at.v};
}

template <class S, int N>
[[nodiscard]] Eigen::Matrix<S, N, 1> acceleration(const LinearBody<S, N>& body, const Motion<S, N>& at) noexcept {
  return (body.f - body.k * at.x - body.b * at.v) / body.m;
}

template <class S, int N>
[[nodiscard]] Motion<S, N> semi_implicit_euler(const LinearBody<S, N>& body, const Motion<S, N>& at, S h) noexcept {
  Motion<S, N> to;
  to.v = at.v + h * acceleration(body, at);
  to.x = at.x + h * to.v;
  return to;
}

template <class S, int N>
[[nodiscard]] Motion<S, N> rk4(const LinearBody<S, N>& body, const Motion<S, N>& at, S h) noexcept {
  const S half = h / 2, sixth = h / 6;
  const Motion<S, N> k1{at.v, acceleration(body, at)};
  const Motion<S, N> at2{at.x + half * k1.x, at.v + half * k1.v}, k2{at2.v, acceleration(body, at2)};
  const Motion<S, N> at3{at.x + half * k2.x, at.v + half * k2.v}, k3{at3.v, acceleration(body, at3)};
  const Motion<S, N> at4{at.x + h * k3.x, at.v + h * k3.v}, k4{at4.v, acceleration(body, at4)};
  return {at.x + sixth * (k1.x + S(2) * (k2.x + k3.x) + k4.x), at.v + sixth * (k1.v + S(2) * (k2.v + k3.v) + k4.v)};
}

/// Advances the displacement u and w = h v by the exponential of the augmented matrix
///
///     [u]'   [0          I        0        ] [u]
///     [w]  = [-h^2 K/m   -h B/m   h^2 g/m  ] [w]    with g = f - K x at the start,
///     [1]    [0          0        0        ] [1]
///
/// in the time of one step. Displacements from the start and the scaled velocity keep the norm of the matrix small.
template <class S, int N>
[[nodiscard]] Motion<S, N> exact(const LinearBody<S, N>& body, const Motion<S, N>& at, S h) noexcept {
  using Augmented = Eigen::Matrix<S, 2 * N + 1, 2 * N + 1>;
  const S part = h / body.m;
  Augmented rate = Augmented::Zero();
  rate.template topRows<N>().template middleCols<N>(N).setIdentity();
  rate.template middleRows<N>(N).template leftCols<N>() = -h * part * body.k;
  rate.template middleRows<N>(N).template middleCols<N>(N) = -part * body.b;
  rate.template middleRows<N>(N).template rightCols<1>() = h * part * (body.f - body.k * at.x);
  Motion<S, N> to;
  if (!rate.allFinite()) {  // the scaling of the exponential has no bound then
    to.x.fill(std::numeric_limits<S>::quiet_NaN());
    to.v = to.x;
    return to;
  }
  const Augmented map = rate.exp();
  const Eigen::Matrix<S, N, 1> w = h * at.v;
  to.x = at.x + map.template topRows<N>().template middleCols<N>(N) * w +
         map.template topRows<N>().template rightCols<1>();
  to.v = (map.template middleRows<N>(N).template middleCols<N>(N) * w +
          map.template middleRows<N>(N).template rightCols<1>()) /
         h;
  return to;
}

}  // namespace integrator

/// Returns the motion after one step of length `h` [s], above 0. Inlined: a call per axis would cost a tenth of a step.
template <class S, int N>
[[nodiscard, gnu::always_inline]] inline Motion<S, N> advanced(Integrator how, const LinearBody<S, N>& body,
                                                               const Motion<S, N>& at, S h) noexcept {
  switch (how) {
    case Integrator::kImplicitEuler:
      return integrator::implicit_euler<S, N>(body, at, h);
    case Integrator::kImplicitMidpoint:
      return integrator::implicit_midpoint<S, N>(body, at, h);
    case Integrator::kSemiImplicitEuler:
      return integrator::semi_implicit_euler<S, N>(body, at, h);
    case Integrator::kRk4:
      return integrator::rk4<S, N>(body, at, h);
    case Integrator::kExact:
      return integrator::exact<S, N>(body, at, h);
  }
  return at;
}

}  // namespace tandem::control
