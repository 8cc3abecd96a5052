#pragma once

#include <optional>

#include "hal/clock.h"
#include "hal/driver.h"
#include "hal/pipes.h"
#include "hal/spacemouse/puck_motion.h"
#include "hal/spacemouse/puck_report.h"

namespace tandem::hal::spacemouse {

/// A 3Dconnexion puck: six velocities, buttons, one light; no position, no motors, and 60 to 125 reports a second.
/// `State::dx` is the tip velocity that the puck asks for [m/s]; dq 0..2 the same, dq 3..5 the turning [rad/s, HAL
/// axes]; q, x, tau_out stay 0: making a position of it is the client's business. Every exchange is fresh, because
/// silence is how a puck at rest talks; `State::stale` tells when the last word is older than 50 ms. Raw: six counts.
/// The light is on while the puck is in use, and bit 0 of `Orders::leds` once that was set.
class SpaceMouseDriver final : public Driver {
 public:
  /// @param pipe, clock  outlive the driver
  /// @param axes         of this product
  SpaceMouseDriver(DeviceId id, HidPipe& pipe, Clock& clock, const SpaceMouseSpec& scaling = {}, const PuckAxes& axes = {});

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  /// Throws away what waits, and puts the light on. A puck at rest says nothing, so nothing is waited for.
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  /// Nothing moves here; the light goes out.
  void silence() noexcept override { (void)light(false); }

  [[nodiscard]] std::optional<std::uint8_t> battery_percent() const noexcept { return battery_; }
  /// Reports of a known id with a wrong length.
  [[nodiscard]] std::uint64_t odd_reports() const noexcept { return odd_reports_; }

 private:
  std::expected<void, Errc> take_reports() noexcept;
  std::expected<void, Errc> light(bool on) noexcept;
  void note(const PuckReport& report, Time at) noexcept;

  DeviceId id_;
  DeviceCaps caps_;
  HidPipe& pipe_;
  Clock& clock_;
  PuckMotion motion_;
  std::array<std::int16_t, 6> counts_{};
  std::uint32_t buttons_ = 0;
  std::optional<std::uint8_t> battery_;
  std::optional<bool> lit_;  ///< as told; none: not yet
  bool light_ordered_ = false;
  std::uint64_t readings_ = 0, odd_reports_ = 0;
};

}  // namespace tandem::hal::spacemouse
