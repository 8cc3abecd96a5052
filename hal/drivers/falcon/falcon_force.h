#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <string>

#include "hal/core/device.h"
#include "proto/spec/device_spec.h"

/// Conversion of leg torque [N m, positive with growing leg angle] to motor counts.
/// The scale is not published. Public drivers take 10000 counts per N m. The vendor's traffic suggests about 2300 if
/// its force unit is 1 N, and 8.9 N at 4095 counts would be 18500.
/// It is therefore measured on each device with a known mass, or guessed low, with a small ceiling.
namespace tandem::hal {

/// Guessed scale [counts per N m], below the least of those values, so that a device gives at most the commanded force.
inline constexpr double kFalconScaleGuess = 2000;
/// Largest motor value while the scale is a guess. It gives 0.5 N outwards at the middle for 10000 counts per N m, 2.1
/// N at worst.
inline constexpr std::int16_t kFalconCeilingGuess = 120;
/// Valid scales of a calibrated motor [counts per N m].
inline constexpr double kFalconScaleMin = 500, kFalconScaleMax = 100000;

/// Error of a scale or of the readings it is fitted to.
struct FalconScaleError {
  std::string text;  ///< text for the user
  int line = 0;      ///< line in its file; 0: not from a file
};

class FalconForce {
 public:
  /// Not calibrated: uses the guessed scale and ceiling.
  FalconForce() noexcept = default;
  /// Returns the conversion with `spec.counts_per_nm`, or fitted to `spec.readings`. Error: the problem of the
  /// readings, as text for the user.
  [[nodiscard]] static std::expected<FalconForce, FalconScaleError> from(const FalconSpec& spec);

  struct Sent {
    std::array<std::int16_t, 3> motor{};
    Vec3 tau = Vec3::Zero();  ///< torque of these counts [N m]
    /// The torque exceeded the motors' limit (or the ceiling) and was reduced, with its direction kept.
    bool saturated = false;
  };
  /// Returns the motor counts for a leg torque [N m]. Total: a non-finite torque counts as zero.
  [[nodiscard]] Sent counts_for(const Vec3& tau) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Vec3 torque_of(const std::array<std::int16_t, 3>& motor) const noexcept TANDEM_REALTIME;

  [[nodiscard]] bool calibrated() const noexcept { return calibrated_; }
  [[nodiscard]] const std::array<double, 3>& counts_per_nm() const noexcept { return scale_; }
  /// Returns the largest torque of a leg [N m].
  [[nodiscard]] double torque_max(std::size_t leg) const noexcept { return ceiling_ / scale_[leg]; }

 private:
  std::array<double, 3> scale_{kFalconScaleGuess, kFalconScaleGuess, kFalconScaleGuess};
  std::int16_t ceiling_ = kFalconCeilingGuess;
  bool calibrated_ = false;
};

/// Fits the force scale to known masses, by least squares per motor.
/// The torque that carries the mass is J^T m g up; the motors gave `motor_with - motor_without` counts for it.
/// @return counts per N m. Error, as text for the user: too few readings, a motor with little load, readings that
/// contradict each other.
[[nodiscard]] std::expected<std::array<double, 3>, FalconScaleError> fit_falcon_scale(
    const std::vector<FalconMassReading>& readings);

}  // namespace tandem::hal
