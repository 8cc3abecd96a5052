#pragma once

#include <memory>
#include <string>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/sim/recorded_motion.h"

namespace tandem::hal {

/// A recorded motion as a device: its tip does again what a hand did, whatever the tool does. It stands at the first position until
/// forces are enabled (a seat was given), then plays in real time. Three prismatic joints, no motors.
class ReplayDriver final : public Driver {
 public:
  /// No device that Tandem knows reaches further from its middle [m]; hands and tools are made for this.
  static constexpr double kReach = 0.1;

  /// @param name  of the recording, for people
  ReplayDriver(std::string name, std::shared_ptr<const sim::RecordedMotion> motion, Clock& clock);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  void silence() noexcept override {}

 private:
  DeviceId id_;
  DeviceCaps caps_;
  std::shared_ptr<const sim::RecordedMotion> motion_;
  sim::RecordedMotion::Cursor cursor_;
  Clock* clock_;
  bool playing_ = false;
  Time began_{};
};

}  // namespace tandem::hal
