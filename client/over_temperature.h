#pragma once

#include <optional>

#include "common/base/axes.h"

namespace tandem::client {

/// A hand whose motors are too hot is let go (design notes, security 2.4): damping takes the place of force until they have cooled, and
/// after the third time only the person at the device lets it be engaged again. By what the device itself tells; the model of the
/// driver's guard, which lowers the force before that, goes on beside it.
/// A device that tells nothing trips nothing. One that tells, and tells what is no number, is taken for hot: nobody knows then.
class OverTemperature {
 public:
  static constexpr double kHot = 1.0;      ///< share of what the motors may have (hal::State::heat)
  static constexpr double kCool = 0.9;     ///< below it the hand may be engaged again
  static constexpr unsigned kSamples = 3;  ///< on end: one alone may be a glitch
  static constexpr unsigned kTripsMax = 3;

  /// @param heat    of the hottest motor; nothing: not known  @param active  force may reach the hand
  void look(const std::optional<double>& heat, bool active) noexcept TANDEM_REALTIME {
    const bool hot = heat && !(*heat < kHot);
    samples_ = hot ? samples_ + (samples_ < kSamples ? 1 : 0) : 0;
    if (!heat || *heat < kCool) hot_ = false;
    if (hot_ || samples_ < kSamples) return;
    hot_ = true;
    if (!active) return;  // found hot: nothing was let go
    ++trips_;
    ++all_;
  }
  /// The person pressed the button that clears what is latched. Motors that are hot stay so.
  void reset() noexcept { trips_ = 0; }

  /// This hand may not be engaged.
  [[nodiscard]] bool holds_off() const noexcept { return hot_ || latched(); }
  [[nodiscard]] bool hot() const noexcept { return hot_; }
  [[nodiscard]] bool latched() const noexcept { return trips_ >= kTripsMax; }
  [[nodiscard]] unsigned trips() const noexcept { return trips_; }  ///< since the last reset
  [[nodiscard]] unsigned all() const noexcept { return all_; }      ///< ever

 private:
  unsigned samples_ = 0, trips_ = 0, all_ = 0;
  bool hot_ = false;
};

}  // namespace tandem::client
