#pragma once

#include <memory>
#include <optional>

#include "hal/core/driver.h"
#include "hal/drivers/openhaptics/touch_group.h"

namespace tandem::hal::openhaptics {

/// Driver of one Touch (or Omni, Phantom) through the vendor's library.
/// Its joints are the three axes of the tip: the library takes a Cartesian force, so J is the identity and no model of
/// the arm is needed.
/// Commands and readings pass between this thread and the vendor's cycle, which adds up to one cycle (1 ms) each way.
class OpenHapticsDriver final : public Driver {
 public:
  /// @param name           of the device in the vendor's set-up tool; empty: the default one
  /// @param group          of this process; keeps the library loaded
  /// @param home_at_start  the user states that the device rests in its reset pose at opening; used for one bring-up
  ///           only. It matters only for devices that find their origin by an encoder reset. If false, the driver asks
  ///           the user.
  OpenHapticsDriver(std::string name, std::shared_ptr<TouchGroup> group, Clock& clock, bool home_at_start = false);
  ~OpenHapticsDriver() override;

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const ServoCommand& command, State& state) noexcept TANDEM_REALTIME override;
  void send_zeros() noexcept override;

 private:
  /// @return whether a cycle newer than `cycle_` arrived within `limit`
  bool wait_for_cycle(Duration limit) noexcept;
  void release() noexcept;

  DeviceId id_;
  std::string name_;
  bool home_at_start_;
  std::shared_ptr<TouchGroup> group_;
  Clock* clock_;
  DeviceCaps caps_;
  std::optional<std::size_t> slot_;
  std::uint64_t commands_ = 0, cycle_ = 0;
};

}  // namespace tandem::hal::openhaptics
