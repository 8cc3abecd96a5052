#include "hal/core/load_calibration.h"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>

#include "common/base/format.h"

namespace tandem::hal {
namespace {

/// Vertical lever below which weight does not load a joint [m], RMS.
constexpr double kLeverMin = 0.005;
/// Part of the effort that the estimate may leave unexplained, RMS: a share of it, or the force at the tip [N] that
/// inertia takes in a slow motion, if that is more.
constexpr double kUnexplainedMax = 0.25, kInertiaMax = 0.06;

/// Smallest ratio of the pivots of the normal equations, with columns of unit norm.
constexpr double kPivotMin = 1e-4;

Eigen::Index joint_column(std::size_t joint) noexcept { return static_cast<Eigen::Index>(joint); }

/// Whether all numbers that the estimate reads are finite.
bool finite(const State& s, std::size_t joints) noexcept {
  for (std::size_t j = 0; j < joints; ++j)
    if (!std::isfinite(s.dq[j]) || !std::isfinite(s.tau_out[j])) return false;
  return s.J.leftCols(joint_column(joints)).allFinite();
}

}  // namespace

LoadCalibration::LoadCalibration(std::size_t joints) noexcept : joints_(std::min(joints, kAxesMax)) {}

void LoadCalibration::add(const State& s) noexcept {
  if (s.stale || !finite(s, joints_)) {
    ++ignored_;
    return;
  }
  for (std::size_t j = 0; j < joints_; ++j) {
    const double speed = s.J.col(joint_column(j)).norm() * s.dq[j];
    if (!(std::abs(speed) >= kSpeedMin)) continue;
    Sums& sums = sums_[j];
    const Eigen::Vector3d row{s.J(2, joint_column(j)), speed > 0 ? 1.0 : -1.0, s.dq[j]};
    sums.normal += row * row.transpose();
    sums.right += row * s.tau_out[j];
    sums.effort_square += s.tau_out[j] * s.tau_out[j];
    sums.lever_square += s.J.col(joint_column(j)).squaredNorm();
    ++sums.samples[speed > 0 ? 1 : 0];
  }
}

std::expected<DeviceLoad, std::string> LoadCalibration::result() const {
  DeviceLoad load;
  for (std::size_t j = 0; j < joints_; ++j) {
    const Sums& sums = sums_[j];
    const std::size_t least = std::min(sums.samples[0], sums.samples[1]), all = sums.samples[0] + sums.samples[1];
    if (least < kSamplesMin)
      return std::unexpected(format(
          "joint %zu has %zu samples in one direction and %zu in the other, and needs %zu in each at %g mm/s or more: "
          "move the device slowly back and forth, further or for longer",
          j + 1, sums.samples[0], sums.samples[1], kSamplesMin, 1e3 * kSpeedMin));
    if (!(sums.effort_square > 0))
      return std::unexpected(
          format("joint %zu moved without a known motor effort: the motors must move the device", j + 1));
    // Without a vertical lever the first unknown is fixed at 0.
    const bool weighs = sums.normal(0, 0) > kLeverMin * kLeverMin * static_cast<double>(all);
    Eigen::Matrix3d normal = sums.normal;
    Eigen::Vector3d right = sums.right;
    if (!weighs) {
      normal.row(0).setZero();
      normal.col(0).setZero();
      normal(0, 0) = 1;
      right[0] = 0;
    }
    const Eigen::Vector3d unit = normal.diagonal().cwiseSqrt().cwiseInverse();
    const Eigen::FullPivLU<Eigen::Matrix3d> solver(unit.asDiagonal() * normal * unit.asDiagonal());
    if (!(std::abs(solver.matrixLU()(2, 2)) > kPivotMin * solver.maxPivot()))
      return std::unexpected(
          format("joint %zu moved at one speed only, which does not separate friction from damping: move it back and "
                 "forth with a changing speed",
                 j + 1));
    const Eigen::Vector3d found = unit.asDiagonal() * solver.solve(unit.asDiagonal() * right);
    const double unexplained = sums.effort_square - found.dot(right);
    const double allowed =
        std::max(kUnexplainedMax * kUnexplainedMax * sums.effort_square, kInertiaMax * kInertiaMax * sums.lever_square);
    if (!(unexplained <= allowed))
      return std::unexpected(format(
          "joint %zu: weight and friction explain only %.0f %% of the motor effort: release the device, and keep "
          "it away from objects",
          j + 1, 100 * (1 - std::sqrt(std::clamp(unexplained / sums.effort_square, 0.0, 1.0)))));
    load.weight[j] = weighs ? found[0] : 0;
    load.friction[j] = std::max(0.0, found[1]);
  }
  return load;
}

}  // namespace tandem::hal
