#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "hal/device.h"

namespace tandem::client {

/// Watches a device that exchanges zeros while a person moves it, and knows the symptoms that others had (design notes,
/// peers 3): a position that stands at the pose of an uncalibrated device, encoders that do not move, answers that come
/// late or torn, an origin that gets lost. Pure; no heap while it watches.
class Examination {
 public:
  explicit Examination(const hal::DeviceCaps& caps) noexcept : caps_(caps) {}

  void see(const hal::State& state) noexcept TANDEM_REALTIME;

  struct Finding {
    enum class Kind : std::uint8_t { kGood, kNotice, kTrouble } kind = Kind::kGood;
    std::string words;  ///< what was seen, and the cure
  };
  /// @param stats    of the device over the same time
  /// @param seconds  watched
  [[nodiscard]] std::vector<Finding> findings(const hal::DeviceStats& stats, double seconds) const;

  [[nodiscard]] std::uint64_t readings() const noexcept { return readings_; }

 private:
  hal::DeviceCaps caps_;
  std::uint64_t readings_ = 0, stale_ = 0, origin_lost_ = 0, not_finite_ = 0;
  bool homed_ = false, ever_homed_ = false;
  std::array<std::int32_t, kAxesMax> raw_min_{}, raw_max_{};
  hal::Vec3 low_ = hal::Vec3::Zero(), high_ = hal::Vec3::Zero();
  double fastest_ = 0;  ///< of the tip [m/s]
  unsigned pressed_ = 0;
  std::optional<std::uint8_t> battery_;
};

/// Pushes the hand softly along each axis in turn, both ways, and looks whether the tip gives way in that direction: what
/// a wrong sign, a dead motor or swapped cables look like. Only for a person who asked for it. Pure.
class ForceTest {
 public:
  static constexpr double kForce = 0.5;  ///< [N]
  static constexpr Duration kPush = std::chrono::milliseconds(300), kRest = std::chrono::milliseconds(500);

  ForceTest(const hal::DeviceCaps& caps, Time begin) noexcept;
  /// @return the tip force for this moment [N]
  [[nodiscard]] hal::Vec3 step(Time now, const hal::State& state) noexcept TANDEM_REALTIME;
  [[nodiscard]] bool over(Time now) const noexcept;
  [[nodiscard]] std::vector<Examination::Finding> findings() const;

 private:
  static constexpr std::size_t kPushesMax = 6;
  struct Push {
    double along = 0;     ///< how far the tip went the way it was pushed [m]
    double sideways = 0;  ///< and how far across [m]
    double given = 0;     ///< mean force the motors really gave [N]
    std::uint64_t samples = 0;
    hal::Vec3 from = hal::Vec3::Zero();
  };
  [[nodiscard]] std::size_t pushes() const noexcept { return 2 * axes_; }

  std::size_t axes_;
  Time begin_;
  std::array<Push, kPushesMax> push_{};
};

}  // namespace tandem::client
