#pragma once

#include <memory>
#include <string>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/mouse/mouse_pipe.h"

namespace tandem::hal {

/// A mouse as a device without force: it moves the tip in a plane, the wheel moves it in depth, buttons are buttons. Mice speak
/// in counts, 125 to 1000 times a second, and a detent of a wheel is a jump: the tip follows through a critically damped filter, so
/// that its velocity is that of a hand. At rest a mouse says nothing, which is news: it rests.
class MouseDriver final : public Driver {
 public:
  enum class Plane { kVertical, kTable };  ///< forward is up and the wheel is away; forward is away and the wheel is up
  struct Params {
    double metres_per_count = 1e-4;
    Plane plane = Plane::kVertical;
  };
  static constexpr double kReach = 0.08;         ///< the tip stays within so far of its beginning, along each axis [m]
  static constexpr double kPerDetent = 0.005;    ///< [m]
  static constexpr double kFollow = 0.02;        ///< time constant of the filter [s]
  static constexpr double kSpeedMax = 1.0;       ///< of what it follows, along each axis [m/s]

  /// @param key  under which the same mouse is found again
  MouseDriver(std::string key, std::unique_ptr<MousePipe> pipe, Clock& clock, const Params& params);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  void silence() noexcept override {}

 private:
  void follow(double dt) noexcept;

  DeviceId id_;
  DeviceCaps caps_;
  std::unique_ptr<MousePipe> pipe_;
  Clock* clock_;
  Params params_;
  Vec3 wanted_ = Vec3::Zero();   ///< where the counts lead
  Vec3 target_ = Vec3::Zero();   ///< on its way there, not faster than a hand
  Vec3 x_ = Vec3::Zero(), v_ = Vec3::Zero();
  Time before_{};
};

}  // namespace tandem::hal
