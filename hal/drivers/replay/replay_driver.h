#pragma once

#include <memory>
#include <string>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/sim/recorded_motion.h"

namespace tandem::hal {

/// Driver that replays a recorded motion as a device, independent of the tool.
/// The tip stays at the first position until forces are enabled (the seat is joined), then plays in real time. Three
/// prismatic joints, no motors.
class ReplayDriver final : public Driver {
 public:
  /// Half side of the workspace [m]; no device that Tandem supports reaches further from its middle. Hands and tools
  /// are designed for it.
  static constexpr double kReach = 0.1;

  /// @param name  of the recording, for messages
  ReplayDriver(std::string name, std::shared_ptr<const sim::RecordedMotion> motion, Clock& clock);

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  void send_zeros() noexcept override {}

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
