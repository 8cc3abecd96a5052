#pragma once

#include <optional>

#include "common/base/axes.h"

namespace tandem::control {

/// Releases a hand whose motors are too hot (ARCHITECTURE.md, invariant 54). Damping replaces force until the motors
/// have cooled; after the third trip only the participant at the device can enable it again. The input is the
/// temperature that the device itself reports. The thermal model of the driver's guard, which lowers the force earlier,
/// acts in addition. A device without temperature reports never trips. A reported value that is not a number counts as
/// hot, because the temperature is then unknown.
class OvertemperatureGuard {
 public:
  static constexpr double kHot = 1.0;       ///< share of the motors' permitted heat (hal::State::heat)
  static constexpr double kCool = 0.9;      ///< below it the hand may engage again
  static constexpr unsigned kSamples = 3;   ///< consecutive; a single one may be a glitch
  static constexpr unsigned kTripsMax = 3;  ///< trips until the guard latches

  /// @param heat    of the hottest motor; nullopt: unknown  @param active  force may reach the hand
  void update(const std::optional<double>& heat, bool active) noexcept TANDEM_REALTIME {
    const bool hot = heat && !(*heat < kHot);
    samples_ = hot ? samples_ + (samples_ < kSamples ? 1 : 0) : 0;
    if (!heat || *heat < kCool) hot_ = false;
    if (hot_ || samples_ < kSamples) return;
    hot_ = true;
    if (!active) return;  // hot before engaging: no hand was released
    ++trips_;
    ++trips_total_;
  }
  /// The participant pressed the button that clears latched states. Hot motors still inhibit.
  void reset() noexcept { trips_ = 0; }

  /// True if this hand must not engage.
  [[nodiscard]] bool inhibits() const noexcept { return hot_ || latched(); }
  /// True from the trip until the motors have cooled below kCool.
  [[nodiscard]] bool hot() const noexcept { return hot_; }
  /// True after kTripsMax trips, until `reset`.
  [[nodiscard]] bool latched() const noexcept { return trips_ >= kTripsMax; }
  [[nodiscard]] unsigned trips() const noexcept { return trips_; }              ///< since the last reset
  [[nodiscard]] unsigned trips_total() const noexcept { return trips_total_; }  ///< since construction

 private:
  unsigned samples_ = 0, trips_ = 0, trips_total_ = 0;
  bool hot_ = false;
};

}  // namespace tandem::control
