#include "hal/drivers/falcon/falcon_kinematics.h"

#include <Eigen/LU>
#include <algorithm>
#include <array>
#include <cmath>

namespace tandem::hal {
namespace {

// Dimensions [m], names as in the thesis.
constexpr double kA = 0.060;     ///< thigh
constexpr double kB = 0.1025;    ///< parallelogram of the shin
constexpr double kC = 0.01443;   ///< platform: joint from its centre, radial
constexpr double kD = 0.01125;   ///< short links at both ends of the shin, d = e
constexpr double kF = -0.025;    ///< platform: joint from its centre, tangential
constexpr double kR = 0.0400;    ///< base: joint from its centre, radial
constexpr double kS = -0.02309;  ///< base: joint from its centre, tangential
constexpr std::array<double, 3> kAzimuth{105.0 * std::numbers::pi / 180.0, -15.0 * std::numbers::pi / 180.0,
                                         -135.0 * std::numbers::pi / 180.0};

constexpr double kStepMax = 0.015;      ///< largest Newton step [m]
constexpr double kResidualMax = 1e-12;  ///< largest residual of a leg [rad]
constexpr int kNewtonMax = 40;
constexpr int kHalvingsMax = 12;

struct Azimuths {
  std::array<double, 3> cos, sin;
  Azimuths() noexcept : cos{}, sin{} {
    for (std::size_t i = 0; i < 3; ++i) {
      cos[i] = std::cos(kAzimuth[i]);
      sin[i] = std::sin(kAzimuth[i]);
    }
  }
};
const Azimuths kLeg;

Vec3 to_mechanism(const Vec3& x) { return {x[0], x[2], kFalconOrigin - x[1]}; }
Vec3 to_hal(const Vec3& p) { return {p[0], kFalconOrigin - p[2], p[1]}; }

struct Legs {
  Vec3 theta;             ///< [rad]
  Eigen::Matrix3d rates;  ///< row per leg: d theta / d p, mechanism's frame [rad/m]
};

/// Returns leg angles and their gradients at a position in the mechanism's frame. Singular gradients are infinite.
std::optional<Legs> legs_at(const Vec3& p) noexcept {
  Legs legs;
  for (int i = 0; i < 3; ++i) {
    const double cos = kLeg.cos[static_cast<std::size_t>(i)], sin = kLeg.sin[static_cast<std::size_t>(i)];
    // Position of the platform's joint relative to the base's joint: the thigh moves in the plane of (X, w), v is
    // across it.
    const double X = p[0] * cos + p[1] * sin - kR + kC;
    const double across = -p[0] * sin + p[1] * cos - kS + kF;
    const double w = p[2];
    const double along2 = kB * kB - across * across;
    if (!(along2 > 0)) return std::nullopt;
    const double along = std::sqrt(along2);  // b sin theta_3
    const double L = 2 * kD + along;
    // (X - a cos theta)^2 + (w - a sin theta)^2 = L^2, with the knee outward.
    const double reach = std::hypot(X, w);
    const double cosine = (reach * reach + kA * kA - L * L) / (2 * kA * reach);
    if (!(std::abs(cosine) < 1)) return std::nullopt;
    const double theta = std::atan2(w, X) - std::acos(cosine);
    legs.theta[i] = theta;
    const double s = std::sin(theta), c = std::cos(theta);
    // Derivative of G(p, theta) = 0: d theta = -(dG/dp) / (dG/dtheta) dp, each halved.
    const double dG_dtheta = kA * (X * s - w * c);
    const double dX = (X - kA * c) / -dG_dtheta;
    const double dv = L * across / along / -dG_dtheta;
    const double dw = (w - kA * s) / -dG_dtheta;
    legs.rates.row(i) << dX * cos - dv * sin, dX * sin + dv * cos, dw;
  }
  return legs;
}

/// Returns the ratio of the singular values, in closed form from the characteristic polynomial of M^T M (symmetric
/// 3x3).
double condition_of(const Eigen::Matrix3d& m) noexcept {
  const Eigen::Matrix3d s = m.transpose() * m;
  const double mean = s.trace() / 3;
  const Eigen::Matrix3d d = s - mean * Eigen::Matrix3d::Identity();
  const double spread = std::sqrt(d.squaredNorm() / 6);
  if (!(spread > 0)) return 1;
  const double angle = std::acos(std::clamp(d.determinant() / (2 * spread * spread * spread), -1.0, 1.0)) / 3;
  const double largest = mean + 2 * spread * std::cos(angle);
  const double smallest = mean + 2 * spread * std::cos(angle + 2 * std::numbers::pi / 3);
  return smallest > 0 ? std::sqrt(largest / smallest) : std::numeric_limits<double>::infinity();
}

std::optional<FalconPose> pose_of(const Vec3& p, const Legs& legs) noexcept {
  FalconPose pose;
  pose.x = to_hal(p);
  // Columns by HAL axis: x, then y = -z of the mechanism, then z = y of the mechanism.
  pose.J_inv.col(0) = legs.rates.col(0);
  pose.J_inv.col(1) = -legs.rates.col(2);
  pose.J_inv.col(2) = legs.rates.col(1);
  pose.condition = condition_of(pose.J_inv);
  const double det = pose.J_inv.determinant();
  if (!pose.J_inv.allFinite() || !(std::abs(det) > 0) || !std::isfinite(pose.condition)) return std::nullopt;
  pose.J = pose.J_inv.inverse();
  if (!pose.J.allFinite()) return std::nullopt;
  return pose;
}

std::optional<FalconPose> newton(const Vec3& theta, Vec3 p) noexcept {
  std::optional<Legs> legs = legs_at(p);
  if (!legs) return std::nullopt;
  for (int i = 0; i < kNewtonMax; ++i) {
    const Vec3 residual = theta - legs->theta;
    if (residual.cwiseAbs().maxCoeff() < kResidualMax) return pose_of(p, *legs);
    if (!legs->rates.allFinite() || !(std::abs(legs->rates.determinant()) > 0)) return std::nullopt;
    Vec3 step = legs->rates.inverse() * residual;
    const double length = step.norm();
    if (!std::isfinite(length)) return std::nullopt;
    if (length > kStepMax) step *= kStepMax / length;
    // Limit of rounding: a step this small no longer changes the position.
    if (length < 1e-14) return pose_of(p, *legs);
    std::optional<Legs> next;
    for (int halving = 0; halving < kHalvingsMax; ++halving, step *= 0.5) {
      next = legs_at(p + step);
      if (next) break;
    }
    if (!next) return std::nullopt;
    p += step;
    legs = next;
  }
  return std::nullopt;
}

}  // namespace

std::optional<Vec3> falcon_inverse(const Vec3& x) noexcept {
  const std::optional<Legs> legs = legs_at(to_mechanism(x));
  return legs ? std::optional<Vec3>(legs->theta) : std::nullopt;
}

std::optional<FalconPose> falcon_pose_at(const Vec3& x) noexcept {
  const Vec3 p = to_mechanism(x);
  const std::optional<Legs> legs = legs_at(p);
  return legs ? pose_of(p, *legs) : std::nullopt;
}

std::optional<FalconPose> falcon_forward(const Vec3& theta, const Vec3& guess) noexcept {
  if (!theta.allFinite()) return std::nullopt;
  if (guess.allFinite()) {
    if (auto pose = newton(theta, to_mechanism(guess))) return pose;
  }
  return newton(theta, to_mechanism(Vec3::Zero()));
}

double falcon_effort_share(double condition) noexcept {
  if (!(condition < kConditionNone)) return 0;
  return std::min(1.0, (kConditionNone - condition) / (kConditionNone - kConditionFull));
}

}  // namespace tandem::hal
