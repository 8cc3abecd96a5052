#pragma once

#include <memory>
#include <optional>

#include "hal/driver.h"
#include "hal/openhaptics/touch_group.h"

namespace tandem::hal::openhaptics {

/// One Touch (or Omni, Phantom) through the vendor's library. Its joints, as Tandem sees them, are the three axes of the tip: the
/// library takes a Cartesian force, so J is the identity and nothing depends on a model of the arm. Orders and readings pass
/// between this thread and the vendor's cycle, which adds up to one cycle (1 ms) each way.
class OpenHapticsDriver final : public Driver {
 public:
  /// @param name           of the device in the vendor's set-up tool; empty: the default one
  /// @param group          of this process; keeps the library loaded
  /// @param home_at_start  a person says that it rests in its reset pose when it is opened. Believed once. Of interest only for devices
  ///                       that find their origin by a reset of the encoders; without it the person is asked.
  OpenHapticsDriver(std::string name, std::shared_ptr<TouchGroup> group, Clock& clock, bool home_at_start = false);
  ~OpenHapticsDriver() override;

  [[nodiscard]] const DeviceId& id() const noexcept override { return id_; }
  [[nodiscard]] const DeviceCaps& caps() const noexcept override { return caps_; }
  Result<> bring_up(BringUp& watcher) override;
  std::expected<Exchange, Errc> exchange(const Orders& orders, State& state) noexcept TANDEM_REALTIME override;
  void silence() noexcept override;

 private:
  /// @return whether a newer cycle than `cycle_` came in time
  bool wait_for_cycle(Duration limit) noexcept;
  void release() noexcept;

  DeviceId id_;
  std::string name_;
  bool home_at_start_;
  std::shared_ptr<TouchGroup> group_;
  Clock* clock_;
  DeviceCaps caps_;
  std::optional<std::size_t> slot_;
  std::uint64_t orders_ = 0, cycle_ = 0;
};

}  // namespace tandem::hal::openhaptics
