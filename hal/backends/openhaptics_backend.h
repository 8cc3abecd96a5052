#pragma once

#include <memory>

#include "hal/backends/backend.h"
#include "hal/drivers/openhaptics/touch_group.h"
#include "hal/io/openhaptics_library.h"
#include "hal/io/periodic_timer.h"

namespace tandem::hal {

/// Devices of 3D Systems (Touch, Touch X, Omni, Phantom) through the vendor's library, if installed.
class OpenHapticsBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "openhaptics"; }
  [[nodiscard]] std::string_view help() const noexcept override {
    return "  openhaptics[:NAME][,home=here][,library=FILE]\n"
           "                              3D Systems Touch and Phantom through the vendor's libHD.so; NAME as in its "
           "set-up\n"
           "                              tool, older ones have 'Default PHANToM'; without NAME its default device.\n"
           "                              home=here: a device that needs it rests in its reset pose now\n";
  }
  /// Returns one entry, for the default name: the library lists no devices, and querying one starts its calibration.
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] std::vector<std::string> udev_rules() const override;
  [[nodiscard]] Result<> check(const DeviceSpec& choice) const override;
  /// Opens a driver; all drivers share one library and one scheduler. Error: as of OpenHapticsLibrary::load and
  /// TouchGroup::add.
  [[nodiscard]] Result<OpenedDriver> open(const DeviceSpec& choice) override;

 private:
  MonotonicClock clock_;
  std::string file_;  ///< file of the loaded library
  std::shared_ptr<OpenHapticsLibrary> library_;
  std::shared_ptr<openhaptics::TouchGroup> group_;
};

}  // namespace tandem::hal
