#pragma once

#include <memory>

#include "hal/io/backend.h"
#include "hal/io/openhaptics_library.h"
#include "hal/io/servo_pace.h"
#include "hal/openhaptics/touch_group.h"

namespace tandem::hal {

/// Devices of 3D Systems (Touch, Touch X, Omni, Phantom) through the vendor's library, if it is installed.
class OpenHapticsBackend final : public Backend {
 public:
  [[nodiscard]] std::string_view name() const noexcept override { return "openhaptics"; }
  [[nodiscard]] std::string_view help() const noexcept override {
    return "  openhaptics[:NAME][,home=here][,library=FILE]\n"
           "                              3D Systems Touch and Phantom through the vendor's libHD.so; NAME as in its set-up\n"
           "                              tool, older ones have 'Default PHANToM'; without NAME its default device.\n"
           "                              home=here: a device that needs it rests in its reset pose now\n";
  }
  /// The library lists no devices, and asking one begins its calibration: there is one entry, for the default name.
  [[nodiscard]] Result<std::vector<FoundDevice>> list() override;
  [[nodiscard]] std::string library() const override;
  [[nodiscard]] std::vector<DeviceFact> facts() const override;
  [[nodiscard]] std::vector<std::string> udev_rules() const override;
  [[nodiscard]] Result<> check(const DeviceChoice& choice) const override;
  /// All drivers share one library, one scheduler. Error: as of load and TouchGroup::add.
  [[nodiscard]] Result<OpenedDriver> open(const DeviceChoice& choice) override;

 private:
  MonotonicClock clock_;
  std::string file_;  ///< loaded
  std::shared_ptr<OpenHapticsLibrary> library_;
  std::shared_ptr<openhaptics::TouchGroup> group_;
};

}  // namespace tandem::hal
