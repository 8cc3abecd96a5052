#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <optional>

#include "hal/device.h"
#include "hal/falcon/falcon_force.h"
#include "hal/falcon/falcon_kinematics.h"

namespace tandem::hal {

/// What the motors give while they hold the grip still: one half of a known-mass reading. The grip is led to a point from
/// above and from below and held there each time; friction pulls the other way each time, so the mean of both is free of it.
/// A ServoClient for an enabled Falcon; pure, told the time by the readings, no heap. Threads: `finished` from any.
class FalconWeighing final : public ServoClient {
 public:
  static constexpr double kStiffness = 200;     ///< [N/m]
  static constexpr double kDamping = 5;         ///< [N s/m]
  static constexpr double kIntegral = 600;      ///< [N/(m s)]
  static constexpr double kForceMax = 6;        ///< asked of the device at most [N]
  static constexpr double kAside = 0.004;       ///< where the grip comes from, above and below [m]
  static constexpr Duration kComing = std::chrono::seconds(2), kSettling = std::chrono::seconds(4),
                            kAveraging = std::chrono::seconds(1);
  static constexpr double kStill = 3e-4;        ///< how far the mean may be from the point [m]

  /// @param at  the point where it is held [m]
  /// @param up  against gravity, length 1
  FalconWeighing(const Vec3& at, const Vec3& up) noexcept : at_(at), up_(up) {}

  Command tick(const State& state) noexcept override;
  void lost(Errc) noexcept override { lost_.store(true, std::memory_order_release); }

  [[nodiscard]] bool finished() const noexcept { return finished_.load(std::memory_order_acquire); }
  [[nodiscard]] bool was_lost() const noexcept { return lost_.load(std::memory_order_acquire); }
  /// How long it takes.
  [[nodiscard]] static constexpr Duration length() noexcept { return 2 * (kComing + kSettling + kAveraging); }

  /// Largest weight [N] that motors of this scale hold at `at`, and that is asked of them. Not calibrated: by the guess, which is
  /// the most of all readings, so what is heavier is too heavy for certain.
  [[nodiscard]] static double holds(const FalconForce& scale, const Vec3& at, const Vec3& up) noexcept;

  struct Held {
    std::array<double, 3> encoder{};  ///< mean counts
    std::array<double, 3> torque{};   ///< mean, as the driver's present scale means them [N m]
    double friction = 0;              ///< half of the difference between both sides, the largest of a leg [N m]
  };
  enum class Load : std::uint8_t { kEmptyGrip, kMass };
  /// After `finished`. Error: for a person: the motors were at their limit, or the grip did not come to rest, and what to do.
  /// @param load  what hung there: an empty grip that is too heavy needs another cure than a mass
  [[nodiscard]] std::expected<Held, std::string> held(Load load = Load::kMass) const;

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
  std::array<Mean, 2> side_{};    ///< from above, from below
  std::uint64_t seq_ = 0;
  std::atomic<bool> finished_{false}, lost_{false};
};

}  // namespace tandem::hal
