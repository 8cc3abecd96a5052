#include "hal/drivers/falcon/falcon_calibration.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace tandem::hal {
namespace {

constexpr Duration kCommandLife = std::chrono::milliseconds(5);
constexpr double kSaturatedShare = 0.01;
constexpr const char* kLighter = "use a lighter mass, or calibrate roughly with a light one first";
constexpr const char* kCounterweight =
    "the empty grip is more than they hold under the small ceiling of a device without a calibration. Calibrate with "
    "--orientation upright, where its weight is across its axis; if that is too much as well, let a counterweight on a "
    "thread over a rod carry the grip through both rounds: it is there without and with the mass, so it does not "
    "change the reading";

}  // namespace

Command FalconCalibration::tick(const State& state) noexcept {
  Command command{
      .seq = ++seq_, .expires = state.sampled_at + kCommandLife, .kind = CommandKind::kJointEffort, .effort = {}};
  if (finished() || state.stale || !state.homed) return command;
  if (!begin_) {
    begin_ = state.sampled_at;
    last_ = state.sampled_at;
  }
  const Duration since = state.sampled_at - *begin_;
  const double dt = std::clamp(seconds(state.sampled_at - last_), 0.0, 0.01);
  last_ = state.sampled_at;
  if (since >= length()) {
    finished_.store(true, std::memory_order_release);
    return command;
  }
  const std::size_t side = since < length() / 2 ? 0 : 1;
  const Duration into = since - static_cast<std::int64_t>(side) * (length() / 2);
  // The grip starts beside the point and then moves to it; friction then opposes that motion.
  const double aside = into < kComing ? (side == 0 ? kAside : -kAside) : 0.0;
  const Vec3 gap = at_ + aside * up_ - state.x;
  integral_ += dt * kIntegral * gap;
  if (const double size = integral_.norm(); size > kForceMax) integral_ *= kForceMax / size;
  Vec3 force = kStiffness * gap - kDamping * state.dx + integral_;
  if (const double size = force.norm(); size > kForceMax) force *= kForceMax / size;
  const Vec3 tau = state.J.leftCols<3>().transpose() * force;
  if (!tau.allFinite()) return command;
  for (std::size_t i = 0; i < 3; ++i) command.effort[i] = tau[static_cast<int>(i)];

  if (into < kComing + kSettling) return command;
  Mean& mean = side_[side];
  ++mean.count;
  mean.saturated += state.saturated ? 1 : 0;
  mean.x += state.x;
  for (std::size_t i = 0; i < 3; ++i) {
    mean.encoder[i] += state.raw[i];
    mean.torque[i] += state.tau_out[i];
  }
  return command;
}

double FalconCalibration::weight_max(const FalconForce& scale, const Vec3& at, const Vec3& up) noexcept {
  const auto pose = falcon_pose_at(at);
  if (!pose) return 0;
  const Vec3 per_newton = pose->J.transpose() * up;
  double most = kForceMax;
  for (std::size_t i = 0; i < 3; ++i) {
    const double lever = std::abs(per_newton[static_cast<int>(i)]);
    if (lever * most > scale.torque_max(i)) most = scale.torque_max(i) / lever;
  }
  return most;
}

std::expected<FalconCalibration::Measurement, std::string> FalconCalibration::measurement(Load load) const {
  if (!finished()) return std::unexpected("the grip was not held long enough");
  Measurement held;
  for (const Mean& mean : side_) {
    const auto count = static_cast<double>(mean.count);
    if (mean.count == 0) return std::unexpected("no readings came while the grip was held");
    if (static_cast<double>(mean.saturated) > kSaturatedShare * count) {
      return std::unexpected(std::string("the motors were at their limit: ") +
                             (load == Load::kMass ? kLighter : kCounterweight));
    }
    if ((mean.x / count - at_).norm() > kStill) {
      return std::unexpected(
          std::string("the grip did not come to rest at its point: it is touched, something swings, or ") +
          (load == Load::kMass ? "the mass is too heavy for the motors: "
                               : "the grip itself is too heavy for the motors: ") +
          (load == Load::kMass ? kLighter : kCounterweight));
    }
    for (std::size_t i = 0; i < 3; ++i) {
      held.encoder[i] += mean.encoder[i] / count / 2;
      held.torque[i] += mean.torque[i] / count / 2;
    }
  }
  for (std::size_t i = 0; i < 3; ++i) {
    const double above = side_[0].torque[i] / static_cast<double>(side_[0].count);
    const double below = side_[1].torque[i] / static_cast<double>(side_[1].count);
    held.friction = std::max(held.friction, std::abs(above - below) / 2);
  }
  return held;
}

}  // namespace tandem::hal
