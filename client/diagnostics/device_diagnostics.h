#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/core/device.h"

namespace tandem::client {

/// Detects known device faults from the readings of a device that receives zero force while a user moves it. Symptoms:
/// a position fixed at the pose of an uncalibrated device, encoders without motion, late or torn replies, a lost
/// origin. Sans-I/O; `update` uses no heap.
class DeviceDiagnostics {
 public:
  explicit DeviceDiagnostics(const hal::DeviceCaps& caps) noexcept : caps_(caps) {}

  void update(const hal::State& state) noexcept TANDEM_REALTIME;

  struct Finding {
    enum class Kind : std::uint8_t { kGood, kNotice, kTrouble } kind = Kind::kGood;
    std::string text;  ///< symptom and remedy
  };
  /// Returns all findings about the readings so far.
  /// @param stats    statistics of the device over the same time
  /// @param seconds  duration of the observation [s]
  [[nodiscard]] std::vector<Finding> findings(const hal::DeviceStats& stats, double seconds) const;

  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }

 private:
  hal::DeviceCaps caps_;
  std::uint64_t readings_ = 0, stale_ = 0, origin_lost_ = 0, not_finite_ = 0;
  bool homed_ = false, ever_homed_ = false;
  std::array<std::int32_t, kAxesMax> raw_min_{}, raw_max_{};
  hal::Vec3 low_ = hal::Vec3::Zero(), high_ = hal::Vec3::Zero();
  double fastest_ = 0;  ///< largest tip speed [m/s]
  unsigned pressed_ = 0;
  std::optional<std::uint8_t> battery_;
};

/// Force test: applies a small force along each tip axis in turn, in both directions, and checks that the tip moves in
/// that direction. Detects wrong signs, dead motors and swapped cables. Runs only at the user's request. Sans-I/O.
class ForceTest {
 public:
  static constexpr double kForce = 0.5;  ///< force of each push [N]
  static constexpr Duration kPush = std::chrono::milliseconds(300), kRest = std::chrono::milliseconds(500);

  ForceTest(const hal::DeviceCaps& caps, Time begin) noexcept;
  /// Advances the test by one reading. @return the tip force to apply now [N], 3x1, HAL frame
  [[nodiscard]] hal::Vec3 step(Time now, const hal::State& state) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool finished(Time now) const noexcept;
  [[nodiscard]] std::vector<DeviceDiagnostics::Finding> findings() const;

 private:
  static constexpr std::size_t kPushesMax = 6;
  struct Push {
    double along = 0;     ///< displacement of the tip in the direction of the force [m]
    double sideways = 0;  ///< displacement across that direction [m]
    double given = 0;     ///< sum of the force that the motors delivered along the push, over all samples [N]
    std::uint64_t samples = 0;
    hal::Vec3 from = hal::Vec3::Zero();
  };
  [[nodiscard]] std::size_t pushes() const noexcept { return 2 * axes_; }

  std::size_t axes_;
  Time begin_;
  std::array<Push, kPushesMax> push_{};
};

}  // namespace tandem::client
