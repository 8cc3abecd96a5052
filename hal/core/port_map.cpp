#include "hal/core/port_map.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

namespace tandem::hal {
namespace {

/// Normalised determinant below which a pose counts as nearly singular (Touch: 6 degrees from a stretched arm).
constexpr double kDeterminantMin = 0.01;
/// Damping added at the singularity itself, relative to the mean squared lever arm.
constexpr double kDampingMax = 0.01;

double finite_or_zero(double v) noexcept { return std::isfinite(v) ? v : 0.0; }

int column(std::size_t i) noexcept { return static_cast<int>(i); }

/// Returns the inverse of a symmetric positive semi-definite matrix: damped if nearly singular, zero if the matrix is
/// zero.
Eigen::Matrix3d damped_inverse(Eigen::Matrix3d a) noexcept {
  const double mean = a.trace() / 3.0;
  if (!(mean > 1e-100) || !(mean < 1e100)) return Eigen::Matrix3d::Zero();
  a /= mean;
  const double w = a.determinant();
  if (w < kDeterminantMin) {
    const double share = 1.0 - std::max(w, 0.0) / kDeterminantMin;
    a.diagonal().array() += kDampingMax * share * share;
  }
  return a.inverse() / mean;
}

}  // namespace

Vec3 solve_tip_force(const Jacobian& J, const AxisArray& tau, std::size_t joints) noexcept {
  const std::size_t n = std::min(joints, kAxesMax);
  Vec3 force = Vec3::Zero();
  if (n == 0) return force;
  if (n <= 3) {
    // J^T J is regular if J has full column rank. Unused joints get a diagonal entry, so they affect neither the force
    // nor the conditioning.
    Eigen::Matrix3d a = J.leftCols<3>().transpose() * J.leftCols<3>();
    double sum = 0.0;
    for (std::size_t i = 0; i < n; ++i) sum += a(column(i), column(i));
    Vec3 t = Vec3::Zero();
    for (std::size_t i = 0; i < 3; ++i) {
      if (i < n) {
        t[column(i)] = finite_or_zero(tau[i]);
      } else {
        a.row(column(i)).setZero();
        a.col(column(i)).setZero();
        a(column(i), column(i)) = sum / static_cast<double>(n);
      }
    }
    force = J.leftCols<3>() * (damped_inverse(a) * t);
  } else {
    Vec3 jt = Vec3::Zero();
    for (std::size_t i = 0; i < n; ++i) jt += J.col(column(i)) * finite_or_zero(tau[i]);
    force = damped_inverse(J * J.transpose()) * jt;
  }
  return force.allFinite() ? force : Vec3(Vec3::Zero());
}

PortMap::PortMap(PortSpace space, std::size_t dof, std::size_t joints) noexcept
    : space_(space), joints_(std::min(joints, kAxesMax)) {
  dof_ = std::min(dof, space == PortSpace::kTip ? std::size_t{3} : joints_);
}

AxisArray PortMap::position(const State& state) const noexcept {
  AxisArray p{};
  for (std::size_t i = 0; i < dof_; ++i) p[i] = space_ == PortSpace::kTip ? state.x[column(i)] : state.q[i];
  return p;
}

AxisArray PortMap::velocity(const State& state) const noexcept {
  AxisArray v{};
  for (std::size_t i = 0; i < dof_; ++i) v[i] = space_ == PortSpace::kTip ? state.dx[column(i)] : state.dq[i];
  return v;
}

AxisArray PortMap::delivered(const State& state) const noexcept {
  AxisArray e{};
  for (std::size_t i = 0; i < dof_; ++i) e[i] = space_ == PortSpace::kTip ? state.f_out[column(i)] : state.tau_out[i];
  return e;
}

AxisArray PortMap::joint_effort(const State& state, const AxisArray& effort) const noexcept {
  AxisArray tau{};
  if (space_ == PortSpace::kJoint) {
    std::copy_n(effort.begin(), dof_, tau.begin());
    return tau;
  }
  for (std::size_t j = 0; j < joints_; ++j) {
    for (std::size_t i = 0; i < dof_; ++i) tau[j] += state.J(column(i), column(j)) * effort[i];
  }
  return tau;
}

Vec3 PortMap::tip_force(const State& state, const AxisArray& effort) const noexcept {
  if (space_ == PortSpace::kTip) {
    Vec3 force = Vec3::Zero();
    for (std::size_t i = 0; i < dof_; ++i) force[column(i)] = effort[i];
    return force;
  }
  AxisArray tau{};
  std::copy_n(effort.begin(), dof_, tau.begin());
  return solve_tip_force(state.J, tau, joints_);
}

AxisArray PortMap::effort(const State& state, const Vec3& force) const noexcept {
  AxisArray e{};
  for (std::size_t i = 0; i < dof_; ++i) {
    e[i] = space_ == PortSpace::kTip ? force[column(i)] : state.J.col(column(i)).dot(force);
  }
  return e;
}

AxisArray PortMap::scale(const State& state) const noexcept {
  AxisArray s{};
  for (std::size_t i = 0; i < dof_; ++i) s[i] = space_ == PortSpace::kTip ? 1.0 : state.J.col(column(i)).squaredNorm();
  return s;
}

}  // namespace tandem::hal
