// Devices of different kinematics share a tool through their tips: the power of both motors sums to zero.
#include <gtest/gtest.h>

#include <Eigen/LU>
#include <optional>
#include <string>
#include <vector>

#include "common/base/rng.h"
#include "hal/core/port_map.h"
#include "hal/drivers/falcon/falcon_kinematics.h"
#include "hal/drivers/woodenhaptics/kinematics.h"
#include "hal/sim/touch_kinematics.h"
#include "proto/spec/woodenhaptics_spec.h"
#include "tests/common/base/counts.h"

namespace tandem::hal {
namespace {

struct Model {
  std::string name;
  std::size_t joints;
  std::optional<Eigen::Matrix3d> (*jacobian)(const Vec3& tip);  ///< columns: joints
};

const std::vector<Model>& models() {
  static const std::vector<Model> all{
      {"touch", 3,
       [](const Vec3& tip) -> std::optional<Eigen::Matrix3d> {
         const auto q = sim::touch_inverse(tip);
         return q ? std::optional{sim::TouchPose(*q).jacobian()} : std::nullopt;
       }},
      {"falcon", 3,
       [](const Vec3& tip) -> std::optional<Eigen::Matrix3d> {
         const auto pose = falcon_pose_at(tip);
         return pose ? std::optional{pose->J} : std::nullopt;
       }},
      {"woodenhaptics", 3,
       [](const Vec3& tip) -> std::optional<Eigen::Matrix3d> {
         WoodenHapticsSpec spec;  // the mechanism of woodenhaptics-2015
         spec.capstan = {0.01, 0.01, 0.01};
         spec.body = {0.16, 0.12, 0.12};
         spec.link = {0.08, 0.205, 0.245};
         spec.origin = {0.22, 0, 0.08};
         const woodenhaptics::Kinematics arm(spec);
         const auto q = arm.inverse(tip);
         return q ? std::optional{arm.jacobian(*q)} : std::nullopt;
       }},
      {"linear", 1,
       [](const Vec3&) -> std::optional<Eigen::Matrix3d> { return Eigen::Vector3d(1, 0, 0).asDiagonal(); }},
  };
  return all;
}

/// Returns the reading of a device whose tip moves at `v`, along the axes that it has.
std::optional<State> reading(const Model& model, const Vec3& tip, const Vec3& v, std::size_t axes) {
  const auto jacobian = model.jacobian(tip);
  if (!jacobian) return {};
  State s;
  s.x = tip;
  s.dx = v;
  s.J.leftCols<3>() = *jacobian;
  const Vec3 dq = axes == 1 && model.joints == 1 ? Vec3(v[0], 0, 0) : Vec3(jacobian->inverse() * v);
  for (std::size_t j = 0; j < model.joints; ++j) s.dq[j] = dq[static_cast<Eigen::Index>(j)];
  return s;
}

/// For each pair: the tip of both moves with the tool, the springs pull both with opposite forces, and the powers of
/// both devices' motors sum to 0.
TEST(SharedTool, PassesPowerBetweenEveryPairOfDeviceModels) {
  for (const Model& a : models())
    for (const Model& b : models()) {
      const std::size_t axes = std::min(a.joints, b.joints);
      const PortMap one(PortSpace::kTip, axes, a.joints), other(PortSpace::kTip, axes, b.joints);
      std::size_t compared = 0;
      for (std::uint64_t seed = 1, last = test::seeds(50); seed <= last; ++seed) {
        SCOPED_TRACE(a.name + " and " + b.name + ", seed " + std::to_string(seed));
        RandomStream r(seed);
        const auto drawn = [&](double most) {
          const Vec3 all(r.uniform(-most, most), r.uniform(-most, most), r.uniform(-most, most));
          return axes == 1 ? Vec3(all[0], 0, 0) : all;
        };
        const Vec3 v = drawn(0.5), force = drawn(3.3);
        const auto at_a = reading(a, drawn(0.025), v, axes), at_b = reading(b, drawn(0.025), v, axes);
        if (!at_a || !at_b) continue;
        ++compared;
        const AxisArray push{force[0], force[1], force[2]}, pull{-force[0], -force[1], -force[2]};
        const AxisArray tau_a = one.joint_effort(*at_a, push), tau_b = other.joint_effort(*at_b, pull);
        double sum = 0, size = 0;
        for (std::size_t j = 0; j < 3; ++j)
          for (const double power : {tau_a[j] * at_a->dq[j], tau_b[j] * at_b->dq[j]}) {
            sum += power;
            size += std::abs(power);
          }
        EXPECT_NEAR(sum, 0, 1e-12 * size);
        EXPECT_GT(size, 0);
      }
      EXPECT_GT(compared, 25U) << a.name << " and " << b.name;
    }
}

}  // namespace
}  // namespace tandem::hal
