#pragma once

#include <optional>

#include "hal/core/clock.h"
#include "hal/core/driver.h"
#include "hal/core/pipes.h"
#include "hal/drivers/spacemouse/spacemouse_motion.h"
#include "hal/drivers/spacemouse/spacemouse_report.h"

namespace tandem::hal::spacemouse {

/// Driver of a 3Dconnexion SpaceMouse: six velocities, buttons, one light. It has no position and no motors, and sends
/// 60 to 125 reports a second.
/// `State::dx` is the commanded tip velocity [m/s]; dq 0..2 are the same, dq 3..5 the angular velocity [rad/s, HAL
/// axes].
/// q, x and tau_out stay 0: the client integrates a position. Raw: six counts.
/// Every exchange is kFresh, because a SpaceMouse at rest sends nothing. `State::stale` is set if the last report is
/// older than 50 ms.
/// The light is on while the device is in use. Once bit 0 of `ServoCommand::leds` was set, the light follows that bit.
class SpaceMouseDriver final : public Driver {
 public:
  /// @param pipe, clock  must outlive the driver
  /// @param axes         axis mapping of this product
  SpaceMouseDriver(DeviceId id, HidPipe& pipe, Clock& clock, const SpaceMouseSpec& scaling = {},
                   const SpaceMouseAxes& axes = {});

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  /// Discards queued reports and switches the light on. Does not wait for a report: a SpaceMouse at rest sends none.
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  /// Switches the light off; the device has no motors.
  void send_zeros() noexcept override { (void)light(false); }

  [[nodiscard]] std::optional<std::uint8_t> battery_percent() const noexcept { return battery_; }
  /// Returns the number of reports with a known id and a wrong length.
  [[nodiscard]] std::uint64_t odd_reports() const noexcept { return odd_reports_; }

 private:
  std::expected<void, Errc> take_reports() noexcept;
  std::expected<void, Errc> light(bool on) noexcept;
  void note(const SpaceMouseReport& report, Time at) noexcept;

  DeviceId id_;
  DeviceCaps caps_;
  HidPipe& pipe_;
  Clock& clock_;
  SpaceMouseMotion motion_;
  std::array<std::int16_t, 6> counts_{};
  std::uint32_t buttons_ = 0;
  std::optional<std::uint8_t> battery_;
  std::optional<bool> lit_;  ///< last state sent; empty: none yet
  bool light_commanded_ = false;
  std::uint64_t readings_ = 0, odd_reports_ = 0;
};

}  // namespace tandem::hal::spacemouse
