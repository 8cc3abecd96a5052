#pragma once

#include <array>
#include <cstdint>
#include <expected>
#include <string>

#include "hal/device.h"
#include "proto/device_spec.h"

/// Leg torque [N m, positive with growing leg angle] to motor counts. How many counts make 1 N m is published nowhere:
/// public drivers take 10000, the vendor's own traffic reads as about 2300 if its force unit is 1 N, and 8.9 N at 4095
/// counts would be 18500. It is therefore measured on each device with a known mass, or guessed low and kept small.
namespace tandem::hal {

/// Below the least of those readings, so that a device gives at most what was ordered.
inline constexpr double kFalconScaleGuess = 2000;
/// Largest motor value while the scale is a guess: 0.5 N outwards at the middle if 10000 counts make 1 N m, 2.1 N at worst.
inline constexpr std::int16_t kFalconCeilingGuess = 120;
/// Legal scales of a calibrated motor [counts per N m].
inline constexpr double kFalconScaleMin = 500, kFalconScaleMax = 100000;

/// What is wrong with a scale or with the readings it is fitted to.
struct FalconScaleTrouble {
  std::string words;  ///< for a person
  int line = 0;       ///< of the file it came from; 0: of no file
};

class FalconForce {
 public:
  /// Not calibrated: the guess above under the ceiling above.
  FalconForce() noexcept = default;
  /// Of `spec.counts_per_nm` or fitted to `spec.readings`. Error: what is wrong with the readings, for a person.
  [[nodiscard]] static std::expected<FalconForce, FalconScaleTrouble> from(const FalconSpec& spec);

  struct Sent {
    std::array<std::int16_t, 3> motor{};
    Vec3 tau = Vec3::Zero();  ///< what these counts mean [N m]
    bool saturated = false;   ///< it was more than the motors (or the ceiling) give, and was made smaller in its direction
  };
  /// Total: a non-finite torque is none.
  [[nodiscard]] Sent counts_for(const Vec3& tau) const noexcept TANDEM_REALTIME;
  [[nodiscard]] Vec3 torque_of(const std::array<std::int16_t, 3>& motor) const noexcept TANDEM_REALTIME;

  [[nodiscard]] bool calibrated() const noexcept { return calibrated_; }
  [[nodiscard]] const std::array<double, 3>& counts_per_nm() const noexcept { return scale_; }
  /// Largest torque of a leg [N m].
  [[nodiscard]] double torque_max(std::size_t leg) const noexcept { return ceiling_ / scale_[leg]; }

 private:
  std::array<double, 3> scale_{kFalconScaleGuess, kFalconScaleGuess, kFalconScaleGuess};
  std::int16_t ceiling_ = kFalconCeilingGuess;
  bool calibrated_ = false;
};

/// Force scale from known masses, least squares per motor: the torque that carries the mass is J^T m g up, and the motors
/// gave `motor_with - motor_without` counts for it.
/// @return counts per N m, or for a person: too few readings, a motor hardly loaded, readings that contradict each other
[[nodiscard]] std::expected<std::array<double, 3>, FalconScaleTrouble> fit_falcon_scale(
    const std::vector<FalconMassReading>& readings);

}  // namespace tandem::hal
