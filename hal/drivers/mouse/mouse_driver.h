#pragma once

#include <memory>
#include <string>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/drivers/mouse/mouse_pipe.h"

namespace tandem::hal {

/// Driver of a mouse, a device without force: it moves the tip in a plane, its wheel moves the tip in depth, its
/// buttons are the buttons.
/// A mouse reports counts, 125 to 1000 times a second, and a wheel detent is a jump. A critically damped filter
/// therefore gives the tip the velocity of a hand.
/// A mouse at rest sends no reports, so an exchange without a report is a valid reading of rest.
class MouseDriver final : public Driver {
 public:
  /// Plane of the mouse's motion. kVertical: forward is up, the wheel is away. kTable: forward is away, the wheel is
  /// up.
  enum class Plane { kVertical, kTable };
  struct Params {
    double metres_per_count = 1e-4;
    Plane plane = Plane::kVertical;
  };
  static constexpr double kReach = 0.08;       ///< largest distance of the tip from its start, along each axis [m]
  static constexpr double kPerDetent = 0.005;  ///< [m]
  static constexpr double kFollow = 0.02;      ///< time constant of the filter [s]
  static constexpr double kSpeedMax = 1.0;     ///< speed limit of the filtered target, along each axis [m/s]

  /// @param key  identifies the same mouse again
  MouseDriver(std::string key, std::unique_ptr<MousePipe> pipe, Clock& clock, const Params& params);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  void send_zeros() noexcept override {}

 private:
  void follow(double dt) noexcept;

  DeviceId id_;
  DeviceCaps caps_;
  std::unique_ptr<MousePipe> pipe_;
  Clock* clock_;
  Params params_;
  Vec3 wanted_ = Vec3::Zero();  ///< position by the counts
  Vec3 target_ = Vec3::Zero();  ///< follows wanted_ at up to kSpeedMax
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
  Time before_{};
};

}  // namespace tandem::hal
