#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <optional>

#include "hal/core/device.h"
#include "hal/drivers/falcon/falcon_force.h"
#include "hal/drivers/falcon/falcon_kinematics.h"

namespace tandem::hal {

/// Measurement of the motor torques that hold the grip still: one half of a known-mass reading.
/// The grip is moved to a point from above and from below and held there each time. Friction has opposite signs, so the
/// mean of both is free of it.
/// A ServoClient for an enabled Falcon. Pure, takes the time from the readings, no heap. Threads: `finished` from any
/// thread.
class FalconCalibration final : public ServoClient {
 public:
  static constexpr double kStiffness = 200;  ///< [N/m]
  static constexpr double kDamping = 5;      ///< [N s/m]
  static constexpr double kIntegral = 600;   ///< [N/(m s)]
  static constexpr double kForceMax = 6;     ///< largest commanded force [N]
  static constexpr double kAside = 0.004;    ///< distance of the starting points above and below [m]
  static constexpr Duration kComing = std::chrono::seconds(2), kSettling = std::chrono::seconds(4),
                            kAveraging = std::chrono::seconds(1);
  static constexpr double kStill = 3e-4;  ///< largest distance of the mean position from the point [m]

  /// @param at  point where the grip is held [m]
  /// @param up  direction against gravity, length 1
  FalconCalibration(const Vec3& at, const Vec3& up) noexcept : at_(at), up_(up) {}

  Command tick(const State& state) noexcept override;
  void lost(Errc) noexcept override { lost_.store(true, std::memory_order_release); }

  [[nodiscard]] bool finished() const noexcept { return finished_.load(std::memory_order_acquire); }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(std::memory_order_acquire); }
  /// Returns the duration of the measurement.
  [[nodiscard]] static constexpr Duration length() noexcept { return 2 * (kComing + kSettling + kAveraging); }

  /// Returns the largest weight [N] that motors of this scale hold at `at`, limited to kForceMax.
  /// Not calibrated: the guessed scale gives an upper bound, so a heavier mass is certainly too heavy.
  [[nodiscard]] static double weight_max(const FalconForce& scale, const Vec3& at, const Vec3& up) noexcept;

  struct Measurement {
    std::array<double, 3> encoder{};  ///< mean counts
    std::array<double, 3> torque{};   ///< mean torque by the driver's present scale [N m]
    double friction = 0;              ///< half of the difference between both sides, the largest over the legs [N m]
  };
  enum class Load : std::uint8_t { kEmptyGrip, kMass };
  /// Returns the measurement, after `finished`.
  /// Error, as text for the user: the motors were at their limit or the grip did not come to rest, with the remedy.
  /// @param load  load on the grip: too heavy an empty grip needs another remedy than too heavy a mass
  [[nodiscard]] std::expected<Measurement, std::string> measurement(Load load = Load::kMass) const;

 private:
  struct Mean {
    std::array<double, 3> encoder{}, torque{};
    Vec3 x = Vec3::Zero();
    std::uint64_t count = 0, saturated = 0;
  };

  Vec3 at_, up_;
  std::optional<Time> begin_;
  Time last_{};
  Vec3 integral_ = Vec3::Zero();  ///< force [N]
  std::array<Mean, 2> side_{};    ///< mean from above, mean from below
  std::uint64_t seq_ = 0;
  std::atomic<bool> finished_{false}, lost_{false};
};

}  // namespace tandem::hal
